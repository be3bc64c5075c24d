// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/ply_header.h"
#include "io/text_scanner.h"

#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <boost/endian/conversion.hpp>
#include <cstring>
#include <limits>
#include <string>

namespace pds
{

[[noreturn]] inline void throw_truncated_ply()
{
  throw InvalidInput("holds fewer data than its PLY header announces: the file is cut short; copy it again");
}

/** \brief The scalars of a binary body, one after the other. */
class BinaryBody
{
 public:
  BinaryBody(std::string_view data, boost::endian::order order) : data_(data), order_(order) {}

  template <typename Scalar>
  Scalar next(Scalar scalar)
  {
    require(sizeof scalar);
    char bytes[sizeof scalar];
    std::memcpy(bytes, data_.data() + position_, sizeof scalar);
    if (order_ != boost::endian::order::native) {
      std::reverse(std::begin(bytes), std::end(bytes));
    }
    std::memcpy(&scalar, bytes, sizeof scalar);
    position_ += sizeof scalar;
    return scalar;
  }

  void skip(ScalarType type, std::uint64_t count)
  {
    if (count > (data_.size() - position_) / size_of(type)) {
      throw_truncated_ply();
    }
    position_ += static_cast<std::size_t>(count) * size_of(type);
  }

  [[nodiscard]] std::size_t remaining() const { return data_.size() - position_; }
  [[nodiscard]] bool has_more(std::size_t least_row_bytes) const { return remaining() >= least_row_bytes; }
  static std::size_t least_bytes(ScalarType type) { return size_of(type); }

 private:
  void require(std::size_t bytes) const
  {
    if (data_.size() - position_ < bytes) {
      throw_truncated_ply();
    }
  }

  std::string_view data_;
  boost::endian::order order_;
  std::size_t position_ = 0;
};

/** \brief The scalars of an ascii body, one after the other. Line ends count as blanks, as in other readers. */
class AsciiBody
{
 public:
  explicit AsciiBody(std::string_view data) : size_(data.size()), scanner_(data) {}

  template <typename Scalar>
  Scalar next(Scalar scalar)
  {
    const std::string_view token = next_token();
    if (!parse_scalar(token, scalar)) {
      throw InvalidInput("'" + std::string(token.substr(0, 40)) +
                         "' is not a value of the type that the PLY header announces; correct the value or the type");
    }
    return scalar;
  }

  void skip(ScalarType /*type*/, std::uint64_t count)
  {
    for (std::uint64_t i = 0; i < count; ++i) {
      static_cast<void>(next_token());
    }
  }

  [[nodiscard]] std::size_t remaining() const { return size_ - scanner_.position(); }
  [[nodiscard]] bool has_more(std::size_t /*least_row_bytes*/)
  {
    std::string_view token;
    return scanner_.next_token(token);
  }
  static std::size_t least_bytes(ScalarType /*type*/) { return 1; }

 private:
  std::string_view next_token()
  {
    std::string_view token;
    if (!scanner_.next_token(token)) {
      throw_truncated_ply();
    }
    return token;
  }

  std::size_t size_;
  TextScanner scanner_;
};

/** \brief The length at the head of a list. */
template <typename Body>
std::uint32_t read_list_size(Body& body, ScalarType size_type)
{
  const double size = visit_scalar(size_type, [&body](auto zero) { return static_cast<double>(body.next(zero)); });
  if (!(size >= 0 && size <= std::numeric_limits<std::uint32_t>::max())) {
    throw InvalidInput("a PLY list has an impossible length: the file is damaged; write it again");
  }
  return static_cast<std::uint32_t>(size);
}

template <typename Body>
void skip_list(Body& body, ScalarType size_type, ScalarType type)
{
  body.skip(type, read_list_size(body, size_type));
}

/** \brief Passes over all rows of an element. */
template <typename Body>
void skip_element(Body& body, const PlyElement& element)
{
  if (element.properties.empty()) {
    return;
  }
  for (std::uint64_t row = 0; row < element.count; ++row) {
    for (const PlyProperty& property : element.properties) {
      if (property.list_size_type) {
        skip_list(body, *property.list_size_type, property.type);
      } else {
        body.skip(property.type, 1);
      }
    }
  }
}

/** \brief Calls \a visitor with the body of the file in its encoding. */
template <typename Visitor>
decltype(auto) visit_ply_body(const PlyHeader& header, std::string_view file, Visitor&& visitor)
{
  const std::string_view data = file.substr(header.bytes);
  switch (header.encoding) {
    case PlyEncoding::ascii:
      return visitor(AsciiBody(data));
    case PlyEncoding::little_endian:
      return visitor(BinaryBody(data, boost::endian::order::little));
    case PlyEncoding::big_endian:
      break;
  }
  return visitor(BinaryBody(data, boost::endian::order::big));
}

}  // namespace pds
