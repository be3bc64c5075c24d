// SPDX-License-Identifier: BSD-3-Clause
#include "io/byte_source.h"

#include <pcl_pds_recon/options.h>

#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

namespace pds
{

namespace
{

[[noreturn]] void throw_unreadable()
{
  throw InvalidInput(std::string("cannot be read to its end (") + std::strerror(errno) + "); check the disk");
}

/** The end of the line that starts with \a keyword, npos if there is no such complete line. */
std::size_t end_of_line(std::string_view text, std::string_view keyword)
{
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) {
      break;
    }
    if (text.compare(begin, keyword.size(), keyword) == 0) {
      return end + 1;
    }
    begin = end + 1;
  }
  return std::string_view::npos;
}

}  // namespace

ByteSource ByteSource::from_file(const std::string& path)
{
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    throw InvalidInput("there is no such file; check the path");
  }
  if (!std::filesystem::is_regular_file(status)) {
    throw InvalidInput("is not a file but a directory or device; name a file, or - for standard input");
  }
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    throw InvalidInput(std::string("cannot be opened (") + std::strerror(errno) + "); check its permissions");
  }
  ByteSource source(descriptor, static_cast<std::size_t>(std::filesystem::file_size(path)));
  if (source.size() == 0) {
    throw InvalidInput("the file is empty; write the point cloud again");
  }
  return source;
}

ByteSource ByteSource::from_standard_input()
{
  constexpr std::size_t chunk_bytes = std::size_t{1} << 20;
  std::string bytes;
  std::size_t filled = 0;
  while (true) {
    bytes.resize(std::max(2 * filled, chunk_bytes));
    const ssize_t count = ::read(STDIN_FILENO, bytes.data() + filled, bytes.size() - filled);
    if (count < 0 && errno != EINTR) {
      throw_unreadable();
    }
    if (count == 0) {
      break;
    }
    filled += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }
  bytes.resize(filled);
  if (bytes.empty()) {
    throw InvalidInput("nothing came through; check the command that writes into the pipe");
  }
  return ByteSource(std::move(bytes));
}

ByteSource::ByteSource(ByteSource&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), bytes_(std::move(other.bytes_)), size_(other.size_)
{
}

ByteSource::~ByteSource()
{
  if (descriptor_ >= 0) {
    close(descriptor_);
  }
}

void ByteSource::read(std::size_t offset, void* target, std::size_t size) const
{
  if (descriptor_ < 0) {
    std::memcpy(target, bytes_.data() + offset, size);
    return;
  }
  for (std::size_t done = 0; done < size;) {
    const ssize_t count =
        pread(descriptor_, static_cast<char*>(target) + done, size - done, static_cast<off_t>(offset + done));
    if (count == 0) {
      throw InvalidInput("became shorter while it was read; wait until it is complete");
    }
    if (count < 0 && errno != EINTR) {
      throw_unreadable();
    }
    done += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }
}

std::string ByteSource::head(std::size_t size) const
{
  std::string bytes(std::min(size, size_), '\0');
  read(0, bytes.data(), bytes.size());
  return bytes;
}

std::string ByteSource::head_through_line(std::string_view keyword) const
{
  constexpr std::size_t usual_header_bytes = 4096;
  const std::size_t greatest_header_bytes = std::min(size_, std::size_t{1} << 24);  // 16 MiB of comments will do
  std::string bytes;
  std::size_t end = std::string::npos;
  for (std::size_t size = usual_header_bytes; end == std::string::npos && bytes.size() < greatest_header_bytes;
       size *= 4) {
    bytes = head(size);
    end = end_of_line(bytes, keyword);
  }
  bytes.resize(std::min(end, bytes.size()));
  return bytes;
}

}  // namespace pds
