# SPDX-License-Identifier: BSD-3-Clause
cmake_minimum_required(VERSION 3.16)
include("${CMAKE_CURRENT_LIST_DIR}/common.cmake")

# Installs into an empty prefix, and builds and runs a program for each library with nothing but the compiler and
# pkg-config.
run("${CMAKE_COMMAND}" --install "${PROJECT_BUILD}" --prefix "${WORK_DIR}/prefix" --config "${CONFIG}")
file(GLOB_RECURSE module "${WORK_DIR}/prefix/*/pcl_pds_recon.pc")
get_filename_component(module_dir "${module}" DIRECTORY)
get_filename_component(library_dir "${module_dir}" DIRECTORY)
set(ENV{PKG_CONFIG_PATH} "${module_dir}")
set(module_of_core pcl_pds_recon_core)
set(module_of_pcl_class pcl_pds_recon)
set(module_of_compare pcl_pds_recon_compare)
separate_arguments(cxx_flags UNIX_COMMAND "${CXX_FLAGS}")
foreach(program IN LISTS programs)
  execute_process(
    COMMAND "${PKG_CONFIG}" --cflags --libs ${module_of_${program}}
    OUTPUT_VARIABLE flags
    OUTPUT_STRIP_TRAILING_WHITESPACE
    RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "pkg-config does not know ${module_of_${program}}")
  endif()
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run("${CXX_COMPILER}" -std=c++17 ${cxx_flags} "${CMAKE_CURRENT_LIST_DIR}/project/${program}.cpp" -o ${program}
      ${flags} "-Wl,-rpath,${library_dir}")
  run("${WORK_DIR}/${program}")
endforeach()
