// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/byte_source.h"
#include "io/point_table.h"

#include <pcl_pds_recon/parallel.h>

#include <boost/endian/conversion.hpp>
#include <vector>

namespace pds
{

/** \brief Where a scalar lies in the records of a file. */
struct Column
{
  std::string name;        ///< of the field that it becomes
  ScalarType type;         ///< in the file
  std::size_t offset = 0;  ///< in the file's record, in bytes
};

/** \brief Binary records of one size, one per point. */
struct RecordLayout
{
  std::vector<Column> columns;   ///< in any order; bytes that belong to none are passed over
  std::size_t record_bytes = 0;  ///< from one record to the next
  std::size_t begin = 0;         ///< of the first record in the file
  std::uint64_t count = 0;       ///< records
  boost::endian::order order = boost::endian::order::little;
};

/** \brief Says that the header of a file announces fewer points than lie there. */
[[noreturn]] void throw_data_after_points();

/** \brief Whether at least one more record would find room between the last one and \a end. */
[[nodiscard]] bool has_data_after_points(const RecordLayout& layout, std::size_t end);

/** \brief A table of \a size rows whose fields are those of the columns. \throws InvalidInput as PointTable */
[[nodiscard]] PointTable make_table(const std::vector<Column>& columns, std::size_t size);

/** \brief Copies \a count records, in the byte order of this machine, into the rows of \a table from \a row on.
 *
 * The table has a field for each column, of its type or of one that holds its values.
 */
void copy_records(
    const std::byte* records, const RecordLayout& layout, std::size_t count, PointTable& table, std::size_t row);

/** \brief Reads all records, in blocks by several threads; needs no memory beside the table.
 * \throws InvalidInput if the fields make no table or reading fails; the caller has checked that the records are there
 */
[[nodiscard]] PointTable read_records(const ByteSource& source, const RecordLayout& layout, const Parallel& parallel);

}  // namespace pds
