// SPDX-License-Identifier: BSD-3-Clause
#include "io/laz_check.h"

#include "las_testing.h"

#include <vector>

namespace pds
{
namespace
{

/** A LAZ file of records without extra bytes, as far as it can be written without packing anything. */
struct LazFile
{
  std::uint8_t format = 0;
  std::uint16_t record_bytes = 20;
  std::uint16_t compressor = 2;
  std::vector<std::array<std::uint16_t, 3>> items = {{6, 20, 2}};  // type, size, version
  std::uint32_t points = 150000;
  std::uint32_t chunk_size = 50000;
  std::uint32_t chunks = 3;
  std::string content = std::string(60, '\0');  // of the chunks

  [[nodiscard]] std::string bytes() const
  {
    LasFile header(format < 6 ? 2 : 4, static_cast<std::uint8_t>(0x80 | format), record_bytes);
    std::string record(54, '\0');
    record.replace(2, 14, "laszip encoded");
    const auto length = static_cast<std::uint16_t>(34 + 6 * items.size());
    record.replace(18, 4, bytes_of(std::uint16_t{22204}) + bytes_of(length));
    std::string laszip(34, '\0');
    laszip.replace(0, 2, bytes_of(compressor));
    laszip.replace(12, 4, bytes_of(chunk_size));
    laszip.replace(32, 2, bytes_of(static_cast<std::uint16_t>(items.size())));
    for (const auto& item : items) {
      laszip += bytes_of(item);
    }
    const auto begin = static_cast<std::uint32_t>(header.bytes().size() + record.size() + laszip.size());
    header.set(96, begin);
    header.set(100, std::uint32_t{1});
    header.set(107, format < 6 ? points : 0);
    if (format >= 6) {
      header.set(247, std::uint64_t{points});
    }
    const auto table_at = static_cast<std::int64_t>(begin + 8 + content.size());
    return header.bytes() + record + laszip + bytes_of(table_at) + content + bytes_of(std::uint32_t{0}) +
           bytes_of(chunks);
  }
};

/** A chunk of point format 6: a point, the number of points, and the sizes of nine layers, of which one has bytes. */
std::string layered_chunk(std::uint32_t points, std::uint32_t announced_bytes)
{
  std::string sizes(9 * sizeof(std::uint32_t), '\0');
  sizes.replace(4, 4, bytes_of(announced_bytes));
  return std::string(30, '\0') + bytes_of(points) + sizes + std::string(100, '\0');
}

LazFile layered_file()
{
  LazFile file;
  file.format = 6;
  file.record_bytes = 30;
  file.compressor = 3;
  file.items = {{10, 30, 3}};
  file.points = 70;
  file.chunk_size = 50;
  file.chunks = 2;
  file.content = layered_chunk(50, 100) + layered_chunk(20, 100);
  return file;
}

std::string complaint_about(const std::string& bytes)
{
  return complaint([&bytes] {
    check_laz(ByteSource(bytes));
    return PointTable({{"x"}, {"y"}, {"z"}});
  });
}

#define EXPECT_COMPLAINT(file, part) EXPECT_NE(complaint_about((file).bytes()).find(part), std::string::npos)

TEST(LazCheck, does_not_believe_a_count_that_the_chunks_cannot_hold)
{
  LazFile file;
  EXPECT_EQ(complaint_about(file.bytes()), "");
  file.points = 150001;
  EXPECT_COMPLAINT(file, "cut short");
  file.points = 100000;
  EXPECT_COMPLAINT(file, "contradicts itself in the number of its points");
  file.points = 100001;
  EXPECT_EQ(complaint_about(file.bytes()), "");
  file.chunk_size = 100000;
  EXPECT_COMPLAINT(file, "contradicts itself in the number of its points");
  file.chunk_size = 0xFFFFFFFF;
  EXPECT_EQ(complaint_about(file.bytes()), "") << "the table says how large each chunk is";
  file.chunks = 1000000;
  EXPECT_COMPLAINT(file, "cut short");
}

TEST(LazCheck, counts_the_points_of_chunks_that_say_how_many_they_hold)
{
  LazFile file = layered_file();
  EXPECT_EQ(complaint_about(file.bytes()), "");
  file.points = 71;
  EXPECT_COMPLAINT(file, "cut short");
  file.points = 69;
  EXPECT_COMPLAINT(file, "goes on after the last point");
  file = layered_file();
  for (const std::uint32_t wrong : {49U, 51U}) {
    file.chunk_size = wrong;
    EXPECT_COMPLAINT(file, "contradicts itself in the size of its chunks") << wrong;
  }
  file.chunk_size = 0xFFFFFFFF;
  EXPECT_EQ(complaint_about(file.bytes()), "");
  for (const std::uint32_t wrong : {0U, 99U, 101U, 0xFFFFFFFFU}) {
    file.content = layered_chunk(50, 100) + layered_chunk(20, wrong);
    EXPECT_COMPLAINT(file, "contradicts itself in the size of its chunks") << wrong;
  }
}

TEST(LazCheck, wants_the_header_and_the_record_of_laszip_to_describe_the_same_points)
{
  LazFile file;
  file.record_bytes = 22;
  EXPECT_COMPLAINT(file, "LASzip record of other points");
  file.items = {{6, 20, 2}, {0, 2, 2}};
  EXPECT_EQ(complaint_about(file.bytes()), "") << "two extra bytes";
  file.items = {{6, 20, 2}, {7, 2, 2}};
  EXPECT_COMPLAINT(file, "LASzip record of other points");
  file.items = {};
  EXPECT_COMPLAINT(file, "LASzip record of other points");
  file = layered_file();
  file.items = {{6, 30, 2}};
  EXPECT_COMPLAINT(file, "LASzip record of other points");
  file = layered_file();
  file.compressor = 2;
  EXPECT_COMPLAINT(file, "PDAL does not know");
}

TEST(LazCheck, complains_of_files_that_are_cut_short_or_no_laz)
{
  const std::string good = LazFile().bytes();
  for (const std::size_t size : {good.size() - 1, good.size() - 9, std::size_t{260}, std::size_t{230}}) {
    EXPECT_NE(complaint_about(good.substr(0, size)).find("cut short"), std::string::npos) << size;
  }
  LasFile plain(2, 0, 20);
  plain.add(las_record(1, 2, 3, 2));
  EXPECT_COMPLAINT(plain, "not compressed");
  EXPECT_COMPLAINT(LasFile(2, 0x80, 20), "no LASzip record");
}

}  // namespace
}  // namespace pds
