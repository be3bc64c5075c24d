#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# The commands of the tutorial "A machine part". Runs in an empty folder.
set -euo pipefail

# [scan]
simulate_scan --shape part scan.ply
# [scan]

# [mesh]
pcl_pds_recon -r 2 --placement quadric scan.ply part.stl
pcl_pds_compare --weld --expect 'reference_to_mesh.p99<=0.3' --expect 'certificate.genus==5' part.stl scan.ply >report.txt
# [mesh]

# [program]
machine_part scan.ply 0.3 part.ply
# [program]

# What the text says: the mesh is open at two places, and a larger radius closes both.
pcl_pds_recon -q -r 2 --placement quadric --report open.json scan.ply open.ply
jq --exit-status '.boundary_loops == 2' open.json >open.txt
pcl_pds_recon -q -r 4 --placement quadric --report coarse.json scan.ply coarse.ply
jq --exit-status '.closed' coarse.json >closed.txt

# [view]
pcl_pds_viewer --camera 30,35,1.2,z --size 400x340 --show mesh,edges --screenshot machine_part.png part.ply
pcl_pds_viewer --camera 210,60,1.2,z --size 400x340 --show mesh,loops --screenshot gap.png part.ply
# [view]
