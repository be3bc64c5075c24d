# SPDX-License-Identifier: BSD-3-Clause
cmake_minimum_required(VERSION 3.16)
include("${CMAKE_CURRENT_LIST_DIR}/common.cmake")

# Makes the Debian packages, unpacks them into an empty root, and builds and runs a project against what is there.
run("${CPACK}" --config "${PROJECT_BUILD}/CPackConfig.cmake" -C "${CONFIG}" -B "${WORK_DIR}/packages")
foreach(package IN ITEMS libpcl-pds-recon[0-9]* libpcl-pds-recon-dev pcl-pds-recon)
  file(GLOB file "${WORK_DIR}/packages/${package}_*.deb")
  run("${DPKG_DEB}" --extract "${file}" "${WORK_DIR}/root")
endforeach()
execute_process(
  COMMAND "${WORK_DIR}/root/usr/bin/pcl_pds_recon" --version
  OUTPUT_VARIABLE output
  RESULT_VARIABLE result)
if(NOT result EQUAL 0 OR NOT output STREQUAL "pcl_pds_recon ${VERSION}\n")
  message(FATAL_ERROR "the packaged program says '${output}', exit status ${result}")
endif()
build_and_run("${CMAKE_CURRENT_LIST_DIR}/project" "-DCMAKE_PREFIX_PATH=${WORK_DIR}/root/usr")
