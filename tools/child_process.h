// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace pds
{

/** \brief The child's end of the pipe to its parent. What cannot be sent, because the parent is gone, ends the child.
 */
class ChildOutput
{
 public:
  explicit ChildOutput(int pipe_end) : pipe_end_(pipe_end) {}

  void send(const void* bytes, std::size_t size) const;
  void send_text(const std::string& text) const;

 private:
  int pipe_end_;
};

/** \brief Work in a process of its own: a library that crashes there, or ends the process, does not take this one
 * along.
 *
 * What the work prints goes nowhere, and it leaves no core file; the parent has words of its own.
 */
class ChildProcess
{
 public:
  /** \brief Starts \a work, which throws nothing. If the system has no process left, nothing will be received. */
  explicit ChildProcess(const std::function<void(const ChildOutput&)>& work);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();  ///< ends the child if it is still at work

  /** \brief Waits for what the child sends next. \return whether it came before the child ended */
  [[nodiscard]] bool receive(void* target, std::size_t size) const;
  [[nodiscard]] std::optional<std::string> receive_text() const;  ///< nothing if the child ended before

 private:
  pid_t process_ = -1;
  int pipe_end_ = -1;
};

}  // namespace pds
