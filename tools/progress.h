// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line.h"

#include <spdlog/logger.h>
#include <boost/timer/progress_display.hpp>
#include <memory>
#include <optional>
#include <string>

namespace pds
{

/** \brief Tells on stderr how far the run is: a bar on a terminal, otherwise, or if details are wanted, log lines. */
class ProgressReporter
{
 public:
  explicit ProgressReporter(Verbosity verbosity);
  ~ProgressReporter();
  ProgressReporter(const ProgressReporter&) = delete;
  ProgressReporter& operator=(const ProgressReporter&) = delete;

  /** \brief A stage starts; \a fraction of the whole run lies behind it. */
  void start_stage(const std::string& stage, double fraction);

  /** \brief Completes the bar. */
  void finish();

  void warn(const std::string& line);    ///< printed unless quiet
  void info(const std::string& line);    ///< printed unless quiet
  void detail(const std::string& line);  ///< printed if details are wanted

 private:
  void leave_bar();

  std::shared_ptr<spdlog::logger> logger_;
  std::optional<boost::timer::progress_display> bar_;
  bool shows_bar_;
};

}  // namespace pds
