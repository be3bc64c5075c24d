// SPDX-License-Identifier: BSD-3-Clause
#include "child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>

namespace pds
{

namespace
{

/** In the child. */
[[noreturn]] void do_work(const std::function<void(const ChildOutput&)>& work, int pipe_end)
{
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // does not outlive a parent that is killed
  const rlimit no_core = {0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  if (const int silence = open("/dev/null", O_WRONLY | O_CLOEXEC); silence >= 0) {
    dup2(silence, STDOUT_FILENO);
    dup2(silence, STDERR_FILENO);
  }
  work(ChildOutput(pipe_end));
  _exit(EXIT_SUCCESS);  // neither destructors nor handlers: what they would tidy up is the parent's
}

}  // namespace

void ChildOutput::send(const void* bytes, std::size_t size) const
{
  const char* place = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t count = write(pipe_end_, place, size);
    if (count < 0 && errno != EINTR) {
      _exit(EXIT_FAILURE);
    }
    if (count > 0) {
      place += count;
      size -= static_cast<std::size_t>(count);
    }
  }
}

void ChildOutput::send_text(const std::string& text) const
{
  const std::size_t size = text.size();
  send(&size, sizeof size);
  send(text.data(), size);
}

ChildProcess::ChildProcess(const std::function<void(const ChildOutput&)>& work)
{
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    return;
  }
  process_ = fork();
  if (process_ == 0) {
    close(ends[0]);
    do_work(work, ends[1]);
  }
  close(ends[1]);
  pipe_end_ = ends[0];
}

ChildProcess::~ChildProcess()
{
  close(pipe_end_);
  if (process_ <= 0) {
    return;
  }
  kill(process_, SIGKILL);  // it has sent all that is asked for, or is not asked any more
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

bool ChildProcess::receive(void* target, std::size_t size) const
{
  char* place = static_cast<char*>(target);
  while (size > 0) {
    const ssize_t count = read(pipe_end_, place, size);
    if (count == 0 || (count < 0 && errno != EINTR)) {
      return false;
    }
    if (count > 0) {
      place += count;
      size -= static_cast<std::size_t>(count);
    }
  }
  return true;
}

std::optional<std::string> ChildProcess::receive_text() const
{
  std::size_t size = 0;
  if (!receive(&size, sizeof size)) {
    return std::nullopt;
  }
  std::string text(size, '\0');
  return receive(text.data(), size) ? std::optional(std::move(text)) : std::nullopt;
}

}  // namespace pds
