// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/number_at.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace pds
{

using Json = nlohmann::json;

/** \brief The parts of a .glb file, read by the book. */
struct Glb
{
  Json description;
  std::string binary;

  [[nodiscard]] std::vector<double> vector(const char* attribute, std::size_t row) const
  {
    const Json& accessor = description["accessors"][primitive()["attributes"][attribute].get<std::size_t>()];
    const std::size_t size = accessor["type"] == "VEC4" ? 4 : 3;
    const bool is_float = accessor["componentType"] == 5126;
    const std::size_t bytes = is_float ? sizeof(float) : sizeof(std::uint16_t);
    const std::size_t begin = description["bufferViews"][accessor["bufferView"].get<std::size_t>()]["byteOffset"];
    std::vector<double> values;
    for (std::size_t i = 0; i < size; ++i) {
      const char* place = binary.data() + begin + (row * size + i) * bytes;
      values.push_back(is_float ? static_cast<double>(number_at<float>(place))
                                : number_at<std::uint16_t>(place) / 65535.0);
    }
    return values;
  }

  [[nodiscard]] const Json& primitive() const { return description["meshes"][0]["primitives"][0]; }
};

/** \brief Takes a file apart, and checks its head and the heads of its chunks. */
inline Glb parse_glb(const std::string& bytes)
{
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(number_at<std::uint32_t>(&bytes[4]), 2U);
  EXPECT_EQ(number_at<std::uint32_t>(&bytes[8]), bytes.size());
  const auto text_bytes = number_at<std::uint32_t>(&bytes[12]);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  EXPECT_EQ(text_bytes % 4, 0U);
  const auto binary_bytes = number_at<std::uint32_t>(&bytes[20 + text_bytes]);
  EXPECT_EQ(bytes.substr(24 + text_bytes, 4), std::string("BIN\0", 4));
  EXPECT_EQ(28 + text_bytes + binary_bytes, bytes.size());
  return {Json::parse(bytes.substr(20, text_bytes)), bytes.substr(28 + text_bytes)};
}

}  // namespace pds
