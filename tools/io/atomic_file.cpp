// SPDX-License-Identifier: BSD-3-Clause
#include "io/atomic_file.h"

#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <utility>

namespace pds
{

namespace
{

namespace fs = std::filesystem;

// What a signal handler may touch: plain memory and unlink(). A run writes the mesh, the Voronoi cells and the report.
constexpr std::size_t slot_count = 4;
struct Slot
{
  volatile std::sig_atomic_t used = 0;
  std::array<char, PATH_MAX> path{};
};
std::array<Slot, slot_count> slots;

extern "C" void remove_and_die(int signal)
{
  for (Slot& slot : slots) {
    if (slot.used != 0) {
      unlink(slot.path.data());
    }
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void catch_signals()
{
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction current = {};
    sigaction(signal, nullptr, &current);
    if (current.sa_handler != SIG_IGN) {  // as under nohup
      std::signal(signal, remove_and_die);
    }
  }
  std::signal(SIGXFSZ, SIG_IGN);  // a file beyond the size limit fails in write() instead of killing the process
}

std::size_t occupy_slot(const std::string& path)
{
  catch_signals();
  for (std::size_t i = 0; i < slot_count; ++i) {
    if (slots[i].used == 0 && path.size() < slots[i].path.size()) {
      std::memcpy(slots[i].path.data(), path.c_str(), path.size() + 1);
      slots[i].used = 1;
      return i;
    }
  }
  throw OutputError(path + ": too long a path or too many files at a time; choose a shorter path");
}

/** The file that is replaced in the end: a link stays a link. */
std::string resolve_link(const std::string& path)
{
  std::error_code error;
  const fs::path target = fs::canonical(path, error);
  return error ? path : target.string();
}

fs::path directory_of(const std::string& path)
{
  const fs::path directory = fs::path(path).parent_path();
  return directory.empty() ? fs::path(".") : directory;
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path)
{
  if (path == standard_stream) {
    path_ = "standard output";
    std::signal(SIGPIPE, SIG_IGN);  // a reader that went away fails write() instead of killing the process
    return;
  }
  path_ = resolve_link(path);
  const std::string temporary_path = path_ + "." + std::to_string(getpid()) + ".part";
  signal_slot_ = occupy_slot(temporary_path);
  stream_ = std::fopen(temporary_path.c_str(), "wbx");
  if (!stream_) {
    slots[signal_slot_].used = 0;
    throw_errno();
  }
  temporary_path_ = temporary_path;
}

AtomicFile::~AtomicFile()
{
  if (!temporary_path_.empty()) {
    remove();
  }
}

void AtomicFile::remove()
{
  if (stream_) {
    std::fclose(stream_);
    stream_ = nullptr;
  }
  unlink(temporary_path_.c_str());
  temporary_path_.clear();
  slots[signal_slot_].used = 0;
}

void AtomicFile::throw_errno() const
{
  const char* remedy =
      errno == EPIPE ? "look at the command that reads the pipe" : "make room or choose another place for it";
  throw OutputError(path_ + ": cannot be written (" + std::strerror(errno) + "); " + remedy);
}

void AtomicFile::write(const void* bytes, std::size_t size)
{
  if (size == 0) {
    return;  // an empty array may have no address, which the C library must not be given
  }
  if (!stream_) {
    waiting_.append(static_cast<const char*>(bytes), size);
    return;
  }
  if (std::fwrite(bytes, 1, size, stream_) != size) {
    throw_errno();
  }
}

void AtomicFile::finish()
{
  std::FILE* stream = std::exchange(stream_, nullptr);
  if (stream && std::fclose(stream) != 0) {
    throw_errno();
  }
}

void AtomicFile::send_to_standard_output()
{
  for (std::size_t done = 0; done < waiting_.size();) {
    const ssize_t count = ::write(STDOUT_FILENO, waiting_.data() + done, waiting_.size() - done);
    if (count < 0 && errno != EINTR) {
      throw_errno();
    }
    done += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }
  waiting_.clear();
}

void AtomicFile::commit()
{
  if (temporary_path_.empty()) {
    send_to_standard_output();
    return;
  }
  if (std::rename(temporary_path_.c_str(), path_.c_str()) != 0) {
    throw_errno();
  }
  temporary_path_.clear();
  slots[signal_slot_].used = 0;
}

void check_writable(const std::string& path)
{
  if (path == standard_stream) {
    return;
  }
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw OutputError(path + ": is a directory or device and cannot be replaced; name a file");
  }
  const fs::path directory = directory_of(resolve_link(path));
  if (!fs::is_directory(directory, error)) {
    throw OutputError(path + ": there is no directory '" + directory.string() + "'; make it first");
  }
  if (access(directory.c_str(), W_OK | X_OK) != 0) {
    throw OutputError(path + ": cannot be written (" + std::strerror(errno) + "); choose another directory");
  }
}

}  // namespace pds
