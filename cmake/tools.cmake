# SPDX-License-Identifier: BSD-3-Clause
# The programs: each is built if its libraries are there.
find_package(Boost QUIET COMPONENTS program_options)
find_package(nlohmann_json QUIET)
find_library(LZF_LIBRARY lzf)
find_path(LZF_INCLUDE_DIR lzf.h PATH_SUFFIXES liblzf)
mark_as_advanced(LZF_LIBRARY LZF_INCLUDE_DIR)
find_package(spdlog QUIET)
# Parts of Debian's VTK need MPI, which CMake finds only if it may compile C.
enable_language(C)
find_package(
  VTK 9.0 QUIET
  COMPONENTS CommonCore
             CommonDataModel
             FiltersCore
             FiltersSources
             IOImage
             IOLegacy
             IOXML
             InteractionStyle
             RenderingAnnotation
             RenderingCore
             RenderingFreeType
             RenderingOpenGL2)
find_package(X11 QUIET)

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
if(NOT LZF_LIBRARY OR NOT LZF_INCLUDE_DIR)
  list(APPEND missing "LibLZF (liblzf-dev)")
endif()
list(JOIN missing ", " missing)

if(missing)
  list(APPEND left_out "command tool (not found: ${missing})")
else()
  include("${PROJECT_SOURCE_DIR}/cmake/model_viewer.cmake")
  if(NOT MODEL_VIEWER_SCRIPT)
    list(APPEND left_out "mesh to turn in pages of --html (${MODEL_VIEWER_MISSING})")
  endif()
  add_subdirectory(tools)
  if(NOT TARGET pcl_pds_recon_pdal)
    list(APPEND left_out "reading of .laz, COPC and .e57 (PDAL 2.4 not found, which Debian 12 does not have)")
  endif()
  if(NOT TARGET pcl_pds_recon_vtk)
    list(APPEND left_out "writing of .vtk and .vtp (VTK not found: libvtk9-dev)")
  endif()
  if(TARGET pcl_pds_recon_compare)
    add_subdirectory(tools/compare)
    if(VTK_FOUND AND X11_FOUND)
      add_subdirectory(tools/render)
      add_subdirectory(tools/viewer)
    endif()
    add_subdirectory(tools/html)
  endif()
  if(NOT TARGET pcl_pds_viewer)
    list(APPEND left_out "viewer, pictures of deviations and pages (one not found: libembree-dev, libvtk9-dev, libx11-dev)")
  endif()
endif()

if(TARGET Boost::program_options)
  add_subdirectory(tools/generate)
endif()
