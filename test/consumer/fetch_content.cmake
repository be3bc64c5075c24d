# SPDX-License-Identifier: BSD-3-Clause
cmake_minimum_required(VERSION 3.16)
include("${CMAKE_CURRENT_LIST_DIR}/common.cmake")

# Builds and runs a project that takes this one in by FetchContent, which calls add_subdirectory.
set(CONFIG Debug) # the library is built once more: quickly
build_and_run("${CMAKE_CURRENT_LIST_DIR}/fetch_content" "-DFETCHCONTENT_SOURCE_DIR_PCL_PDS_RECON=${PROJECT_SOURCE}"
              "-DCMAKE_CXX_COMPILER_LAUNCHER=${CXX_LAUNCHER}")
