// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/byte_source.h"
#include "io/laz_check.h"

#include <string>

namespace pds
{

/** \brief The points of a LAZ file as a file in memory, with nothing behind them.
 *
 * Whoever unpacks more points from it than are there comes to its end, instead of inventing them from what follows; and
 * of the records in the header there are only those that tell how the points are packed: a damaged coordinate reference
 * system crashes GDAL, and nothing here needs it.
 */
class LazCopy
{
 public:
  /** \throws InvalidInput if reading fails, std::bad_alloc if there is no memory for it */
  LazCopy(const ByteSource& source, const LazParts& parts);

  /** \brief Takes the last byte away. An arithmetic decoder keeps in step with its encoder and has read all bytes when
   * it has the last point; if all points can be unpacked now, they are not all that the file holds. \throws
   * std::bad_alloc */
  void drop_last_byte() const;

  /** \brief The file's name in this process and its children. */
  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(file_.descriptor); }

 private:
  void append(const void* bytes, std::size_t size) const;
  void append(const ByteSource& source, std::size_t begin, std::size_t end) const;

  struct MemoryFile
  {
    MemoryFile();
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile();
    int descriptor;
  };
  MemoryFile file_;
};

}  // namespace pds
