#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# The commands of the tutorial "A statue from raw scans". Runs in an empty folder.
set -euo pipefail

# [scan]
simulate_scan --noise 0.7 --separate scan.ply        # leaves scan_01.ply ... scan_12.ply
# [scan]

# [mesh]
pcl_pds_recon --report first.json scan_*.ply first.ply
pcl_pds_recon --placement quadric --report statue.json scan_*.ply statue.ply
jq '{smoothed, radius, vertices, closed, components, euler}' statue.json
# [mesh]

# [compare]
simulate_scan --noise 0 --pixel-spacing 0.008 true.ply
pcl_pds_recon -q true.ply true_mesh.ply
for mesh in first statue; do
  pcl_pds_compare --json $mesh.ply true_mesh.ply >$mesh.compare.json
  jq --compact-output '{mean: .mesh_to_reference.mean, degrees: .normal_deviation}' $mesh.compare.json
done
pcl_pds_compare --expect 'certificate.closed==1' --expect 'certificate.genus==0' statue.ply >certificate.txt
# [compare]

# What the text says: with vertices where the mesh fits best it is a quarter nearer to the truth.
jq --slurp --exit-status 'map(.mesh_to_reference.mean) | .[1] < 0.8 * .[0]' {first,statue}.compare.json >nearer.txt
jq --exit-status '.smoothed and .closed and .components == 1 and .euler == 2' statue.json >whole.txt

# [program]
statue scan_*.ply from_program.ply
# [program]

# [view]
pcl_pds_viewer --camera 35,15,1.6,z --size 400x340 --show cloud --screenshot scan.png scan_08.ply
pcl_pds_viewer --camera 35,15,1.6,z --size 400x340 --show mesh,edges --screenshot first.png first.ply
pcl_pds_viewer --camera 35,15,1.6,z --size 400x340 --show mesh,edges --screenshot statue.png statue.ply
# [view]
