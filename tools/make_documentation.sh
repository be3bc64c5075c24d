#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes anew what the documentation shows: tables, quoted programs, pictures.
#   tools/make_documentation.sh BUILD_DIR             all but what is measured; a few minutes
#   tools/make_documentation.sh --measure BUILD_DIR   only the README's table of the Dragon; on an idle machine, for it has times
#   tools/make_documentation.sh --check BUILD_DIR     only says what does not agree with the code; seconds
# BUILD_DIR holds a complete build. The pictures of docs/viewer.md, the README's Dragon and its table need the Dragon,
# which tools/demo.sh fetches; its terrain needs PDAL's autzen_trim_7.las in ../shared/data. Figures and pictures of
# docs/performance.md, docs/quality.md and docs/paper.md take other programs or an idle machine: bench/ makes them, by the
# commands shown there.
set -euo pipefail

action=draw
case "${1-}" in
  --check | --measure)
    action=${1#--}
    shift
    ;;
esac
if [ $# -ne 1 ] || [ ! -d "$1" ]; then
  echo "make_documentation.sh: usage: tools/make_documentation.sh [--check|--measure] BUILD_DIR" >&2
  exit 2
fi
build=$(realpath "$1")
cd "$(dirname "$0")/.."
dragon=build/demo/dragon_vrip.ply

if [ "$action" = check ]; then
  exec python3 tools/documentation/check_documentation.py "$build"
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ "$action" = measure ]; then
  [ -f "$dragon" ] || { echo "make_documentation.sh: $dragon is not there, tools/demo.sh fetches it" >&2; exit 1; }
  tools/documentation/measure_dragon.sh "$build" "$dragon" >"$work/table"
  sed -i -e "/^<!-- measured -->/,/^<!-- end -->/{/^|/d}" -e "/^<!-- measured -->/r $work/table" README.md
  exit
fi

tools/documentation/run_tutorial.sh "$build" "$work"
cp "$work"/{statue,terrain,machine_part}/*.png docs/tutorial/
tools/documentation/draw_parameters.sh "$build" docs/parameters

if [ -f "$dragon" ]; then
  tools/make_screenshots.sh "$build" "$dragon" docs/screenshots
  "$build/tools/pcl_pds_recon" -q "$dragon" "$work/dragon.ply"
  env -u DISPLAY "$build/tools/viewer/pcl_pds_viewer" --show mesh,edges --shading flat --camera 10,10,1.6 \
    --size 1200x840 --screenshot "$work/dragon.png" "$work/dragon.ply"
  /usr/bin/python3 -c 'import sys; from PIL import Image
Image.open(sys.argv[1]).convert("RGB").quantize(32).save(sys.argv[2], optimize=True)' "$work/dragon.png" docs/dragon.png
else
  echo "docs/screenshots/ and docs/dragon.png are left as they are: $dragon is not there, tools/demo.sh fetches it"
fi
terrain=../shared/data/autzen_trim_7.las
if [ -f "$terrain" ]; then
  tools/make_glb_picture.py "$build" "$terrain" docs/glb.png
else
  echo "docs/glb.png is left as it is: $terrain is not there"
fi
python3 tools/documentation/check_documentation.py --write "$build"
