// SPDX-License-Identifier: BSD-3-Clause
// Feeds arbitrary bytes to the readers of files: each gives points or throws InvalidInput, and nothing else. The first
// byte chooses the reader.
#include <pcl_pds_recon/options.h>
#include <pcl_pds_recon/parallel.h>
#include <cstddef>
#include <cstdint>
#include <string>
#include "compare/face_readers.h"
#include "io/byte_source.h"
#include "io/las_reader.h"
#include "io/laz_check.h"
#include "io/obj_reader.h"
#include "io/pcd_reader.h"
#include "io/ply_reader.h"
#include "io/text_reader.h"

namespace
{

void read(unsigned format, const std::string& bytes)
{
  const pds::Parallel serial(1);
  switch (format) {
    case 0:
      static_cast<void>(pds::read_ply(pds::ByteSource(bytes), serial));
      break;
    case 1:
      static_cast<void>(pds::read_pcd(pds::ByteSource(bytes), serial));
      break;
    case 2:
      static_cast<void>(pds::read_las(pds::ByteSource(bytes), serial));
      break;
    case 3:
      pds::check_laz(pds::ByteSource(bytes));
      break;
    case 4:
      static_cast<void>(pds::read_obj(bytes));
      break;
    case 5:
      static_cast<void>(pds::read_text(bytes));
      break;
    case 6:
      static_cast<void>(pds::read_stl(bytes));
      break;
    default:
      break;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  constexpr unsigned formats = 7;
  if (size < 2) return 0;
  try {
    read(data[0] % formats, std::string(reinterpret_cast<const char*>(data + 1), size - 1));
  } catch (const pds::InvalidInput&) {
    // What it should say of bytes that are no such file.
  }
  return 0;
}
