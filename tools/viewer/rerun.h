// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "viewer/load_view.h"

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace pds
{

/** \brief Makes view data with other options in a thread of its own, so that the window goes on. */
class Rerun
{
 public:
  struct Result
  {
    ViewData data;
    Options options;
    std::string error;  ///< empty if all went well
  };

  /** \param source must outlive this object */
  explicit Rerun(const ViewSource& source) : source_(source) {}
  ~Rerun();
  Rerun(const Rerun&) = delete;
  Rerun& operator=(const Rerun&) = delete;

  /** \brief Starts with these options. A run that is under way is given up at its next stage. */
  void request(const Options& options);

  /** \brief The result of the last request, once; nothing before it is there. */
  [[nodiscard]] std::optional<Result> take();

  [[nodiscard]] bool is_busy() const { return thread_.joinable(); }
  [[nodiscard]] std::string progress() const;  ///< such as "sampling 40 %"

 private:
  struct GivenUp
  {
  };

  void start(const Options& options);
  void announce(const char* stage, double fraction);

  const ViewSource& source_;
  std::thread thread_;
  std::atomic<bool> finished_{false};
  std::atomic<bool> give_up_{false};
  Result result_;
  std::optional<Options> next_;
  mutable std::mutex progress_mutex_;
  std::string progress_;
};

}  // namespace pds
