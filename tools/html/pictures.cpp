// SPDX-License-Identifier: BSD-3-Clause
#include "html/pictures.h"

#include "io/plugin.h"

#ifdef PCL_PDS_RECON_WITH_PICTURES

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>

namespace pds
{

namespace
{

void send(int pipe_end, const std::string& bytes)
{
  const std::size_t size = bytes.size();
  std::string message(reinterpret_cast<const char*>(&size), sizeof size);
  message += bytes;
  for (std::size_t sent = 0; sent < message.size();) {
    const ssize_t count = write(pipe_end, message.data() + sent, message.size() - sent);
    if (count < 0) {
      _exit(EXIT_FAILURE);
    }
    sent += static_cast<std::size_t>(count);
  }
}

/** In the child: sends the complaint, which is empty if all is well, and then the pictures. */
[[noreturn]] void draw_and_send(int pipe_end, const ViewData& data, const std::vector<Shot>& shots)
{
  if (const int silence = open("/dev/null", O_WRONLY); silence >= 0) {
    dup2(silence, STDERR_FILENO);  // VTK's complaints; the parent has words of its own
  }
  setenv("VTK_SMP_BACKEND_IN_USE", "Sequential", 1);  // the threads of TBB, which Embree may have started, are not here
  std::vector<std::string> pictures;
  std::string complaint;
  try {
    void* function = load_plugin_function("pcl_pds_recon_pictures", "pcl_pds_recon_draw_pictures");
    reinterpret_cast<decltype(&pcl_pds_recon_draw_pictures)>(function)(data, shots, pictures, complaint);
  } catch (const PluginError& error) {
    complaint = error.what();
  }
  send(pipe_end, complaint);
  for (const std::string& picture : pictures) {
    send(pipe_end, picture);
  }
  _exit(EXIT_SUCCESS);  // neither destructors nor handlers: what they would tidy up is the parent's
}

std::string receive_all(int pipe_end)
{
  std::string bytes;
  std::array<char, 1 << 16> buffer{};
  for (ssize_t count = 1; count > 0;) {
    count = read(pipe_end, buffer.data(), buffer.size());
    bytes.append(buffer.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  }
  return bytes;
}

/** The messages of send(); those that are whole. */
std::vector<std::string> take_apart(const std::string& bytes)
{
  std::vector<std::string> messages;
  std::size_t size = 0;
  for (std::size_t place = 0; bytes.size() - place >= sizeof size; place += size) {
    std::memcpy(&size, bytes.data() + place, sizeof size);
    place += sizeof size;
    if (bytes.size() - place < size) {
      break;
    }
    messages.push_back(bytes.substr(place, size));
  }
  return messages;
}

}  // namespace

std::vector<std::string> draw_pictures(const ViewData& data, const std::vector<Shot>& shots)
{
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    throw PluginError("the system has no pipe left");
  }
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    draw_and_send(ends[1], data, shots);
  }
  close(ends[1]);
  std::vector<std::string> messages = take_apart(receive_all(ends[0]));
  close(ends[0]);
  if (child > 0) {
    waitpid(child, nullptr, 0);
  }
  if (!messages.empty() && !messages.front().empty()) {
    throw PluginError(messages.front());
  }
  if (messages.size() != shots.size() + 1) {
    throw PluginError("VTK cannot draw on this display; unset DISPLAY and install xvfb");
  }
  messages.erase(messages.begin());
  return messages;
}

}  // namespace pds

#else

namespace pds
{

std::vector<std::string> draw_pictures(const ViewData& /*data*/, const std::vector<Shot>& /*shots*/)
{
  throw PluginError("this build is without VTK, which draws them");
}

}  // namespace pds

#endif
