# SPDX-License-Identifier: BSD-3-Clause
# Libraries, headers, a CMake package, find_package(pcl_pds_recon) gives pcl_pds_recon::pcl_pds_recon, and the same for
# pkg-config. The components library, dev and tools become packages of their own, see package.cmake.
include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/pcl_pds_recon")

set(installed_libraries pcl_pds_recon_core pcl_pds_recon)
if(TARGET pcl_pds_recon_compare)
  list(APPEND installed_libraries pcl_pds_recon_compare)
  get_target_property(compare_type pcl_pds_recon_compare TYPE)
endif()
set(compare_is_static OFF)
if(compare_type STREQUAL "STATIC_LIBRARY")
  set(compare_is_static ON)
endif()
install(
  TARGETS ${installed_libraries}
  EXPORT pcl_pds_recon_targets
  RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT library
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library NAMELINK_COMPONENT dev
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev
  INCLUDES
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
foreach(tool IN ITEMS pcl_pds_recon_tool pcl_pds_compare pcl_pds_viewer)
  if(TARGET ${tool})
    install(TARGETS ${tool} RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT tools)
  endif()
endforeach()
if(TARGET pcl_pds_recon_tool)
  foreach(plugin IN ITEMS pcl_pds_recon_vtk pcl_pds_recon_pdal pcl_pds_recon_deviation pcl_pds_recon_pictures)
    if(NOT TARGET ${plugin})
      continue()
    endif()
    set(component tools)
    # A Debian package cannot depend on libraries that are of none: such a PDAL is for plain installations only.
    if(plugin STREQUAL pcl_pds_recon_pdal AND NOT PDAL_DIR MATCHES "^/usr/(lib|share)/")
      set(component not_packaged)
      list(APPEND left_out "reading of .laz, COPC and .e57 in Debian packages (${PDAL_DIR} is of none)")
    endif()
    install(TARGETS ${plugin} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/pcl_pds_recon" COMPONENT ${component})
  endforeach()
endif()
if(TARGET pcl_pds_recon_tool)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/config" DESTINATION "${CMAKE_INSTALL_DATADIR}/pcl_pds_recon"
          COMPONENT tools)
endif()
if(manual_pages)
  install(FILES ${manual_pages} DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT tools)
endif()

install(
  DIRECTORY "${PROJECT_SOURCE_DIR}/pcl_pds_recon/include/" "${PROJECT_BINARY_DIR}/pcl_pds_recon/include/"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
  COMPONENT dev
  FILES_MATCHING
  PATTERN "*.h"
  PATTERN "*.hpp")

install(
  EXPORT pcl_pds_recon_targets
  NAMESPACE pcl_pds_recon::
  DESTINATION "${package_dir}"
  COMPONENT dev)
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/pcl_pds_recon-config.cmake.in"
                              "${PROJECT_BINARY_DIR}/pcl_pds_recon-config.cmake" INSTALL_DESTINATION "${package_dir}")
# Before 1.0 a new minor version may break its users.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/pcl_pds_recon-config-version.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/pcl_pds_recon-config.cmake"
              "${PROJECT_BINARY_DIR}/pcl_pds_recon-config-version.cmake" DESTINATION "${package_dir}" COMPONENT dev)

file(RELATIVE_PATH path_to_prefix "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
# A module of pkg-config for a library. private_libraries: what a static one leaves to the program.
function(pds_install_pkg_config pc_name pc_description pc_requires pc_private_libraries)
  configure_file("${PROJECT_SOURCE_DIR}/cmake/pcl_pds_recon.pc.in" "${PROJECT_BINARY_DIR}/${pc_name}.pc" @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/${pc_name}.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT dev)
endfunction()
pds_install_pkg_config(pcl_pds_recon_core "${PROJECT_DESCRIPTION}: the method, without PCL" eigen3 -pthread)
# PCL's own module names are the same in its .pc files; what the headers need of FLANN and Boost those say.
pds_install_pkg_config(pcl_pds_recon "${PROJECT_DESCRIPTION}"
                       "pcl_pds_recon_core eigen3 pcl_common pcl_search pcl_kdtree" "")
if(TARGET pcl_pds_recon_compare)
  pds_install_pkg_config(pcl_pds_recon_compare "${PROJECT_DESCRIPTION}: deviation of meshes" pcl_pds_recon_core
                         -lembree3)
endif()
# Not a part of any package: Debian has a file of its own for it, see package.cmake.
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT license)
