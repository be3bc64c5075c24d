// SPDX-License-Identifier: BSD-3-Clause
#include "progress.h"

#include "printable.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <unistd.h>
#include <algorithm>
#include <iostream>

namespace pds
{

namespace
{

constexpr unsigned long bar_steps = 1000;

spdlog::level::level_enum level_of(Verbosity verbosity)
{
  switch (verbosity) {
    case Verbosity::quiet:
      return spdlog::level::off;
    case Verbosity::normal:
      return spdlog::level::info;
    case Verbosity::detailed:
      break;
  }
  return spdlog::level::debug;
}

}  // namespace

ProgressReporter::ProgressReporter(Verbosity verbosity)
    : logger_(std::make_shared<spdlog::logger>("pcl_pds_recon", std::make_shared<spdlog::sinks::stderr_sink_st>())),
      shows_bar_(verbosity == Verbosity::normal && isatty(STDERR_FILENO) != 0)
{
  logger_->set_level(level_of(verbosity));
  logger_->set_pattern(shows_bar_ ? "%v" : "[%H:%M:%S.%e] %v");
}

ProgressReporter::~ProgressReporter() { leave_bar(); }

void ProgressReporter::start_stage(const std::string& stage, double fraction)
{
  if (!shows_bar_) {
    logger_->info("{}", stage);
    return;
  }
  if (!bar_) {
    bar_.emplace(bar_steps, std::cerr, "");
  }
  const auto reached = static_cast<unsigned long>(std::clamp(fraction, 0.0, 1.0) * static_cast<double>(bar_steps));
  if (reached > bar_->count()) {
    *bar_ += reached - bar_->count();
  }
}

void ProgressReporter::finish()
{
  if (bar_) {
    *bar_ += bar_steps - bar_->count();
    bar_.reset();
  }
}

void ProgressReporter::warn(const std::string& line)
{
  leave_bar();
  logger_->warn("{}", printable(line));
}

void ProgressReporter::info(const std::string& line)
{
  leave_bar();
  logger_->info("{}", printable(line));
}

void ProgressReporter::detail(const std::string& line)
{
  leave_bar();
  logger_->debug("{}", printable(line));
}

/** Whatever is printed next starts on a line of its own. */
void ProgressReporter::leave_bar()
{
  if (bar_) {
    std::cerr << std::endl;
    bar_.reset();
  }
}

}  // namespace pds
