# SPDX-License-Identifier: BSD-3-Clause
# The programs: each is built if its libraries are there.
find_package(Boost QUIET COMPONENTS program_options)
find_package(nlohmann_json QUIET)
find_package(spdlog QUIET)
find_package(VTK 9.0 QUIET COMPONENTS CommonCore CommonDataModel FiltersCore IOImage IOPLY RenderingCore
                                      RenderingOpenGL2)

set(missing "")
if(NOT TARGET Boost::program_options)
  list(APPEND missing "Boost.Program_options (libboost-program-options-dev)")
endif()
if(NOT nlohmann_json_FOUND)
  list(APPEND missing "nlohmann-json (nlohmann-json3-dev)")
endif()
if(NOT spdlog_FOUND)
  list(APPEND missing "spdlog (libspdlog-dev)")
endif()
list(JOIN missing ", " missing)

if(missing)
  list(APPEND left_out "command tool (not found: ${missing})")
else()
  add_subdirectory(tools)
endif()

if(TARGET Boost::program_options)
  add_subdirectory(tools/generate)
  if(VTK_FOUND)
    add_subdirectory(tools/render)
  else()
    list(APPEND left_out "mesh renderer (VTK not found: libvtk9-dev)")
  endif()
endif()
