// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/rerun.h"

#include <exception>

namespace pds
{

Rerun::~Rerun()
{
  give_up_ = true;
  if (thread_.joinable()) {
    thread_.join();
  }
}

void Rerun::request(const Options& options)
{
  if (is_busy()) {
    next_ = options;
    give_up_ = true;
  } else {
    start(options);
  }
}

void Rerun::announce(const char* stage, double fraction)
{
  if (give_up_) {
    throw GivenUp();
  }
  const std::lock_guard<std::mutex> lock(progress_mutex_);
  progress_ = std::string(stage) + " " + std::to_string(static_cast<int>(100 * fraction)) + " %";
}

void Rerun::start(const Options& options)
{
  finished_ = false;
  give_up_ = false;
  thread_ = std::thread([this, options] {
    result_ = {{}, options, ""};
    try {
      result_.data =
          make_view_data(source_, options, [this](const char* stage, double fraction) { announce(stage, fraction); });
    } catch (const GivenUp&) {
      result_.error = "given up";
    } catch (const std::exception& error) {
      result_.error = error.what();
    }
    finished_ = true;
  });
}

std::optional<Rerun::Result> Rerun::take()
{
  if (!is_busy() || !finished_) {
    return std::nullopt;
  }
  thread_.join();
  if (next_) {
    const Options options = *next_;
    next_.reset();
    start(options);
    return std::nullopt;
  }
  return std::move(result_);
}

std::string Rerun::progress() const
{
  const std::lock_guard<std::mutex> lock(progress_mutex_);
  return progress_;
}

}  // namespace pds
