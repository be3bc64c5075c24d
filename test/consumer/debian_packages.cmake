# SPDX-License-Identifier: BSD-3-Clause
cmake_minimum_required(VERSION 3.16)
include("${CMAKE_CURRENT_LIST_DIR}/common.cmake")

# Makes the Debian packages, unpacks them into an empty root, and builds and runs a project against what is there.
run("${CPACK}" --config "${PROJECT_BUILD}/CPackConfig.cmake" -C "${CONFIG}" -B "${WORK_DIR}/packages")
set(wanted "lib/${LIBRARY_ARCHITECTURE}/libpcl_pds_recon_core.so" share/pcl_pds_recon/config/dragon.ini)
foreach(package IN ITEMS libpcl-pds-recon[0-9]* libpcl-pds-recon-dev pcl-pds-recon)
  file(GLOB file "${WORK_DIR}/packages/${package}_*.deb")
  run("${DPKG_DEB}" --extract "${file}" "${WORK_DIR}/root")
  execute_process(COMMAND "${DPKG_DEB}" --show --showformat "\${Package}\;\${Maintainer}" "${file}"
                  OUTPUT_VARIABLE fields)
  list(GET fields 0 name)
  list(GET fields 1 maintainer)
  list(APPEND wanted "share/doc/${name}/copyright")
  if(NOT maintainer MATCHES "^[^<>@]+ <[^<>@ ]+@[^<>@ ]+>$")
    message(FATAL_ERROR "${name} has the maintainer '${maintainer}', who cannot be written to")
  endif()
endforeach()
foreach(path IN LISTS wanted)
  if(NOT EXISTS "${WORK_DIR}/root/usr/${path}")
    message(FATAL_ERROR "the packages lack /usr/${path}")
  endif()
endforeach()
execute_process(
  COMMAND "${WORK_DIR}/root/usr/bin/pcl_pds_recon" --version
  OUTPUT_VARIABLE output
  RESULT_VARIABLE result)
if(NOT result EQUAL 0 OR NOT output STREQUAL "pcl_pds_recon ${VERSION}\n")
  message(FATAL_ERROR "the packaged program says '${output}', exit status ${result}")
endif()
build_and_run("${CMAKE_CURRENT_LIST_DIR}/project" "-DCMAKE_PREFIX_PATH=${WORK_DIR}/root/usr")
