# SPDX-License-Identifier: BSD-3-Clause
# Debian packages, made by cpack in the build directory: the library, what is needed to build against it, the programs.
set(abi_version "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
set(package_of_library "libpcl-pds-recon${abi_version}")
set(package_of_dev libpcl-pds-recon-dev)
set(package_of_tools pcl-pds-recon)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME pcl-pds-recon)
set(CPACK_PACKAGE_VENDOR "the authors of pcl_pds_recon")
set(CPACK_PACKAGE_CONTACT "The pcl_pds_recon authors <noreply@pcl-pds-recon.example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "surface reconstruction through Poisson-disk sampling")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL library dev tools)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${package_of_library})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME ${package_of_dev})
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev, libpcl-dev (>= 1.13)")
set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME ${package_of_tools})
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
# Pictures without a display.
set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS xvfb)
# Where the programs' own libraries are, which no installed package provides yet.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/pcl_pds_recon")

# Which package a program needs that links the libraries, and that the linker's cache is to be renewed. Written here
# because CPack would look for such names in the plugins of the programs as well.
set(debian_dir "${PROJECT_BINARY_DIR}/debian")
set(shlibs "")
foreach(library IN LISTS installed_libraries)
  string(APPEND shlibs "lib${library} ${abi_version} ${package_of_library} (>= ${abi_version})\n")
endforeach()
file(WRITE "${debian_dir}/shlibs" "${shlibs}")
file(WRITE "${debian_dir}/triggers" "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA "${debian_dir}/shlibs;${debian_dir}/triggers")

# The files that Debian wants in each package; a plain installation has no use for them.
file(READ "${PROJECT_SOURCE_DIR}/LICENSE" license)
string(REGEX MATCH "Copyright \\(c\\) ([^\n]*)\n[^\n]*\n\n(.*[^\n])\n*$" license "${license}")
set(copyright_holder "${CMAKE_MATCH_1}")
string(REPLACE "\n\n" "\n.\n" license_paragraphs "${CMAKE_MATCH_2}")
string(REPLACE "\n" "\n " license_paragraphs " ${license_paragraphs}")
string(TIMESTAMP build_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(component IN ITEMS library dev tools)
  set(package ${package_of_${component}})
  set(more_paragraphs "")
  if(component STREQUAL tools AND MODEL_VIEWER_SCRIPT)
    file(READ "${PROJECT_SOURCE_DIR}/cmake/debian/model_viewer_copyright" more_paragraphs)
  endif()
  configure_file(cmake/debian/copyright.in "${debian_dir}/${package}/copyright" @ONLY)
  configure_file(cmake/debian/changelog.in "${debian_dir}/${package}/changelog" @ONLY)
  set(documents "${debian_dir}/${package}/copyright")
  if(GZIP)
    execute_process(COMMAND "${GZIP}" -9 --no-name --force --keep "${debian_dir}/${package}/changelog")
    list(APPEND documents "${debian_dir}/${package}/changelog.gz")
  endif()
  install(FILES ${documents} DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${package}" COMPONENT ${component}
                                                                                  EXCLUDE_FROM_ALL)
endforeach()

include(CPack)
cpack_add_component(
  library
  DESCRIPTION
    "A dense point cloud becomes an oriented manifold triangle mesh, whose
vertices are a Poisson-disk subset of the points.
This package has the shared libraries: the method, the class for the Point
Cloud Library, and the comparison of meshes.")
cpack_add_component(
  dev
  DESCRIPTION
    "A dense point cloud becomes an oriented manifold triangle mesh, whose
vertices are a Poisson-disk subset of the points.
This package has what programs are built with: headers, and files for CMake
and pkg-config."
  DEPENDS library)
cpack_add_component(
  tools
  DESCRIPTION
    "A dense point cloud becomes an oriented manifold triangle mesh, whose
vertices are a Poisson-disk subset of the points.
This package has the programs: pcl_pds_recon makes meshes, pcl_pds_compare
judges them, pcl_pds_viewer shows them."
  DEPENDS library)
