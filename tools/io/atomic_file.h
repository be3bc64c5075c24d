// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace pds
{

/** \brief Thrown when an output cannot be written; what() is one line that names the file and what to do. */
struct OutputError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** \brief What stands for standard input and standard output in place of a file's name. */
constexpr const char* standard_stream = "-";

/** \brief A file that appears under its name only when it is complete.
 *
 * The bytes go to a temporary file beside it, which commit() renames. It is removed if commit() is not reached: by an
 * exception, or by SIGINT, SIGTERM or SIGHUP. The bytes for standard output wait in memory for commit().
 */
class AtomicFile
{
 public:
  /** \throws OutputError if the temporary file cannot be made */
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /** \throws OutputError if the disk is full or fails */
  void write(const void* bytes, std::size_t size);

  /** \brief Hands the last bytes to the system; nothing can be written after it. \throws OutputError as write() */
  void finish();

  /** \brief Gives the file its name, in place of any older one. \throws OutputError if that fails */
  void commit();

 private:
  [[noreturn]] void throw_errno() const;
  void remove();

  void send_to_standard_output();

  std::string path_;
  std::string temporary_path_;  ///< empty for standard output, and after commit()
  std::size_t signal_slot_ = 0;
  std::string waiting_;  ///< for standard output
  std::FILE* stream_ = nullptr;
};

/** \brief Checks, without a trace, that \a path names a file that can be made or replaced.
 * \throws OutputError if its directory is missing or read-only or if it is not a regular file
 */
void check_writable(const std::string& path);

}  // namespace pds
