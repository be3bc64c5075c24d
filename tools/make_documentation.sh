#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes anew what the documentation shows: tables, quoted programs, pictures.
#   tools/make_documentation.sh BUILD_DIR           all of it; a few minutes
#   tools/make_documentation.sh --check BUILD_DIR   only says what does not agree with the code; seconds
# BUILD_DIR holds a complete build. The pictures of docs/viewer.md and the README's figures need the Dragon, which
# tools/demo.sh fetches.
set -euo pipefail

check=no
if [ "${1-}" = --check ]; then
  check=yes
  shift
fi
if [ $# -ne 1 ] || [ ! -d "$1" ]; then
  echo "make_documentation.sh: usage: tools/make_documentation.sh [--check] BUILD_DIR" >&2
  exit 2
fi
build=$(realpath "$1")
cd "$(dirname "$0")/.."

if [ "$check" = yes ]; then
  exec python3 tools/documentation/check_documentation.py "$build"
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tools/documentation/run_tutorial.sh "$build" "$work"
cp "$work"/{statue,terrain,machine_part}/*.png docs/tutorial/
tools/documentation/draw_parameters.sh "$build" docs/parameters

dragon=build/demo/dragon_vrip.ply
if [ -f "$dragon" ]; then
  tools/make_screenshots.sh "$build" "$dragon" docs/screenshots
  tools/documentation/measure_dragon.sh "$build" "$dragon" >"$work/table"
  sed -i -e "/^<!-- measured -->/,/^<!-- end -->/{/^|/d}" -e "/^<!-- measured -->/r $work/table" README.md
else
  echo "docs/screenshots/ and the README's table of the Dragon are left as they are: $dragon is not there," \
    "tools/demo.sh fetches it"
fi
python3 tools/documentation/check_documentation.py --write "$build"
