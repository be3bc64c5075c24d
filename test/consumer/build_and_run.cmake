# SPDX-License-Identifier: BSD-3-Clause
cmake_minimum_required(VERSION 3.16)

# Installs the library into an empty prefix, and there builds and runs a project that finds it by find_package.
file(REMOVE_RECURSE "${WORK_DIR}") # what an earlier run installed would hide a file that is no longer installed

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed with ${result}: ${ARGV}")
  endif()
endfunction()

run("${CMAKE_COMMAND}" --install "${INSTALL_FROM}" --prefix "${WORK_DIR}/prefix" --config "${CONFIG}")
run("${CMAKE_COMMAND}"
    -S "${SOURCE_DIR}"
    -B "${WORK_DIR}/build"
    -G "${GENERATOR}"
    "-DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix"
    "-DCMAKE_BUILD_TYPE=${CONFIG}"
    "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}"
    "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}")
run("${CMAKE_COMMAND}" --build "${WORK_DIR}/build" --config "${CONFIG}")
find_program(
  consumer consumer
  PATHS "${WORK_DIR}/build" "${WORK_DIR}/build/${CONFIG}"
  NO_DEFAULT_PATH)
run("${consumer}")
