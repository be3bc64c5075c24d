#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# The commands of the tutorial "Terrain from LAS". Runs in an empty folder.
set -euo pipefail

# [scan]
simulate_terrain flight.las
# [scan]

# [mesh]
pcl_pds_recon -r 3 --class 2,9 flight.las ground.ply
pcl_pds_recon -r 3 --class 2,6,9 flight.las town.glb
# [mesh]

# [program]
pcl_pds_recon -q -r 3 --class 2,9 --ascii --voronoi points.ply flight.las ground.ply
sed '1,/^end_header/d' points.ply | cut -d' ' -f1-3 >points.xyz
terrain points.xyz ground.obj
pcl_pds_compare --expect 'hausdorff<=0.001' ground.obj ground.ply >same.txt
# [program]

# [view]
pcl_pds_viewer --camera 35,30,1.45,z --size 560x340 --show mesh,edges,loops --screenshot terrain.png ground.ply
# [view]
