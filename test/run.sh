#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the dependencies, builds everything and runs all tests.
#   test/run.sh              optimised, warnings are errors (preset ci)
#   test/run.sh --sanitize   with the address and undefined-behaviour sanitizers (preset asan-ubsan)
#   test/run.sh --bare       as on a machine without PDAL, VTK, X11, Embree and npm (preset bare)
# Further arguments go to ctest: test/run.sh --bare -L tool.
set -euo pipefail
cd "$(dirname "$0")/.."
exec </dev/null

preset=ci
case "${1-}" in
  --sanitize) preset=asan-ubsan ;;
  --bare) preset=bare ;;
  --?*)
    echo "run.sh: unknown option '$1'; usage: test/run.sh [--sanitize|--bare] [CTEST_OPTION...]" >&2
    exit 2
    ;;
esac
[ "$preset" = ci ] || shift

tools/install_dependencies.sh

# Ninja's own default is more jobs than cores: too much memory for PCL's headers.
jobs=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
options=()
if command -v ccache >/dev/null; then
  options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  # Without these ccache cannot reuse what was compiled with a precompiled header.
  export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
fi
cmake --preset "$preset" "${options[@]}"
cmake --build --preset "$preset" --parallel "$jobs"

tests=(ctest --preset "$preset" --parallel "$jobs" "$@")
export UBSAN_OPTIONS=print_stacktrace=1
if [ "$preset" = asan-ubsan ]; then
  # dlopen() is the sanitizer's own here, which does not see the program's search path.
  export LD_LIBRARY_PATH="$PWD/build/$preset/tools/plugins${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
  # Graphics drivers that are unloaded again leave memory behind that cannot be told by a library's name, and threads that
  # the search for leaks stumbles over ("Tracer caught signal 11").
  pictures='draws|screenshots|ViewerWindowTest'
  "${tests[@]}" --exclude-regex "$pictures"
  ASAN_OPTIONS=detect_leaks=0 "${tests[@]}" --tests-regex "$pictures"
else
  "${tests[@]}"
fi
