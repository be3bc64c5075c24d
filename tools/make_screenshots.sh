#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Draws the pictures of docs/viewer.md: a scan, its seeds, Voronoi cells, witness points, mesh, and the mesh's deviation.
#   tools/make_screenshots.sh BUILD_DIR SCAN.ply OUTPUT_DIR [CAMERA]
# SCAN.ply has faces, from which the deviation is measured. No display is needed.
set -euo pipefail

if [ $# -lt 3 ] || [ $# -gt 4 ]; then
  echo "make_screenshots.sh: usage: tools/make_screenshots.sh BUILD_DIR SCAN.ply OUTPUT_DIR [CAMERA]" >&2
  exit 2
fi
build=$1 scan=$2 output=$3 camera=${4-10,10,1.4}
viewer=$build/tools/viewer/pcl_pds_viewer
mkdir -p "$output"

draw() # NAME OPTION...
{
  local name=$1
  shift
  env -u DISPLAY "$viewer" --camera "$camera" --size 560x420 --screenshot "$output/$name.png" "$@"
}

mesh=$(mktemp --suffix=.ply)
trap 'rm -f "$mesh"' EXIT
"$build/tools/pcl_pds_recon" --quiet "$scan" "$mesh"

draw seeds --points --show cloud,seeds "$scan"
draw cells --points --show cells "$scan"
draw witnesses --points --show witnesses "$scan"
draw mesh --points --show mesh,edges,loops "$scan"
draw deviation --show deviation --reference "$scan" "$mesh"
