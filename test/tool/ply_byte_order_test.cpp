// SPDX-License-Identifier: BSD-3-Clause
#include "ply_testing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pds
{
namespace
{

template <typename Scalar>
std::string points_in_order(bool is_big, const std::vector<Scalar>& numbers, const std::string& after_each_point = "")
{
  std::string bytes;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::string number = bytes_of(numbers[i]);
    bytes += (is_big ? big_endian(number) : number) + (i % 3 == 2 ? after_each_point : "");
  }
  return bytes;
}

/** Of a scanned surface. */
template <typename Scalar>
std::vector<Scalar> surface_numbers()
{
  std::vector<Scalar> numbers;
  for (int i = 0; i < 300; ++i) {
    const double t = 0.1 * i;
    numbers.insert(numbers.end(), {static_cast<Scalar>(std::cos(t)), static_cast<Scalar>(std::sin(t) + 400),
                                   static_cast<Scalar>(0.37 * t)});
  }
  return numbers;
}

/** Whose z are the roundings of zero. */
std::vector<float> flat_numbers()
{
  std::vector<float> numbers = surface_numbers<float>();
  for (std::size_t i = 2; i < numbers.size(); i += 3) {
    numbers[i] *= 1e-17F;
  }
  return numbers;
}

const std::string both_orders[] = {"binary_little_endian", "binary_big_endian"};

template <typename Scalar>
std::string complaint_in_order(bool says_big,
                               bool is_big,
                               const std::vector<Scalar>& numbers,
                               const std::string& properties)
{
  const std::string file = header(both_orders[says_big ? 1 : 0], std::to_string(numbers.size() / 3), properties) +
                           points_in_order(is_big, numbers);
  return complaint([&file] { return read_ply(file); });
}

TEST(PlyByteOrder, is_found_to_be_wrong)
{
  const std::vector<float> cube = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};
  std::vector<float> with_missing = surface_numbers<float>();
  std::fill_n(with_missing.begin(), 600, std::numeric_limits<float>::quiet_NaN());
  for (const bool is_big : {false, true}) {
    const std::string expected = is_big ? "little endian, but coordinates that make sense only as big endian"
                                        : "big endian, but coordinates that make sense only as little endian";
    const auto is_found = [&](const std::string& found) { return found.find(expected) != std::string::npos; };
    EXPECT_TRUE(is_found(complaint_in_order(!is_big, is_big, surface_numbers<float>(), xyz_float)));
    EXPECT_TRUE(is_found(complaint_in_order(!is_big, is_big, surface_numbers<double>(), xyz_double)));
    EXPECT_TRUE(is_found(complaint_in_order(!is_big, is_big, cube, xyz_float)));
    EXPECT_TRUE(is_found(complaint_in_order(!is_big, is_big, with_missing, xyz_float)));
    EXPECT_TRUE(is_found(complaint_in_order(!is_big, is_big, flat_numbers(), xyz_float)));
  }
  const std::string with_lists = header("binary_big_endian", "300", xyz_float + "property list uchar float more\n") +
                                 points_in_order(false, surface_numbers<float>(), std::string(1, '\0'));
  EXPECT_NE(complaint([&] { return read_ply(with_lists); }).find("only as little endian"), std::string::npos);
  const std::string with_faces =
      header("binary_big_endian", "300", xyz_float + "element face 9\nproperty list int int vertex_indices\n") +
      points_in_order(false, surface_numbers<float>()) + std::string(100, '\1');
  EXPECT_NE(complaint([&] { return read_ply(with_faces); }).find("only as little endian"), std::string::npos);
}

TEST(PlyByteOrder, is_believed_of_odd_coordinates)
{
  std::vector<float> missing = surface_numbers<float>();
  std::fill_n(missing.begin(), 700, std::numeric_limits<float>::quiet_NaN());
  std::vector<float> far = surface_numbers<float>();
  std::fill_n(far.begin(), 700, std::numeric_limits<float>::max());
  std::vector<float> tiny = surface_numbers<float>();
  std::transform(tiny.begin(), tiny.end(), tiny.begin(), [](float number) { return number * 1e-20F; });
  std::vector<float> line = surface_numbers<float>();
  for (std::size_t i = 0; i < line.size(); i += 3) {
    line[i + 1] = line[i + 2] = 1e-17F * line[i];
  }
  const std::vector<std::vector<float>> clouds = {surface_numbers<float>(),
                                                  std::vector<float>(300, 0.F),
                                                  {0x1p-140F, 0x1p-139F, 0x1p-138F},
                                                  missing,
                                                  far,
                                                  tiny,
                                                  flat_numbers(),
                                                  line};
  for (const bool is_big : {false, true}) {
    for (const std::vector<float>& cloud : clouds) {
      EXPECT_EQ(complaint_in_order(is_big, is_big, cloud, xyz_float), "") << &cloud - clouds.data();
    }
    EXPECT_EQ(complaint_in_order(is_big, is_big, std::vector<std::int32_t>(300, 0x01000000),
                                 "property int x\nproperty int y\nproperty int z\n"),
              "");
  }
}

}  // namespace
}  // namespace pds
