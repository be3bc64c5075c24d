#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the project, builds the programs of docs/tutorial/ against it, and runs them and the tutorial's commands.
#   run_tutorial.sh BUILD_DIR WORK_DIR [CMAKE_OPTION...]
# Leaves each tutorial's files, pictures among them, in a folder of WORK_DIR; an earlier run's files are removed.
set -euo pipefail
build=$(realpath "$1")
mkdir -p "$2"
work=$(realpath "$2")
shift 2
project=$(realpath "$(dirname "$0")/../..")

rm -rf "$work/prefix" "$work/programs"
cmake --install "$build" --prefix "$work/prefix" >/dev/null
cmake -S "$project/docs/tutorial" -B "$work/programs" "-DCMAKE_PREFIX_PATH=$work/prefix" -DCMAKE_BUILD_TYPE=Release \
  "$@" >"$work/configure.log"
cmake --build "$work/programs"
PATH=$work/prefix/bin:$work/programs:$build/tools/generate:$PATH
unset DISPLAY # no window opens, and none is needed

for tutorial in "$project"/docs/tutorial/*.sh; do
  folder=$work/$(basename "$tutorial" .sh)
  rm -rf "$folder"
  mkdir "$folder"
  echo "$tutorial"
  (cd "$folder" && "$tutorial") 2>&1
done

mkdir -p "$work/readme"
cd "$work/readme"
cp "$project/data/duck_scan.ply" scan.ply
first_mesh
test -s mesh.vtk
migration scan.ply
