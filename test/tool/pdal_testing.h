// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pdal/PipelineManager.hpp>

#include <string>

namespace pds
{

/** \brief Lets PDAL convert a LAS file with all that the format can hold. \param reference_system of the coordinates
 * \return the number of points */
inline std::size_t write_with_pdal(const std::string& las,
                                   const std::string& output,
                                   const std::string& driver,
                                   const std::string& reference_system = "")
{
  pdal::PipelineManager pipeline;
  pipeline.setLog(pdal::Log::makeLog("", "devnull"));
  pdal::Options reader_options;
  reader_options.add("use_eb_vlr", true);
  pdal::Stage& reader = pipeline.makeReader(las, "readers.las", reader_options);
  pdal::Options options;
  if (driver != "writers.e57") {
    options.add("forward", "all");
  }
  if (driver == "writers.copc") {  // does not forward these
    for (const auto& [axis, offset] : {std::pair("x", 500000), std::pair("y", 5000000), std::pair("z", 0)}) {
      options.add(std::string("scale_") + axis, 0.001);
      options.add(std::string("offset_") + axis, offset);
    }
  }
  if (driver == "writers.las") {
    options.add("compression", true);
    options.add("extra_dims", "all");
  }
  if (!reference_system.empty()) {
    options.add("a_srs", reference_system);
  }
  pipeline.makeWriter(output, driver, reader, options);
  return static_cast<std::size_t>(pipeline.execute());
}

}  // namespace pds
