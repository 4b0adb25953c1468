"""Meshes of the built-in robots. The <visual> of a model places the origin of each mesh."""

import math

from mesh import Mesh, facing, moved


def make(models):
    make_b21r(models / "b21r" / "meshes")
    make_pebble(models / "pebble" / "meshes")
    make_rover4(models / "rover4" / "meshes")


def make_b21r(folder):
    """A drum of 26 cm radius: red base and enclosure, black bands, gold sonars between them."""
    red = Mesh()
    red.add_lathe([(0.25, 0.07), (0.262, 0.082), (0.262, 0.235), (0.252, 0.245)], 48)
    red.add_lathe([(0.252, 0.35), (0.26, 0.358), (0.26, 0.862), (0.24, 0.885)], 48)
    red.write(folder / "red.obj")

    black = Mesh()
    black.add_lathe([(0, 0.035), (0.24, 0.035), (0.25, 0.045), (0.25, 0.07)], 48)
    black.add_lathe([(0.252, 0.245), (0.257, 0.25), (0.257, 0.345), (0.252, 0.35)], 48)
    black.add_lathe([(0.24, 0.885), (0.215, 0.89), (0.215, 0.925), (0.2, 0.93)], 48)
    for k in range(6):  # seams between the enclosure's doors
        seam = Mesh()
        seam.add_box((-0.003, -0.245, -0.001), (0.003, 0.245, 0.002))
        black.add(seam, facing(0.26, math.radians(30 + 60 * k), 0.61))
    front = math.radians(20)  # the display looks ahead
    black.add_lathe([(0.2605, 0.62), (0.2635, 0.624), (0.2635, 0.786), (0.2605, 0.79)], 12, -front, front)
    for wheel in range(4):
        tyre = Mesh()
        tyre.add_lathe([(0, -0.025), (0.05, -0.025), (0.06, -0.015), (0.06, 0.015), (0.05, 0.025), (0, 0.025)], 16)
        x, y = ((0.14, 0.1), (0.14, -0.1), (-0.14, 0.1), (-0.14, -0.1))[wheel]
        black.add(tyre, rolled(x, y, 0.06))
    black.write(folder / "black.obj")

    grey = Mesh()
    grey.add_lathe([(0.2, 0.93), (0.2, 1.035), (0.185, 1.05), (0, 1.05)], 48)
    grey.add_lathe([(0.02, 1.05), (0.02, 1.075)], 12)
    grey.write(folder / "grey.obj")

    gold = Mesh()
    transducer = Mesh()
    transducer.add_lathe([(0.021, -0.004), (0.021, 0.004), (0.016, 0.006), (0, 0.005)], 12)
    for k in range(24):
        gold.add(transducer, facing(0.257, math.radians(15 * k), 0.3))
    gold.write(folder / "gold.obj")


def make_pebble(folder):
    """A flat dome of 9 cm radius."""
    shell = Mesh()
    shell.add_lathe([(0, 0.018), (0.08, 0.018), (0.09, 0.028), (0.09, 0.075), (0.084, 0.092),
                     (0.066, 0.106), (0.04, 0.113), (0, 0.115)], 32)
    shell.write(folder / "shell.obj")
    eyes = Mesh()
    eye = Mesh()
    eye.add_lathe([(0.009, -0.003), (0.009, 0.002), (0, 0.003)], 10)
    for k in range(8):
        eyes.add(eye, facing(0.09, math.radians(45 * k), 0.06))
    eyes.write(folder / "eyes.obj")
    write_wheel(folder, radius=0.035, width=0.018, spokes=3)


def make_rover4(folder):
    """A low box with sloping ends, 50 by 30 cm, on four wheels."""
    hull = Mesh()
    outline = [(-0.25, 0.12), (-0.22, 0.08), (0.22, 0.08), (0.25, 0.12), (0.25, 0.16),
               (0.2, 0.22), (-0.22, 0.22), (-0.25, 0.18)]  # (x, z), seen from the right
    half = 0.15
    hull.add_face([(x, -half, z) for x, z in outline], [(0, -1, 0)] * 8, outline)
    hull.add_face([(x, half, z) for x, z in reversed(outline)], [(0, 1, 0)] * 8, outline)
    for (x0, z0), (x1, z1) in zip(outline, outline[1:] + outline[:1]):
        hull.add_quad([(x0, half, z0), (x1, half, z1), (x1, -half, z1), (x0, -half, z0)])
    hull.write(folder / "hull.obj")
    write_wheel(folder, radius=0.11, width=0.08, spokes=5)


def write_wheel(folder, radius, width, spokes):
    """A wheel that turns about z: tyre.obj, and hub.obj whose spokes show that it turns."""
    half = width / 2
    tyre = Mesh()
    tyre.add_lathe([(0.6 * radius, -half), (0.9 * radius, -half), (radius, -0.6 * half),
                    (radius, 0.6 * half), (0.9 * radius, half), (0.6 * radius, half)], 24)
    tyre.add_lathe([(0.6 * radius, half), (0.6 * radius, 0.7 * half), (0, 0.7 * half)], 24)
    tyre.add_lathe([(0, -0.7 * half), (0.6 * radius, -0.7 * half), (0.6 * radius, -half)], 24)
    tyre.write(folder / "tyre.obj")
    hub = Mesh()
    hub.add_lathe([(0, -half), (0.2 * radius, -half), (0.2 * radius, half), (0, half)], 12)
    spoke = Mesh()
    spoke.add_box((0, -0.07 * radius, -0.9 * half), (0.62 * radius, 0.07 * radius, 0.9 * half))
    for k in range(spokes):
        hub.add(spoke, moved(0, 0, 0, 2 * math.pi * k / spokes))
    hub.write(folder / "hub.obj")


def rolled(x, y, z):
    """Returns a transform for Mesh.add that turns the axis +z to +y."""

    def transform(point, is_normal):
        px, py, pz = point[1], point[2], point[0]
        return (px, py, pz) if is_normal else (px + x, py + y, pz + z)

    return transform
