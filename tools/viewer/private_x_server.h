// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

namespace pds
{

/** \brief Debian's VTK draws through an X server even without a window, and aborts without one. If no display is set,
 * this starts an Xvfb of its own, names it in DISPLAY, and ends it when destroyed; if one is set, it must answer. */
class PrivateXServer
{
 public:
  /** \throws std::runtime_error with one line that says what is missing */
  PrivateXServer();
  ~PrivateXServer();
  PrivateXServer(const PrivateXServer&) = delete;
  PrivateXServer& operator=(const PrivateXServer&) = delete;

 private:
  pid_t process_ = -1;  ///< -1 if there was a display
};

}  // namespace pds
