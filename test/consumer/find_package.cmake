# SPDX-License-Identifier: BSD-3-Clause
cmake_minimum_required(VERSION 3.16)
include("${CMAKE_CURRENT_LIST_DIR}/common.cmake")

# Installs into an empty prefix, and builds and runs a project that finds the library there by find_package.
run("${CMAKE_COMMAND}" --install "${PROJECT_BUILD}" --prefix "${WORK_DIR}/prefix" --config "${CONFIG}")
build_and_run("${CMAKE_CURRENT_LIST_DIR}/project" "-DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix")
