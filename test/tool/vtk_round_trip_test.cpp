// SPDX-License-Identifier: BSD-3-Clause
// VTK's own readers as the judges of what .vtp and .vtk hold.
#include "all_types.h"
#include "io/write_mesh.h"
#include "temporary_directory.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>

namespace pds
{
namespace
{

template <typename Reader>
vtkSmartPointer<vtkPolyData> read_with(const std::string& file)
{
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

class VtkRoundTrip : public TemporaryDirectory
{
 protected:
  /** Whether an array's bytes are those of these fields side by side. */
  static void expect_same(const PointTable& points, const std::vector<const char*>& names, vtkDataArray* array)
  {
    ASSERT_NE(array, nullptr) << names.front();
    ASSERT_EQ(array->GetNumberOfComponents(), static_cast<int>(names.size())) << names.front();
    ASSERT_EQ(array->GetNumberOfTuples(), static_cast<vtkIdType>(points.size())) << names.front();
    const auto* bytes = static_cast<const std::byte*>(array->GetVoidPointer(0));
    for (std::size_t row = 0; row < points.size(); ++row) {
      for (const char* name : names) {
        const Field& field = *points.find(name);
        ASSERT_EQ(static_cast<std::size_t>(array->GetDataTypeSize()), size_of(field.type)) << name;
        EXPECT_EQ(std::memcmp(bytes, points.record(row) + field.offset, size_of(field.type)), 0)
            << name << " of row " << row;
        bytes += size_of(field.type);
      }
    }
  }

  void expect_round_trip(const std::string& name, bool ascii)
  {
    SCOPED_TRACE(name + (ascii ? " as text" : ""));
    const PointTable points = points_with(all_types());
    const std::string extension = name.substr(name.find('.'));
    AtomicFile file(path(name));
    write_mesh(file, extension, points, {{0, 1, 2}}, ascii, {{0, 1}, {1, 2}});
    file.finish();
    file.commit();
    const auto mesh =
        extension == ".vtp" ? read_with<vtkXMLPolyDataReader>(path(name)) : read_with<vtkPolyDataReader>(path(name));
    EXPECT_EQ(mesh->GetPolys()->GetNumberOfCells(), 1);
    ASSERT_EQ(mesh->GetLines()->GetNumberOfCells(), 2);
    vtkNew<vtkIdList> ends;
    mesh->GetLines()->GetCellAtId(1, ends);
    EXPECT_EQ(ends->GetId(0), 1);
    EXPECT_EQ(ends->GetId(1), 2);
    expect_same(points, {"x", "y", "z"}, mesh->GetPoints()->GetData());
    expect_same(points, {"nx", "ny", "nz"}, mesh->GetPointData()->GetNormals());
    expect_same(points, {"red", "green", "blue"}, mesh->GetPointData()->GetArray("RGB"));
    for (const Field& field : all_types()) {
      expect_same(points, {field.name.c_str()}, mesh->GetPointData()->GetArray(field.name.c_str()));
    }
  }
};

TEST_F(VtkRoundTrip, of_vtp_gives_every_bit_of_every_field_back) { expect_round_trip("mesh.vtp", false); }
TEST_F(VtkRoundTrip, of_vtp_as_text_gives_every_bit_of_every_field_back) { expect_round_trip("mesh.vtp", true); }
TEST_F(VtkRoundTrip, of_vtk_gives_every_bit_of_every_field_back) { expect_round_trip("mesh.vtk", false); }

/** A PLY may call a field anything, XML may not. */
TEST_F(VtkRoundTrip, of_vtp_changes_names_that_would_be_markup)
{
  const PointTable points = points_with({{"a<b&\"c>", ScalarType::float32}, {"h\xff", ScalarType::uint8}});
  AtomicFile file(path("mesh.vtp"));
  write_mesh(file, ".vtp", points, {{0, 1, 2}}, false, {});
  file.finish();
  file.commit();
  const auto mesh = read_with<vtkXMLPolyDataReader>(path("mesh.vtp"));
  expect_same(points, {"a<b&\"c>"}, mesh->GetPointData()->GetArray("a_b__c_"));
  expect_same(points, {"h\xff"}, mesh->GetPointData()->GetArray("h_"));
}

}  // namespace
}  // namespace pds
