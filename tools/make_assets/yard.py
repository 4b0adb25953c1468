"""An outdoor yard: level ground, ramps up to a platform, a hump, a kerb, a hut, trees and a fence.

A wheeled robot climbs ramps only with `--movement ROBOT=rigid`. Other robots stop at a ramp.
"""

import math
import random

from mesh import Mesh, moved
from sdf import box, collision, cylinder, include, link, material, mesh, visual, write_model, write_world

HALF = 12.0  # half the side of the fenced square, m
PLATFORM = (3.0, 3.0, 0.5)
RAMP_WIDTH = 2.0
GENTLE, STEEP = 3.0, 2.0  # lengths of the ramps: 1 in 6 and 1 in 4


def make(assets):
    models = assets / "models"
    make_ground(models / "yard_ground")
    make_ramps(models / "ramps")
    make_tree(models / "tree")
    make_hut(models / "hut")
    make_fence(models / "fence")
    make_world(assets / "worlds" / "yard.sdf")


def make_ground(folder):
    grass, path = Mesh(), Mesh()
    square(grass, -16, -16, 16, 16, -0.02)
    for x0, y0, x1, y1 in ((-12, -1.5, 12, 1.5), (-1.5, 1.5, 1.5, 12), (-1.5, -12, 1.5, -1.5)):
        square(path, x0, y0, x1, y1, 0)
    grass.write(folder / "meshes" / "grass.obj", 0.4)
    path.write(folder / "meshes" / "path.obj", 0.5)
    plane = "<geometry><plane><normal>0 0 1</normal><size>60 60</size></plane></geometry>"
    write_model(folder, "Grass with two paved ways that cross at the origin, level.", "Yard ground",
                "Level ground: grass of 32 by 32 m, and ways that cross.",
                [link("ground", [
                    visual("grass", mesh("grass"), material(texture="grass", roughness=1.0)),
                    visual("path", mesh("path"), material(texture="gravel", roughness=0.95)),
                    collision("plane", plane),
                ])], static=True)


def square(surface, x0, y0, x1, y1, z):
    corners = [(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)]
    surface.add_quad(corners, [corner[:2] for corner in corners])


def make_ramps(folder):
    """A platform about the origin, with the gentle ramp to its west and the steep ramp to its east."""
    x, y, top = PLATFORM[0] / 2, PLATFORM[1] / 2, PLATFORM[2]
    platform = Mesh()
    platform.add_box((-x, -y, 0), (x, y, top))
    platform.write(folder / "meshes" / "platform.obj", 0.5)
    wedge(-x - GENTLE, -x, top).write(folder / "meshes" / "gentle.obj", 0.5)
    wedge(x + STEEP, x, top).write(folder / "meshes" / "steep.obj", 0.5)
    stone = material((0.85, 0.84, 0.82), texture="concrete", roughness=0.9)
    parts = [visual("platform", mesh("platform"), stone),
             collision("platform", box(*PLATFORM), (0, 0, top / 2))]
    for name in ("gentle", "steep"):
        parts += [visual(name, mesh(name), stone), collision(name, mesh(name))]
    for side in (-1, 1):  # a rail along the platform's open sides
        for k in range(4):
            at = (-x + 0.1 + k * (2 * x - 0.2) / 3, side * (y - 0.05), top + 0.25)
            parts.append(visual(f"post_{side}_{k}", cylinder(0.025, 0.5),
                                material((0.3, 0.32, 0.34), roughness=0.4, metalness=0.5), at))
        parts.append(visual(f"rail_{side}", cylinder(0.025, 2 * x),
                            material((0.8, 0.15, 0.1), roughness=0.4),
                            (0, side * (y - 0.05), top + 0.5, 0, math.pi / 2, 0)))
        parts.append(collision(f"rail_{side}", box(2 * x, 0.06, 0.55), (0, side * (y - 0.05), top + 0.275)))
    write_model(folder, "A platform 0.5 m high with a ramp of 1 in 6 to its west and of 1 in 4 to its east.",
                "Ramps", "A platform of 3 by 3 m, 0.5 m high, between a gentle and a steep ramp.",
                [link("stone", parts)], static=True)


def wedge(foot, head, top):
    """Returns a ramp from the ground at x = foot to the height `top` at x = head."""
    half = RAMP_WIDTH / 2
    solid = Mesh()
    low = [(foot, -half, 0), (foot, half, 0)]
    ground = [(head, -half, 0), (head, half, 0)]
    high = [(head, -half, top), (head, half, top)]
    flip = head < foot

    def face(*corners):
        solid.add_quad(corners[::-1] if flip else corners,
                       [(c[1], math.hypot(c[0] - foot, c[2])) for c in (corners[::-1] if flip else corners)])

    def side(*corners):
        corners = corners[::-1] if flip else corners
        normal = (0, math.copysign(1, corners[0][1]), 0)
        solid.add_face(list(corners), [normal] * 3, [(c[0], c[2]) for c in corners])

    face(low[0], high[0], high[1], low[1])
    face(ground[0], low[0], low[1], ground[1])
    face(high[0], ground[0], ground[1], high[1])
    side(low[0], ground[0], high[0])
    side(ground[1], low[1], high[1])
    return solid


def make_tree(folder):
    source = random.Random(3)
    trunk, crown = Mesh(), Mesh()
    trunk.add_lathe([(0.17, 0), (0.12, 0.3), (0.09, 1.6), (0.05, 2.6)], 10)
    ball = Mesh()
    ball.add_lathe([(0, -1)] + [(math.cos(a), math.sin(a)) for a in
                                (math.radians(d) for d in (-60, -30, 0, 30, 60))] + [(0, 1)], 12)
    for k in range(9):
        angle, away = 2.4 * k, 0.55 * math.sqrt(k / 9)
        size = source.uniform(0.5, 0.72)
        crown.add(ball, grown(size, away * math.cos(angle), away * math.sin(angle),
                              2.3 + source.uniform(-0.35, 0.65)))
    trunk.write(folder / "meshes" / "trunk.obj")
    crown.write(folder / "meshes" / "crown.obj")
    write_model(folder, "A tree 3.5 m high. Origin on the ground below it.", "Tree", "A small tree.",
                [link("tree", [
                    visual("trunk", mesh("trunk"), material((0.36, 0.27, 0.19), roughness=1.0)),
                    visual("crown", mesh("crown"), material((0.8, 0.95, 0.6), texture="grass", roughness=1.0)),
                    collision("trunk", cylinder(0.17, 1.8), (0, 0, 0.9)),
                ])], static=True)


def grown(size, x, y, z):
    place = moved(x, y, z)

    def transform(point, is_normal):
        return point if is_normal else place(tuple(size * c for c in point), False)

    return transform


def make_hut(folder):
    walls, roof = Mesh(), Mesh()
    walls.add_box((-1.5, -1.2, 0), (1.5, 1.2, 2.1))
    for side in (-1, 1):
        low, high = (-1.75, side * 1.5, 2.0), (1.75, side * 1.5, 2.0)
        ridge = [(1.75, 0, 2.9), (-1.75, 0, 2.9)]
        corners = [low, high, *ridge] if side < 0 else [high, low, *ridge[::-1]]
        roof.add_quad(corners, [(c[0], math.hypot(c[1], c[2])) for c in corners])
        roof.add_quad(corners[::-1], [(c[0], math.hypot(c[1], c[2])) for c in corners[::-1]])
        gable = [(side * 1.5, -side * 1.2, 2.1), (side * 1.5, side * 1.2, 2.1), (side * 1.5, 0, 2.82)]
        walls.add_face(gable, [(side, 0, 0)] * 3, [(c[1], c[2]) for c in gable])
    walls.write(folder / "meshes" / "walls.obj", 0.5)
    roof.write(folder / "meshes" / "roof.obj", 0.6)
    write_model(folder, "A hut of 3 by 2.4 m. Origin on the ground below its middle; its door looks to -y.",
                "Hut", "A brick hut of 3 by 2.4 m.",
                [link("hut", [
                    visual("walls", mesh("walls"), material(texture="brick", roughness=0.95)),
                    visual("roof", mesh("roof"), material((0.42, 0.2, 0.16), roughness=0.9)),
                    visual("door", box(0.9, 0.05, 1.9), material((0.75, 0.62, 0.5), texture="oak", roughness=0.7),
                           (0.4, -1.21, 0.95)),
                    visual("window", box(0.7, 0.05, 0.7), material((0.2, 0.28, 0.34), roughness=0.1),
                           (-0.7, -1.21, 1.3)),
                    collision("walls", box(3, 2.4, 2.1), (0, 0, 1.05)),
                ])], static=True)


def make_fence(folder):
    """Writes the model of a fence: eight metres along x."""
    boards = Mesh()
    for k in range(40):
        at = -3.9 + 0.2 * k
        boards.add_box((at - 0.06, -0.012, 0.08), (at + 0.06, 0.012, 1.0))
    for z in (0.25, 0.8):
        boards.add_box((-4, 0.012, z - 0.04), (4, 0.05, z + 0.04))
    for k in range(5):
        boards.add_box((-4 + 2 * k - 0.05, 0.012, 0), (-4 + 2 * k + 0.05, 0.11, 1.05))
    boards.write(folder / "meshes" / "boards.obj", 0.5)
    write_model(folder, "Eight metres of fence along x, 1 m high. Origin on the ground below its middle.",
                "Fence", "Eight metres of a wooden fence.",
                [link("fence", [
                    visual("boards", mesh("boards"), material((0.9, 0.85, 0.78), texture="beech", roughness=0.9)),
                    collision("boards", box(8, 0.1, 1.0), (0, 0.03, 0.5)),
                ])], static=True)


def make_world(path):
    parts = [include("yard_ground", "ground"), include("ramps", "ramps", 6, 5.5), include("hut", "hut", -7.5, 7)]
    trees = [(-9, -8), (-4.5, -9.5), (-10, 3), (9.5, -9), (4, -5.2), (-3.2, 10), (10.2, 10.2), (-6, -4)]
    for k, (x, y) in enumerate(trees):
        parts.append(include("tree", f"tree_{k}", x, y, 0, 0, 0, 0.9 * k))
    number = 0
    for side in range(4):
        yaw = side * math.pi / 2
        for k in (-1, 0, 1):
            across, along = -HALF, 8 * k
            parts.append(include("fence", f"fence_{number}",
                                 math.cos(yaw) * along - math.sin(yaw) * across,
                                 math.sin(yaw) * along + math.cos(yaw) * across, 0, 0, 0, yaw))
            number += 1
    hump = material((0.85, 0.84, 0.82), texture="concrete", roughness=0.9)
    parts.append('<model name="hump"><static>true</static><pose>-5 0 -0.42 0 1.5707963 1.5707963</pose><link name="link">\n'
                 + "  " + visual("hump", cylinder(0.5, 3), hump) + "\n  "
                 + collision("hump", cylinder(0.5, 3)) + "\n</link></model>")
    for k, (x, y, yaw) in enumerate(((3.2, -8.2, 0.3), (4.1, -8.9, 1.0), (3.4, -9.3, 0.1))):
        parts.append(include("crate", f"crate_{k}", x, y, 0, 0, 0, yaw))
    write_world(path,
                "A fenced yard of 24 by 24 m, its middle the origin: paved ways along x and y; in the north-east a\n"
                "     platform 0.5 m high with ramps of 1 in 6 (from the west) and 1 in 4 (from the east); on the\n"
                "     western way a hump 8 cm high; a hut, trees, crates. Robots climb that move\n"
                "     rigidly (docs/fidelity.md); others stop at a ramp.",
                parts, ambient="0.48 0.5 0.55", sun="1 0.96 0.86")
