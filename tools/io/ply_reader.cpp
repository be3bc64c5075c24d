// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_reader.h"

#include "io/ply_header.h"
#include "io/text_scanner.h"

#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <boost/endian/conversion.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

namespace pds
{

namespace
{

[[noreturn]] void throw_truncated()
{
  throw InvalidInput("holds fewer data than its PLY header announces: the file is cut short; copy it again");
}

/** The scalars of a binary body, one after the other. */
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
      throw_truncated();
    }
    position_ += static_cast<std::size_t>(count) * size_of(type);
  }

  [[nodiscard]] std::size_t remaining() const { return data_.size() - position_; }
  static std::size_t least_bytes(ScalarType type) { return size_of(type); }

 private:
  void require(std::size_t bytes) const
  {
    if (data_.size() - position_ < bytes) {
      throw_truncated();
    }
  }

  std::string_view data_;
  boost::endian::order order_;
  std::size_t position_ = 0;
};

/** The scalars of an ascii body, one after the other. Line ends count as blanks, as in other readers. */
class AsciiBody
{
 public:
  explicit AsciiBody(std::string_view data) : size_(data.size()), scanner_(data) {}

  template <typename Scalar>
  Scalar next(Scalar scalar)
  {
    const std::string_view token = next_token();
    if (!parse_number(token, scalar) && !parse_whole(token, scalar)) {
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
  static std::size_t least_bytes(ScalarType /*type*/) { return 1; }

 private:
  std::string_view next_token()
  {
    std::string_view token;
    if (!scanner_.next_token(token)) {
      throw_truncated();
    }
    return token;
  }

  /** Some tools write integers as 255.000000. */
  template <typename Scalar>
  static bool parse_whole(std::string_view token, Scalar& scalar)
  {
    double value = 0;
    if (!std::is_integral_v<Scalar> || !parse_number(token, value) || std::trunc(value) != value ||
        value < static_cast<double>(std::numeric_limits<Scalar>::lowest()) ||
        value > static_cast<double>(std::numeric_limits<Scalar>::max())) {
      return false;
    }
    scalar = static_cast<Scalar>(value);
    return true;
  }

  std::size_t size_;
  TextScanner scanner_;
};

/** A property of the file and where its scalar goes. */
struct Column
{
  ScalarType type;
  std::optional<ScalarType> list_size_type;
  const Field* target;  ///< nullptr for a list
};

template <typename Body>
void skip_list(Body& body, const Column& column)
{
  const double size =
      visit_scalar(*column.list_size_type, [&body](auto zero) { return static_cast<double>(body.next(zero)); });
  if (!(size >= 0 && size <= std::numeric_limits<std::uint32_t>::max())) {
    throw InvalidInput("a PLY list has an impossible length: the file is damaged; write it again");
  }
  body.skip(column.type, static_cast<std::uint64_t>(size));
}

template <typename Body>
void read_row(Body& body, const std::vector<Column>& columns, PointTable& table, std::size_t row)
{
  for (const Column& column : columns) {
    if (column.list_size_type) {
      skip_list(body, column);
      continue;
    }
    visit_scalar(column.type, [&](auto zero) {
      const auto scalar = body.next(zero);
      if (column.type == column.target->type) {
        std::memcpy(table.record(row) + column.target->offset, &scalar, sizeof scalar);
      } else {
        table.set_value(row, *column.target, static_cast<double>(scalar));
      }
    });
  }
}

template <typename Body>
void skip_element(Body& body, const PlyElement& element)
{
  if (element.properties.empty()) {
    return;
  }
  for (std::uint64_t row = 0; row < element.count; ++row) {
    for (const PlyProperty& property : element.properties) {
      if (property.list_size_type) {
        skip_list(body, Column{property.type, property.list_size_type, nullptr});
      } else {
        body.skip(property.type, 1);
      }
    }
  }
}

PointTable make_table(const PlyElement& vertex)
{
  std::vector<Field> fields;
  for (const PlyProperty& property : vertex.properties) {
    if (!property.list_size_type) {
      fields.push_back({property.name, property.type});
    }
  }
  return PointTable(std::move(fields));
}

template <typename Body>
PointTable read_vertices(Body body, const std::vector<PlyElement>& elements)
{
  auto vertex = elements.begin();
  while (vertex != elements.end() && vertex->name != "vertex") {
    skip_element(body, *vertex++);
  }
  if (vertex == elements.end()) {
    throw InvalidInput("the PLY file has no element 'vertex'; write the points as vertices");
  }
  PointTable table = make_table(*vertex);
  std::vector<Column> columns;
  std::size_t least_row_bytes = 0;
  for (const PlyProperty& property : vertex->properties) {
    const Field* target = property.list_size_type ? nullptr : table.find(property.name);
    columns.push_back({property.type, property.list_size_type, target});
    least_row_bytes += Body::least_bytes(property.list_size_type.value_or(property.type));
  }
  // Before the memory is asked for: a damaged header may announce any number of points.
  if (vertex->count > body.remaining() / least_row_bytes) {
    throw_truncated();
  }
  table.resize(static_cast<std::size_t>(vertex->count));
  for (std::size_t row = 0; row < table.size(); ++row) {
    read_row(body, columns, table, row);
  }
  return table;
}

}  // namespace

PointTable read_ply(std::string_view file)
{
  const PlyHeader header = parse_ply_header(file);
  const std::string_view data = file.substr(header.bytes);
  switch (header.encoding) {
    case PlyEncoding::ascii:
      return read_vertices(AsciiBody(data), header.elements);
    case PlyEncoding::little_endian:
      return read_vertices(BinaryBody(data, boost::endian::order::little), header.elements);
    case PlyEncoding::big_endian:
      break;
  }
  return read_vertices(BinaryBody(data, boost::endian::order::big), header.elements);
}

}  // namespace pds
