// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/reconstruction.h>
#include <algorithm>
#include <chrono>

namespace pds
{

/** \brief Announces stages and takes their time. */
class StageClock
{
 public:
  explicit StageClock(const Progress& progress) : progress_(progress) {}

  /** \brief Ends the running stage and starts the next, whose time goes to \a seconds. */
  void start(const char* stage, double fraction, double& seconds)
  {
    stop();
    fraction_ = std::max(fraction_, fraction);  // stages that run again do not go back
    if (progress_) progress_(stage, fraction_);
    seconds_ = &seconds;
    begin_ = Clock::now();
  }

  void stop()
  {
    if (seconds_ != nullptr) *seconds_ += std::chrono::duration<double>(Clock::now() - begin_).count();
    seconds_ = nullptr;
  }

 private:
  using Clock = std::chrono::steady_clock;
  const Progress& progress_;
  double fraction_ = 0;
  double* seconds_ = nullptr;
  Clock::time_point begin_;
};

}  // namespace pds
