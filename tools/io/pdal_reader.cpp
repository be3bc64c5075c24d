// SPDX-License-Identifier: BSD-3-Clause
#include "io/pdal_reader.h"

#include "child_process.h"
#include "io/color_depth.h"
#include "io/las_bounds.h"
#include "io/laszip_record.h"
#include "io/laz_check.h"
#include "io/laz_copy.h"
#include "io/plugin.h"
#include "io/record_reader.h"

#include <pcl_pds_recon/options.h>

#include <sys/resource.h>
#include <unistd.h>

#include <utility>

namespace pds
{

namespace
{

[[noreturn]] void throw_child_ended()
{
  throw InvalidInput("PDAL gave up in the middle of it: the file is damaged; copy it again or write it anew");
}

/** In the child: sends the points to the parent, after a complaint, which is empty if all is well. */
class SendingSink : public PointSink
{
 public:
  explicit SendingSink(const ChildOutput& output) : output_(output) {}

  void start(const std::vector<Field>& fields, std::size_t size, const std::string& not_read) override
  {
    complain("");
    output_.send_text(not_read);
    send(size);
    send(fields.size());
    for (const Field& field : fields) {
      output_.send_text(field.name);
      send(field.type);
    }
  }

  void add(const PointTable& block, std::size_t count) override
  {
    output_.send(block.record(0), count * block.record_bytes());
  }

  void complain(const std::string& complaint) { output_.send_text(complaint); }

 private:
  template <typename Value>
  void send(const Value& value)
  {
    output_.send(&value, sizeof value);
  }

  const ChildOutput& output_;
};

/** An allocation beyond all the memory there is, as damaged files ask for, shall fail before the machine is out of it.
 */
void limit_memory()
{
#ifndef __SANITIZE_ADDRESS__  // which reserves far more than it uses
  const rlim_t bytes = static_cast<rlim_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
  const rlimit limit = {bytes, bytes};
  setrlimit(RLIMIT_DATA, &limit);
#endif
}

/** In the child. */
void read_and_send(const ChildOutput& output, const PdalSource& source)
{
  SendingSink sink(output);
  std::string complaint;
  try {
    void* function = load_plugin_function("pcl_pds_recon_pdal", "pcl_pds_recon_read_with_pdal");
    limit_memory();
    reinterpret_cast<decltype(&pcl_pds_recon_read_with_pdal)>(function)(source, sink, complaint);
  } catch (const PluginError& error) {
    complaint = std::string("cannot be read: ") + error.what() + ", or convert the file to .las or .ply";
  }
  if (!complaint.empty()) {
    sink.complain(complaint);
  }
}

std::string receive_text(const ChildProcess& child)
{
  std::optional<std::string> text = child.receive_text();
  if (!text) {
    throw_child_ended();
  }
  return std::move(*text);
}

template <typename Value>
Value receive(const ChildProcess& child)
{
  Value value{};
  if (!child.receive(&value, sizeof value)) {
    throw_child_ended();
  }
  return value;
}

PointTable read_with_pdal(const PdalSource& source)
{
  const ChildProcess child([&source](const ChildOutput& output) { read_and_send(output, source); });
  const std::string complaint = receive_text(child);
  if (!complaint.empty()) {
    throw InvalidInput(complaint);
  }
  std::string not_read = receive_text(child);
  const auto size = receive<std::size_t>(child);
  std::vector<Field> fields(receive<std::size_t>(child));
  for (Field& field : fields) {
    field.name = receive_text(child);
    field.type = receive<ScalarType>(child);
  }
  PointTable table(std::move(fields), size);
  table.not_read = std::move(not_read);
  if (!child.receive(table.record(0), size * table.record_bytes())) {
    throw_child_ended();
  }
  return with_byte_colors(std::move(table));
}

/** Whether PDAL gets the last of \a count points from what the copy still holds. */
bool has_last_point(const LazCopy& copy, std::uint64_t count)
{
  const PdalSource source = {copy.path(), "readers.las", count - 1};
  const ChildProcess child([&source](const ChildOutput& output) { read_and_send(output, source); });
  return child.receive_text() == "";
}

}  // namespace

PointTable read_laz(const std::string& path, const Parallel& parallel)
{
  const ByteSource source = ByteSource::from_file(path);
  const LazParts parts = check_laz(source);
  const LazCopy copy(source, parts);
  PointTable table = read_with_pdal({copy.path(), "readers.las"});
  if (parts.header.point_format < first_layered_format && table.size() > 0) {
    copy.drop_last_byte();
    if (has_last_point(copy, table.size())) {
      throw_data_after_points();
    }
  }
  check_las_bounds(parts.header, table, parallel);  // last: no process is made while threads start
  return table;
}

PointTable read_e57(const std::string& path) { return read_with_pdal({path, "readers.e57"}); }

}  // namespace pds
