// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/reconstruction.h>
#include <algorithm>
#include <chrono>
#include <string>
#include <vector>
#include "run_report.h"

namespace pds
{

/** \brief Announces stages, takes their time and watches the memory. */
class StageClock
{
 public:
  /** \param peaks receives the memory that the process had taken at most when a stage ended */
  StageClock(const Progress& progress, std::vector<StagePeak>& peaks) : progress_(progress), peaks_(peaks) {}

  /** \brief Ends the running stage and starts the next, whose time goes to \a seconds. */
  void start(const char* stage, double fraction, double& seconds)
  {
    stop();
    fraction_ = std::max(fraction_, fraction);  // stages that run again do not go back
    if (progress_) progress_(stage, fraction_);
    stage_ = stage;
    seconds_ = &seconds;
    begin_ = Clock::now();
  }

  void stop()
  {
    if (seconds_ == nullptr) return;
    *seconds_ += std::chrono::duration<double>(Clock::now() - begin_).count();
    seconds_ = nullptr;
    const auto before =
        std::find_if(peaks_.begin(), peaks_.end(), [this](const StagePeak& peak) { return peak.stage == stage_; });
    if (before == peaks_.end())
      peaks_.push_back({stage_, peak_resident_bytes()});
    else
      before->rss_bytes = peak_resident_bytes();  // a stage that has run again
  }

 private:
  using Clock = std::chrono::steady_clock;
  const Progress& progress_;
  std::vector<StagePeak>& peaks_;
  std::string stage_;
  double fraction_ = 0;
  double* seconds_ = nullptr;
  Clock::time_point begin_;
};

}  // namespace pds
