// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/private_x_server.h"

#include <X11/Xlib.h>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace pds
{

namespace
{

/** \brief In the child: becomes an Xvfb that writes the number of its display into \a pipe_end. */
[[noreturn]] void become_x_server(int pipe_end)
{
  prctl(PR_SET_PDEATHSIG, SIGTERM);  // does not outlive a parent that is killed
  // It reports each display number that another server has taken already, which is no one's business.
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) dup2(nowhere, STDERR_FILENO);
  const std::string number = std::to_string(pipe_end);
  execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "1280x1024x24", "-nolisten", "tcp", "-noreset",
         static_cast<char*>(nullptr));
  _exit(EXIT_FAILURE);
}

/** \brief The line that the server writes when it is ready; empty if it ended instead. */
std::string read_line(int pipe_end)
{
  std::string line;
  char character = 0;
  while (read(pipe_end, &character, 1) == 1 && character != '\n') {
    line += character;
  }
  return line;
}

/** \brief VTK would abort the program. */
void check_that_server_answers(const char* display)
{
  Display* connection = XOpenDisplay(display);
  if (connection == nullptr) {
    throw std::runtime_error("no X server answers at DISPLAY " + std::string(display) +
                             "; set DISPLAY to one that does, or unset it to write pictures without");
  }
  XCloseDisplay(connection);
}

}  // namespace

PrivateXServer::PrivateXServer()
{
  const char* display = std::getenv("DISPLAY");
  if (display != nullptr && *display != '\0') {
    check_that_server_answers(display);
    return;
  }
  int ends[2];
  if (pipe(ends) != 0) {
    throw std::runtime_error("no X display to draw on, and no pipe for a private one; set DISPLAY");
  }
  process_ = fork();
  if (process_ == 0) {
    close(ends[0]);
    become_x_server(ends[1]);
  }
  close(ends[1]);
  const std::string number = process_ > 0 ? read_line(ends[0]) : "";
  close(ends[0]);
  if (number.empty()) {
    if (process_ > 0) {
      waitpid(process_, nullptr, 0);
    }
    throw std::runtime_error("no X display to draw on, and Xvfb cannot be started; set DISPLAY or install xvfb");
  }
  setenv("DISPLAY", (":" + number).c_str(), 1);
}

PrivateXServer::~PrivateXServer()
{
  if (process_ > 0) {
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
    unsetenv("DISPLAY");
  }
}

}  // namespace pds
