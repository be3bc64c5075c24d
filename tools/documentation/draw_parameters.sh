#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# Draws the pictures of docs/parameters.md: what each option does to a simulated scan.
#   draw_parameters.sh BUILD_DIR OUTPUT_DIR
set -euo pipefail
build=$(realpath "$1") output=$(realpath "$2")
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

duck=$PWD/data/duck_scan.ply
"$build/tools/generate/simulate_scan" --noise 0.7 "$work/noisy.ply"
"$build/tools/generate/simulate_terrain" "$work/terrain.las"
"$build/tools/generate/simulate_scan" --shape part "$work/part.ply"
"$build/tools/generate/simulate_scan" --shape part --noise 0.7 "$work/noisy_part.ply"

camera=35,15,1.6,z layers=mesh,edges,loops shading=smooth
show() # PICTURE FILE
{
  env -u DISPLAY "$build/tools/viewer/pcl_pds_viewer" --show "$layers" --shading "$shading" --camera "$camera" \
    --size 300x260 --screenshot "$output/$1.png" "$2"
}
draw() # PICTURE SCAN OPTION...
{
  local picture=$1 scan=$2
  shift 2
  "$build/tools/pcl_pds_recon" --quiet "$@" "$scan" "$work/mesh.ply"
  show "$picture" "$work/mesh.ply"
}

for k in 8 15 30; do draw "k_neighbors_$k" "$work/noisy.ply" -k "$k"; done
for f in 2 3 6; do draw "radius_factor_$f" "$duck" -f "$f"; done
for r in 0.05 0.1; do draw "radius_$r" "$duck" -r "$r"; done
for a in 0 0.3 1; do draw "adaptive_$a" "$duck" -f 5 -a "$a"; done
for s in 0 1; do draw "seed_$s" "$duck" -f 6 --seed "$s"; done
for n in 500 2000 8000; do draw "vertices_$n" "$duck" -n "$n"; done
for e in 0.02 0.006; do draw "max_error_$e" "$duck" --max-error "$e"; done
draw max_error_quadric "$duck" --max-error 0.006 --placement quadric
for steps in 0 15; do draw "relax_$steps" "$duck" -f 5 --relax "$steps"; done

draw levels_0 "$duck" --levels 3
for level in 1 2; do show "levels_$level" "$work/mesh_$level.ply"; done

camera=35,40,2.6,z layers=mesh shading=flat
for p in point quadric; do draw "placement_$p" "$work/noisy_part.ply" -f 4 --placement "$p"; done
camera=35,15,1.6,z layers=mesh,edges,loops shading=smooth

# A hole in the scan: its points in a ball on the side of the body are left out.
"$build/tools/pcl_pds_recon" --quiet --ascii --voronoi "$work/voronoi.ply" "$duck" "$work/mesh.ply"
sed '1,/^end_header/d' "$work/voronoi.ply" |
  awk '{ d = ($1 - 0.45)^2 + ($2 + 0.5)^2 + ($3 + 0.2)^2; if (d > 0.008) print $1, $2, $3 }' >"$work/hole.xyz"
for size in 5 15; do draw "hole_size_$size" "$work/hole.xyz" -f 4 --hole-size "$size"; done

# The cells and the witness points, as the viewer draws the diagram that --voronoi writes.
env -u DISPLAY "$build/tools/viewer/pcl_pds_viewer" -f 6 --points --show cells --camera "$camera" --size 300x260 \
  --screenshot "$output/voronoi.png" "$duck"

for threshold in 0.02 0.1 0.4; do
  env -u DISPLAY "$build/tools/viewer/pcl_pds_viewer" -f 6 --voronoi-threshold "$threshold" --points --show witnesses \
    --camera "$camera" --size 300x260 --screenshot "$output/voronoi_threshold_$threshold.png" "$duck"
done

# Curves, drawn by the viewer's own run.
curve() # PICTURE CLOUD OPTION...
{
  local picture=$1 cloud=$2
  shift 2
  env -u DISPLAY "$build/tools/viewer/pcl_pds_viewer" "$@" --camera "$camera" --size 300x260 \
    --screenshot "$output/$picture.png" "$cloud"
}
simulate() # SHAPE NOISE
{
  "$build/tools/generate/simulate_curve" --points 3000 --shape "$1" --noise "$2" "$work/$1.xyz"
}
simulate circle 0.01
simulate trefoil 0.03
simulate spiral 0.02
simulate rings 0.01
awk '{ print 60 * $1, 60 * $2, 60 * $3 }' "$work/circle.xyz" >"$work/ring.xyz"
camera=0,80,1.4,z
for shape in circle trefoil spiral rings; do
  [ $shape = rings ] && camera=35,35,1.4,z
  curve "dimension_$shape" "$work/$shape.xyz" --dimension 1 --show cloud,seeds,graph
done
curve dimension_auto "$work/part.ply" "$work/ring.xyz" --dimension auto --show mesh,graph

camera=35,25,1.4,z layers=mesh
draw class_all "$work/terrain.las"
draw class_ground "$work/terrain.las" --class 2,9

tools/documentation/draw_in_browser.py "$build" "$output"
