# SPDX-License-Identifier: BSD-3-Clause
# What the tests of a user's build share. WORK_DIR is emptied: what an earlier run left would hide a file that is no
# longer installed.
file(REMOVE_RECURSE "${WORK_DIR}")
file(MAKE_DIRECTORY "${WORK_DIR}")

function(run)
  execute_process(COMMAND ${ARGV} WORKING_DIRECTORY "${WORK_DIR}" RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed with ${result}: ${ARGV}")
  endif()
endfunction()

# A program for each library.
set(programs core pcl_class)
if(HAS_COMPARE)
  list(APPEND programs compare)
endif()

# Configures and builds the project in SOURCE, and runs its programs. Further arguments go to CMake.
function(build_and_run source)
  run("${CMAKE_COMMAND}"
      -S "${source}"
      -B "${WORK_DIR}/build"
      -G "${GENERATOR}"
      "-DCMAKE_BUILD_TYPE=${CONFIG}"
      "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}"
      "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}"
      "-DHAS_COMPARE=${HAS_COMPARE}"
      ${ARGN})
  run("${CMAKE_COMMAND}" --build "${WORK_DIR}/build" --config "${CONFIG}")
  foreach(program IN LISTS programs)
    find_program(
      path_of_${program} ${program}
      PATHS "${WORK_DIR}/build" "${WORK_DIR}/build/${CONFIG}"
      NO_DEFAULT_PATH)
    run("${path_of_${program}}")
  endforeach()
endfunction()
