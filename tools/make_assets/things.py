"""Meshes of furniture and plants that cannot be built from simple shapes."""

import math
import random

from mesh import Mesh, moved


def make(models):
    make_plant(models / "plant" / "meshes")
    make_tiled_floor(models / "tiled_floor" / "meshes")


def make_plant(folder):
    """A plant with arched leaves in a pot of 30 cm height."""
    source = random.Random(20)
    leaves = Mesh()
    for k in range(48):
        yaw = 2.4 * k  # the golden angle, at which leaves of plants grow
        length = source.uniform(0.3, 0.52) * (1.15 - 0.4 * k / 48)
        steepness = 0.35 + 1.05 * k / 48
        leaves.add(leaf(length, steepness, 0.05 + 0.02 * source.random()), moved(0, 0, 0.3, yaw))
    leaves.write(folder / "leaves.obj")
    pot = Mesh()
    pot.add_lathe([(0, 0), (0.12, 0), (0.16, 0.28), (0.18, 0.28), (0.18, 0.33), (0.15, 0.33),
                   (0.15, 0.3), (0, 0.3)], 24)
    pot.write(folder / "pot.obj")


def leaf(length, steepness, width):
    """Returns a leaf along x that rises and bends down again. It is visible from both sides."""
    points = []
    x = z = 0.0
    parts = 4
    for i in range(parts + 1):
        s = i / parts
        points.append((x, z, width * math.sin(math.pi * min(0.12 + 0.88 * s, 1.0)) if i < parts else 0.004))
        angle = steepness - 1.1 * s
        x += length / parts * math.cos(angle)
        z += length / parts * math.sin(angle)
    mesh = Mesh()
    for (x0, z0, w0), (x1, z1, w1) in zip(points, points[1:]):
        corners = [(x0, -w0, z0), (x1, -w1, z1), (x1, w1, z1), (x0, w0, z0)]
        mesh.add_quad(corners)
        mesh.add_quad(corners[::-1])
    return mesh


def make_tiled_floor(folder):
    """A floor of 12 by 12 m about the origin."""
    floor = Mesh()
    floor.add_quad([(-6, -6, 0), (6, -6, 0), (6, 6, 0), (-6, 6, 0)],
                   [(-6, -6), (6, -6), (6, 6), (-6, 6)])
    floor.write(folder / "floor.obj", texture_scale=0.5)
