#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Prints the README's table of the Stanford Dragon: counts, and processor seconds, median of three runs.
#   measure_dragon.sh BUILD_DIR DRAGON.ply
set -euo pipefail
build=$(realpath "$1") dragon=$(realpath "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
TIMEFORMAT='%U %S' # of processor time: user, system

echo "| options | vertices | faces | components | boundary loops | processor seconds |"
echo "| --- | --- | --- | --- | --- | --- |"
for options in "" "-a 0.25" "-a 0.3" "-f 2.3 -a 0.1" "-f 6" "-k 30 -f 5"; do
  for _ in 1 2 3; do
    # shellcheck disable=SC2086  # a list of words
    { time "$build/tools/pcl_pds_recon" --quiet $options --report "$work/report.json" "$dragon" "$work/mesh.ply"; } \
      2>>"$work/seconds"
  done
  seconds=$(awk '{ printf "%.2f\n", $1 + $2 }' "$work/seconds" | sort -n | sed -n 2p)
  rm "$work/seconds"
  jq --raw-output --arg options "${options:+\`$options\`}" --arg seconds "$seconds" '
    def thousands: tostring | if length > 3 then .[:-3] + "," + .[-3:] else . end;
    if .nonmanifold_edges + .nonmanifold_vertices + .inconsistent_edges > 0 then error("not manifold") else . end |
    "| \(if $options == "" then "defaults" else $options end) | \(.vertices | thousands) | \(.faces | thousands) | " +
    "\(.components) | \(.boundary_loops) | \($seconds) |"' "$work/report.json"
done
