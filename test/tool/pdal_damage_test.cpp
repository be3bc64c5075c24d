// SPDX-License-Identifier: BSD-3-Clause
// Damaged files of the formats that PDAL reads. PDAL may crash; the program may not, nor take points for real that are
// not in the file.
#include "e57_testing.h"
#include "io/read_points.h"
#include "pdal_testing.h"
#include "run_testing.h"
#include "utm_cloud.h"

#include <numeric>
#include <random>

namespace pds
{
namespace
{

using Names = std::vector<std::string>;

constexpr std::size_t las_1_2_count_at = 107;  // ASPRS LAS 1.2, number of points
constexpr std::size_t las_1_4_count_at = 247;  // ASPRS LAS 1.4, the same
constexpr std::size_t record_bytes_at = 105;   // ASPRS LAS 1.2 and 1.4
constexpr std::size_t x_scale_at = 131;        // likewise
constexpr std::size_t x_offset_at = 155;       // likewise

template <typename Number>
std::string with_number(std::string bytes, std::size_t place, Number number)
{
  return bytes.replace(place, sizeof number, bytes_of(number));
}

class PdalDamage : public RunTool
{
 protected:
  PdalDamage() { write("utm.las", utm_las()); }

  /** \return the bytes of the cloud in the format that \a driver writes */
  std::string make(const std::string& name, const char* driver, const char* reference_system = "")
  {
    EXPECT_EQ(write_with_pdal(path("utm.las"), path(name), driver, reference_system), utm_points);
    std::string bytes = read(name);
    std::filesystem::remove(path(name));
    return bytes;
  }

  void expect_complaint(const std::string& name, const std::string& bytes, const std::string& part)
  {
    write(name, bytes);
    EXPECT_EQ(run("-q " + name + " out.ply"), 1) << part;
    EXPECT_TRUE(complained_of(name + ": ")) << part;
    EXPECT_TRUE(complained_of(part));
    EXPECT_EQ(files(), (Names{name, "utm.las"}));
    std::filesystem::remove(path(name));
  }

  /** Puts a random byte into each of these places, one after the other: the file is read or complained of in one line.
   * \param save makes the file of its content */
  void flip_bytes(const std::string& name,
                  const std::string& content,
                  const std::vector<std::size_t>& places,
                  const std::function<std::string(const std::string&)>& save)
  {
    constexpr std::size_t every = 20;  // of these places the program is run, which takes longer than reading
    std::mt19937 random(1);
    for (std::size_t i = 0; i < places.size(); ++i) {
      std::string damaged = content;
      damaged[places[i]] = static_cast<char>(random());
      write(name, save(damaged));
      const std::string text = complaint([&] { return read_points(path(name), Parallel(1)); });
      EXPECT_EQ(text.find('\n'), std::string::npos) << places[i] << ": " << text;
      if (i % every == 0) {
        const int status = run("-q " + name + " out.ply");
        EXPECT_TRUE(status == 0 || (status == 1 && complained_of(name + ": ")))
            << "place " << places[i] << ", status " << status << ", " << errors();
      }
    }
  }
};

std::vector<std::size_t> range(std::size_t begin, std::size_t end)
{
  std::vector<std::size_t> places(end - begin);
  std::iota(places.begin(), places.end(), begin);
  return places;
}

std::string as_it_is(const std::string& bytes) { return bytes; }

TEST_F(PdalDamage, never_ends_the_program_whichever_byte_of_a_laz_header_is_wrong)
{
  flip_bytes("cloud.laz", make("cloud.laz", "writers.las"), range(0, 400), as_it_is);
}

TEST_F(PdalDamage, never_ends_the_program_whichever_byte_of_a_copc_header_is_wrong)
{
  flip_bytes("cloud.copc.laz", make("cloud.copc.laz", "writers.copc"), range(0, 700), as_it_is);
}

TEST_F(PdalDamage, never_ends_the_program_whichever_byte_of_an_e57_header_or_description_is_wrong)
{
  const std::vector<double> values = {0, 1, 2, 3, 5, 8};
  const std::string content = e57_content({{"cartesianX", values}, {"cartesianY", values}, {"cartesianZ", values}}, 6);
  flip_bytes("cloud.e57", content, range(0, std::min(content.find_last_of('>'), std::size_t{1200})), e57_file);
}

std::string e57_line_content(std::size_t announced, const std::string& of_scan = "")
{
  std::vector<double> values(utm_points);  // several packets
  std::iota(values.begin(), values.end(), 0.0);
  return e57_content({{"cartesianX", values}, {"cartesianY", values}, {"cartesianZ", values}}, announced, of_scan);
}

TEST_F(PdalDamage, of_the_count_of_an_e57_is_complained_of)
{
  for (const std::size_t more : {utm_points + 1, std::size_t{99'999'999'999}}) {
    expect_complaint("cloud.e57", e57_file(e57_line_content(more)), "points and holds data of fewer");
  }
  for (const std::size_t fewer : {utm_points - 1, utm_points / 2, std::size_t{0}}) {
    expect_complaint("cloud.e57", e57_file(e57_line_content(fewer)), "points and holds data of more");
  }
}

TEST_F(PdalDamage, of_what_an_e57_says_of_its_fields_and_scans_is_complained_of)
{
  std::string content = e57_line_content(utm_points);
  const auto complains_with = [&](const std::string& old_text, const std::string& new_text, const std::string& part) {
    const std::string text = std::string(content).replace(content.find(old_text), old_text.size(), new_text);
    ASSERT_EQ(text.size(), content.size());
    expect_complaint("cloud.e57", e57_file(text), part);
  };
  complains_with("type=\"Float\"/>", "type=\"Other\"/>", "its description in XML is wrong");
  complains_with("<cartesianX", "<cartesianY", "its structure is wrong");
  complains_with("fileOffset=\"48\"", "fileOffset=\"52\"", "no points where its E57 description says");
}

TEST_F(PdalDamage, of_the_pose_of_an_e57_is_complained_of)
{
  const auto pose = [](const char* w) {
    std::string rotation = "<pose type=\"Structure\"><rotation type=\"Structure\"><w type=\"Float\">";
    rotation += w;
    for (const char* name : {"x", "y", "z"}) {
      rotation.append("<").append(name).append(" type=\"Float\"/>");
    }
    return rotation.replace(rotation.find("<x"), 0, "</w>") + "</rotation></pose>";
  };
  write("good.e57", e57_file(e57_line_content(utm_points, pose("1"))));
  EXPECT_EQ(read_points(path("good.e57"), Parallel(1)).size(), utm_points);
  std::filesystem::remove(path("good.e57"));
  for (const char* w : {"0", "5", "nan"}) {
    expect_complaint("cloud.e57", e57_file(e57_line_content(utm_points, pose(w))), "whose pose is no rotation");
  }
}

TEST_F(PdalDamage, of_an_e57_is_told_without_the_names_of_a_library)
{
  const std::string good = e57_file(e57_line_content(utm_points));
  expect_complaint("text.e57", "1 2 3", "is not an E57 file");
  expect_complaint("cut.e57", good.substr(0, good.size() - e57_page_bytes), "cut short");
  expect_complaint("long.e57", good + std::string(e57_page_bytes, '\0'), "longer than its E57 header announces");
  std::string flipped = good;
  flipped[good.size() / 2] ^= 1;
  expect_complaint("flipped.e57", flipped, "PDAL cannot read it (");
  EXPECT_EQ(errors().find("readers.e57"), std::string::npos) << errors();
}

TEST_F(PdalDamage, of_packed_points_does_not_end_the_program)
{
  for (const auto& [name, driver] :
       {std::pair("cloud.laz", "writers.las"), std::pair("cloud.copc.laz", "writers.copc")}) {
    const std::string good = make(name, driver);
    std::vector<std::size_t> places = range(good.size() / 2, good.size() / 2 + 100);
    flip_bytes(name, good, places, as_it_is);
  }
}

TEST_F(PdalDamage, does_not_make_up_a_point_that_only_the_header_announces)
{
  constexpr auto one_more = static_cast<std::uint32_t>(utm_points + 1);
  const std::string laz = make("cloud.laz", "writers.las");
  expect_complaint("cloud.laz", with_number(laz, las_1_2_count_at, one_more), "end of file");
  const std::string copc = make("cloud.copc.laz", "writers.copc");
  expect_complaint("cloud.copc.laz", with_number(copc, las_1_4_count_at, std::uint64_t{one_more}), "cut short");
}

TEST_F(PdalDamage, of_the_length_of_records_is_complained_of)
{
  for (const std::uint16_t length : std::initializer_list<std::uint16_t>{21, 31, 36, 40, 100, 500}) {
    expect_complaint("cloud.laz", with_number(make("cloud.laz", "writers.las"), record_bytes_at, length),
                     "LASzip record");
  }
  for (const std::uint16_t length : std::initializer_list<std::uint16_t>{31, 36, 40, 100, 500}) {
    expect_complaint("cloud.copc.laz", with_number(make("cloud.copc.laz", "writers.copc"), record_bytes_at, length),
                     "damaged; copy it again");
  }
}

TEST_F(PdalDamage, of_the_count_is_complained_of_if_there_are_more_points)
{
  const std::string laz = make("cloud.laz", "writers.las");
  const std::string copc = make("cloud.copc.laz", "writers.copc");
  for (const std::size_t count : {utm_points - 1, utm_points / 2, std::size_t{1}}) {
    expect_complaint("cloud.laz", with_number(laz, las_1_2_count_at, static_cast<std::uint32_t>(count)), "goes on");
    expect_complaint("cloud.copc.laz", with_number(copc, las_1_4_count_at, std::uint64_t{count}), "goes on");
  }
}

TEST_F(PdalDamage, is_not_seen_in_packed_points_that_take_next_to_no_room)
{
  constexpr std::size_t chunk_points = 50000;  // of PDAL
  for (const std::size_t count : {std::size_t{1}, std::size_t{2}, chunk_points, chunk_points + 1}) {
    LasFile las(2, 0, 20);
    for (std::size_t i = 0; i < count; ++i) {
      las.add(las_record(static_cast<std::int32_t>(i), 0, 0, 2));
    }
    write("line.las", las.bytes());
    ASSERT_EQ(write_with_pdal(path("line.las"), path("line.laz"), "writers.las"), count);
    EXPECT_EQ(read_points(path("line.laz"), Parallel(1)).size(), count);
  }
}

TEST_F(PdalDamage, of_the_scale_or_offset_of_packed_points_is_complained_of)
{
  for (const auto& [name, driver] :
       {std::pair("cloud.laz", "writers.las"), std::pair("cloud.copc.laz", "writers.copc")}) {
    const std::string good = make(name, driver);
    expect_complaint(name, with_number(good, x_scale_at, 0.01), "outside the bounds in its LAS header (x from");
    expect_complaint(name, with_number(good, x_offset_at, 500001.0), "outside the bounds in its LAS header (x from");
  }
}

TEST_F(PdalDamage, of_the_reference_system_does_not_matter)
{
  const std::string good = make("cloud.laz", "writers.las", "EPSG:32633");
  std::string damaged = good;
  const std::size_t user = good.find("LASF_Projection");
  ASSERT_NE(user, std::string::npos);
  const std::size_t content = user + 52;  // of the first record about it
  damaged.replace(content, 8, "\xff\xff\xff\x7f\xff\xff\xff\x7f");
  write("good.laz", good);
  write("damaged.laz", damaged);
  ASSERT_EQ(run("-q good.laz good.ply"), 0) << errors();
  ASSERT_EQ(run("-q damaged.laz damaged.ply"), 0) << errors();
  EXPECT_EQ(read("damaged.ply"), read("good.ply"));
}

}  // namespace
}  // namespace pds
