# SPDX-License-Identifier: BSD-3-Clause
"""Scripts for MeshLab 2020.09's server, which wants every parameter of a filter: its defaults but for lengths."""
import math

NORMAL_NEIGHBORS = 15
POISSON_MARGIN = 1.1  # the cube of the octree over the cloud's largest extent


def script(filters):
    return f"<!DOCTYPE FilterScript>\n<FilterScript>\n{filters}</FilterScript>\n"


def ball_pivoting(disk_radius, _extent):
    """The ball's radius is left to MeshLab, which takes it from the density of the disks."""
    return (_filter("Poisson-disk Sampling",
                    ("RichInt", "SampleNum", 1000),  # not used, as the radius is given
                    ("RichAbsPerc", "Radius", disk_radius),
                    ("RichInt", "MontecarloRate", 20),
                    ("RichBool", "SaveMontecarlo", "false"),
                    ("RichBool", "ApproximateGeodesicDistance", "false"),
                    ("RichBool", "Subsample", "true"),
                    ("RichBool", "RefineFlag", "false"),
                    ("RichMesh", "RefineMesh", 0),
                    ("RichBool", "BestSampleFlag", "true"),
                    ("RichInt", "BestSamplePool", 10),
                    ("RichBool", "ExactNumFlag", "false"),
                    ("RichFloat", "RadiusVariance", 1)) + _normals() +
            _filter("Surface Reconstruction: Ball Pivoting",
                    ("RichAbsPerc", "BallRadius", 0),
                    ("RichFloat", "Clustering", 20),
                    ("RichFloat", "CreaseThr", 90),
                    ("RichBool", "DeleteFaces", "false")))


def screened_poisson(cell, extent):
    # Only powers of two of cells fit into the cube; the margin makes up for it.
    depth = math.ceil(math.log2(POISSON_MARGIN * extent / cell))
    return _normals() + _filter("Surface Reconstruction: Screened Poisson",
                                ("RichBool", "visibleLayer", "false"),
                                ("RichInt", "depth", depth),
                                ("RichInt", "fullDepth", 5),
                                ("RichInt", "cgDepth", 0),
                                ("RichFloat", "scale", cell * 2**depth / extent),
                                ("RichFloat", "samplesPerNode", 1.5),
                                ("RichFloat", "pointWeight", 4),
                                ("RichInt", "iters", 8),
                                ("RichBool", "confidence", "false"),
                                ("RichBool", "preClean", "false"))


def edge_collapse(faces):
    """For meshes; vertices that coincide are merged first."""
    return (_filter("Remove Duplicate Vertices") +
            _filter("Simplification: Quadric Edge Collapse Decimation",
                    ("RichInt", "TargetFaceNum", faces),
                    ("RichFloat", "TargetPerc", 0),
                    ("RichFloat", "QualityThr", 0.3),
                    ("RichBool", "PreserveBoundary", "false"),
                    ("RichFloat", "BoundaryWeight", 1),
                    ("RichBool", "PreserveNormal", "false"),
                    ("RichBool", "PreserveTopology", "false"),
                    ("RichBool", "OptimalPlacement", "true"),
                    ("RichBool", "PlanarQuadric", "false"),
                    ("RichFloat", "PlanarWeight", 0.001),
                    ("RichBool", "QualityWeight", "false"),
                    ("RichBool", "AutoClean", "true"),
                    ("RichBool", "Selected", "false")))


def count_vertices(ply_file):
    with open(ply_file, "rb") as lines:
        for line in lines:
            if line.startswith(b"element vertex"):
                return int(line.split()[2])
    raise ValueError(f"{ply_file}: not a PLY file")


def _normals():
    return _filter("Compute normals for point sets",
                   ("RichInt", "K", NORMAL_NEIGHBORS),
                   ("RichInt", "smoothIter", 0),
                   ("RichBool", "flipFlag", "false"),
                   ("RichPoint3f", "viewPos", None))


def _filter(name, *parameters):
    lines = [f' <filter name="{name}">\n']
    for kind, key, value in parameters:
        words = 'x="0" y="0" z="0"' if kind == "RichPoint3f" else f'value="{value}"'
        if kind == "RichAbsPerc":
            words += ' min="0" max="1"'
        lines.append(f'  <Param type="{kind}" name="{key}" {words}/>\n')
    return "".join(lines) + " </filter>\n"
