#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the inputs that fuzzing begins with: a small file of each format, and a few clouds.

  make_corpus.py FOLDER
"""
import math
import random
import struct
import sys
from pathlib import Path

# As the switch of readers_fuzz.cpp has them.
PLY, PCD, LAS, LAZ, OBJ, TEXT, STL = range(7)


def ply_files():
    yield b"""ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
property uchar red
element face 1
property list uchar int vertex_indices
end_header
0 0 0 1
1 0 0 2
0 1 0 3
3 0 1 2
"""
    for name, order in (("little", "<"), ("big", ">")):
        yield f"""ply
format binary_{name}_endian 1.0
element vertex 2
property double x
property float y
property short z
property list uchar float weights
element face 1
property list uchar int vertex_indices
end_header
""".encode() + struct.pack(f"{order}dfhB2f", 1, 2, 3, 2, 1, 2) + struct.pack(
            f"{order}dfhBB2i", 1, 2, 3, 0, 2, 0, 1)


def pcd_files():
    points = struct.pack("<3fI3fI", 1, 2, 3, 4, 2, 3, 4, 5)
    columns = struct.pack("<6f2I", 1, 2, 2, 3, 3, 4, 4, 5)
    literal_run = bytes([len(columns) - 1]) + columns  # how LZF says that nothing is compressed
    bodies = {"ascii": b"1 2 3 4\n2 3 4 5\n", "binary": points,
              "binary_compressed": struct.pack("<II", len(literal_run), len(columns)) + literal_run}
    for data, body in bodies.items():
        yield f"""# .PCD v0.7 - Point Cloud Data file format
VERSION 0.7
FIELDS x y z rgb
SIZE 4 4 4 4
TYPE F F F U
COUNT 1 1 1 1
WIDTH 2
HEIGHT 1
VIEWPOINT 0 0 0 1 0 0 0
POINTS 2
DATA {data}
""".encode() + body


def las_file(points=4):
    """LAS 1.2, point format 0: x, y, z, and 8 bytes of other fields."""
    header_size, record = 227, 20
    counts = struct.pack("<I5I", points, points, 0, 0, 0, 0)
    scales = struct.pack("<12d", 0.01, 0.01, 0.01, 0, 0, 0, 1, 0, 1, 0, 1, 0)
    fixed = struct.pack("<4sHHIHH8sBB32s32sHHHIIBH", b"LASF", 0, 0, 0, 0, 0, b"", 1, 2, b"", b"", 1, 2026, header_size,
                        header_size, 0, 0, record)
    return fixed + counts + scales + b"".join(struct.pack("<3i8x", i, i * i, 100 - i) for i in range(points))


OBJ_FILE = b"# mesh\nv 1 2 3 0.5 0.5 0.5\nvn 0 0 1\nvt 0 0\nv 2 3 4\nv 3 3 3\nf 1/1/1 2//1 3\n"
TEXT_FILES = [b"# x y z\n1,2,3,4\n4 5 6 7\n", b"x;y;z;intensity\n1;2;3;4\n"]
STL_FILES = [b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
             b"endsolid\n", bytes(80) + struct.pack("<I12fH", 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)]


def files():
    for format_number, contents in ((PLY, ply_files()), (PCD, pcd_files()), (LAS, [las_file()]), (LAZ, [las_file()]),
                                    (OBJ, [OBJ_FILE]), (TEXT, TEXT_FILES), (STL, STL_FILES)):
        for content in contents:
            yield bytes([format_number]) + content


def clouds():
    """Rings, lattices and spheres with all kinds of options: what Bytes of reconstruct_fuzz.cpp takes apart."""
    lots = random.Random(1)
    for number in range(12):
        options = bytes([12, 16 + 24 * (number % 4), number % 4, 15, number % 2, number % 2, number % 5, number, 1])
        yield options + b"".join(bytes(point(lots, number % 3)) for _ in range(20 + 20 * number))


def point(lots, shape):
    turn = lots.random() * math.tau
    if shape == 0:
        return round(100 + 90 * math.cos(turn)), round(100 + 90 * math.sin(turn)), lots.randrange(100)
    if shape == 1:
        return lots.randrange(12) * 5, lots.randrange(12) * 5, 7
    height = 2 * lots.random() - 1
    width = 80 * math.sqrt(1 - height * height)
    return round(100 + width * math.cos(turn)), round(100 + width * math.sin(turn)), round(100 + 80 * height)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for name, contents in (("readers", files()), ("reconstruct", clouds())):
        folder = Path(sys.argv[1]) / name
        folder.mkdir(parents=True, exist_ok=True)
        for number, content in enumerate(contents):
            (folder / f"{number:02}").write_bytes(content)


main()
