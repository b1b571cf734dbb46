#!/usr/bin/env python3
"""Writes soap.ply beside itself: a bar of soap with a stamped oval on top, y up, standing on y = 0.

A closed mesh of 102384 triangles: the surface of a box lattice, drawn in along lines through the centre to a
superellipsoid, the top then displaced along y. Standard library only; the same bytes every time.
"""

import math
import pathlib
import struct

HALF = (0.8, 0.3, 0.5)  # half extents of the bar before it is stamped
CELLS = (144, 54, 90)  # lattice cells along x, y, z: cells about as long as wide
PLAN_POWER = 4.0  # 2 is an ellipse, infinity a rectangle, seen from above
PROFILE_POWER = 3.0  # the same, seen from the side

OVAL = (0.50, 0.27)  # half axes of the stamped ring's crest
RING_HEIGHT = 0.020
RING_WIDTH = 0.042  # to a height of 1/e of the crest's, four cells of the lattice
RECESS_DEPTH = 0.036
RECESS_FLOOR = 0.45  # where its flat floor ends, as a fraction of the oval


def smoothstep(low, high, x):
    """0 below low, 1 above high, between them the quintic with two continuous derivatives."""
    t = min(max((x - low) / (high - low), 0.0), 1.0)
    return t * t * t * (t * (6.0 * t - 15.0) + 10.0)


def stamp(x, z):
    """Height added to the top: a raised oval ring about a shallow recess with a flat floor."""
    r = math.hypot(x / OVAL[0], z / OVAL[1])
    slope = math.hypot(x / OVAL[0] ** 2, z / OVAL[1] ** 2)  # r times the gradient of r
    ring = 0.0
    if slope > 0.0:
        from_crest = (r - 1.0) * r / slope  # to first order, so that the ring is as wide all round
        ring = RING_HEIGHT * math.exp(-((from_crest / RING_WIDTH) ** 2))
    return ring - RECESS_DEPTH * (1.0 - smoothstep(RECESS_FLOOR, 1.0, r))


def surface_point(lattice):
    """The point of the bar on the line from its centre through a point of the box lattice's surface."""
    u, v, w = (2.0 * i / n - 1.0 for i, n in zip(lattice, CELLS))
    plan = (abs(u) ** PLAN_POWER + abs(w) ** PLAN_POWER) ** (PROFILE_POWER / PLAN_POWER)
    scale = (plan + abs(v) ** PROFILE_POWER) ** (-1.0 / PROFILE_POWER)
    x, y, z = HALF[0] * scale * u, HALF[1] * scale * v, HALF[2] * scale * w
    if y > 0.0:
        y += stamp(x, z)
    return (x, y + HALF[1], z)


def lattice_quads():
    """The squares of the lattice's six sides, counter-clockwise from outside."""
    for axis in range(3):
        across, up = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, CELLS[axis]):
            for i in range(CELLS[across]):
                for j in range(CELLS[up]):
                    quad = []
                    for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        corner = [0, 0, 0]
                        corner[axis], corner[across], corner[up] = side, i + di, j + dj
                        quad.append(tuple(corner))
                    yield quad if side else quad[::-1]


def build():
    """Positions, and triangles that cut each quad along its shorter diagonal."""
    index, positions, triangles = {}, [], []
    for quad in lattice_quads():
        for corner in quad:
            if corner not in index:
                index[corner] = len(positions)
                positions.append(surface_point(corner))
        a, b, c, d = (index[corner] for corner in quad)
        if math.dist(positions[a], positions[c]) <= math.dist(positions[b], positions[d]):
            triangles += [(a, b, c), (a, c, d)]
        else:
            triangles += [(a, b, d), (b, c, d)]
    return positions, triangles


def write_ply(path, positions, triangles):
    header = (
        "ply\nformat binary_little_endian 1.0\ncomment a bar of soap, y up, made by make_soap.py\n"
        f"element vertex {len(positions)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    with open(path, "wb") as file:
        file.write(header.encode("ascii"))
        file.write(b"".join(struct.pack("<3f", *position) for position in positions))
        file.write(b"".join(struct.pack("<B3i", 3, *triangle) for triangle in triangles))


if __name__ == "__main__":
    write_ply(pathlib.Path(__file__).with_name("soap.ply"), *build())
