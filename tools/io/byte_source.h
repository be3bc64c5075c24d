// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace pds
{

/** \brief The bytes of a file, or of what comes through a pipe, readable at any place and from several threads.
 *
 * A file stays on the disk, and so takes no memory beside the cloud that is made of it. It is not mapped into memory
 * either, because a file that shrinks meanwhile would end the process; here it is reported.
 */
class ByteSource
{
 public:
  /** \throws InvalidInput if there is no such regular file, it is empty or cannot be opened */
  [[nodiscard]] static ByteSource from_file(const std::string& path);

  /** \brief All that standard input holds. \throws InvalidInput if that is nothing or cannot be read */
  [[nodiscard]] static ByteSource from_standard_input();

  explicit ByteSource(std::string bytes) : bytes_(std::move(bytes)), size_(bytes_.size()) {}
  ByteSource(ByteSource&& other) noexcept;
  ByteSource& operator=(ByteSource&&) = delete;
  ~ByteSource();

  [[nodiscard]] std::size_t size() const { return size_; }

  /** \brief Copies \a size bytes from \a offset on; they must be there. \throws InvalidInput if reading fails */
  void read(std::size_t offset, void* target, std::size_t size) const;

  /** \brief The first \a size bytes, or all if there are fewer. \throws InvalidInput if reading fails */
  [[nodiscard]] std::string head(std::size_t size) const;

  /** \brief All bytes. \throws InvalidInput if reading fails */
  [[nodiscard]] std::string all() const { return head(size_); }

  /** \brief The beginning of the file up to the end of the line that starts with \a keyword, or more if there is no
   * such line: the header of a format that has a text header. \throws InvalidInput if reading fails */
  [[nodiscard]] std::string head_through_line(std::string_view keyword) const;

 private:
  ByteSource(int descriptor, std::size_t size) : descriptor_(descriptor), size_(size) {}

  int descriptor_ = -1;  ///< of the file; -1 if the bytes are in memory
  std::string bytes_;
  std::size_t size_ = 0;
};

}  // namespace pds
