"""A hall of 24 by 16 m with racks, pallets and a marked way between them."""

from mesh import Mesh
from sdf import box, collision, include, link, material, mesh, visual, write_model, write_world

LENGTH, WIDTH, HEIGHT = 24.0, 16.0, 5.0
WALL = 0.2
GATES = (-6.0, 0.0, 6.0)  # y of the closed gates in the east wall
RACK = (2.8, 1.0, 3.0)
SHELVES = (0.12, 1.1, 2.08)  # heights of the shelves
BLUE, ORANGE, YELLOW = (0.1, 0.22, 0.5), (0.85, 0.35, 0.08), (0.9, 0.72, 0.08)


def make(assets):
    make_hall(assets / "models" / "warehouse_hall")
    make_rack(assets / "models" / "pallet_rack")
    make_pallet(assets / "models" / "loaded_pallet")
    make_world(assets / "worlds" / "warehouse.sdf")


def make_hall(folder):
    x, y = LENGTH / 2, WIDTH / 2
    floor, walls, steel, glass = Mesh(), Mesh(), Mesh(), Mesh()
    corners = [(-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0)]
    floor.add_quad(corners, [corner[:2] for corner in corners])
    solid = [
        ((-x - WALL, -y - WALL, 0), (x + WALL, -y, HEIGHT)),
        ((-x - WALL, y, 0), (x + WALL, y + WALL, HEIGHT)),
        ((-x - WALL, -y, 0), (-x, y, HEIGHT)),
        ((x, -y, 0), (x + WALL, y, HEIGHT)),
    ]
    for low, high in solid[:3]:
        walls.add_box(low, high)
    # The east wall has openings with closed gates.
    at = -y
    for gate in GATES:
        walls.add_box((x, at, 0), (x + WALL, gate - 1.5, HEIGHT))
        walls.add_box((x, gate - 1.5, 3), (x + WALL, gate + 1.5, HEIGHT))
        for k in range(10):  # a gate of slats
            steel.add_box((x + 0.04, gate - 1.5, 0.3 * k + 0.01), (x + 0.1, gate + 1.5, 0.3 * k + 0.29))
        at = gate + 1.5
    walls.add_box((x, at, 0), (x + WALL, y, HEIGHT))
    for k in range(7):  # girders between columns on both sides
        at = -x + 0.15 + k * (LENGTH - 0.3) / 6
        for side in (-1, 1):
            steel.add_box((at - 0.1, side * (y - 0.12) - 0.1, 0), (at + 0.1, side * (y - 0.12) + 0.1, HEIGHT))
            solid.append(((at - 0.1, side * (y - 0.12) - 0.1, 0), (at + 0.1, side * (y - 0.12) + 0.1, HEIGHT)))
        steel.add_box((at - 0.06, -y, HEIGHT - 0.35), (at + 0.06, y, HEIGHT))
    for k in range(6):  # a band of windows under the eaves
        at = -x + 2.1 + k * 3.95
        for side in (-1, 1):
            glass.add_box((at, side * (y - 0.005) - 0.01, 3.2), (at + 2.6, side * (y - 0.005) + 0.01, 4.2))
    for name, made in (("floor", floor), ("walls", walls), ("steel", steel), ("glass", glass)):
        made.write(folder / "meshes" / f"{name}.obj", 0.35 if name == "floor" else 0.5)
    parts = [
        visual("floor", mesh("floor"), material(texture="concrete", roughness=0.55)),
        visual("walls", mesh("walls"), material((0.86, 0.87, 0.86), texture="plaster", roughness=0.95)),
        visual("steel", mesh("steel"), material((0.35, 0.38, 0.42), roughness=0.5, metalness=0.4)),
        visual("glass", mesh("glass"), material((0.75, 0.86, 0.93), roughness=0.1)),
    ]
    lines = [((0, side * 5.9), (LENGTH - 2, 0.1)) for side in (-1, 1)]
    lines += [((0, side * 0.95), (LENGTH - 2, 0.1)) for side in (-1, 1)]
    for k, ((at_x, at_y), (size_x, size_y)) in enumerate(lines):
        parts.append(visual(f"line_{k}", box(size_x, size_y, 0.002), material(YELLOW, roughness=0.6),
                            (at_x, at_y, 0.001)))
    for k, (low, high) in enumerate(solid):
        middle = [(a + b) / 2 for a, b in zip(low, high)]
        parts.append(collision(f"part_{k:02d}", box(*(b - a for a, b in zip(low, high))), middle))
    write_model(folder, "A hall of 24 by 16 m inside, 5 m high, its middle the origin; no roof.",
                "Warehouse hall", "A hall of 24 by 16 m with columns, gates and marked ways.",
                [link("hall", parts)], static=True)


def make_rack(folder):
    length, depth, height = RACK
    frame, beams = Mesh(), Mesh()
    posts = []
    for x in (-length / 2 + 0.04, length / 2 - 0.04):
        for y in (-depth / 2 + 0.04, depth / 2 - 0.04):
            frame.add_box((x - 0.04, y - 0.04, 0), (x + 0.04, y + 0.04, height))
            posts.append((x, y))
        for z in (0.4, 1.2, 2.0, 2.8):
            frame.add_box((x - 0.02, -depth / 2 + 0.08, z), (x + 0.02, depth / 2 - 0.08, z + 0.04))
    boards = Mesh()
    for top in SHELVES:
        for y in (-depth / 2 + 0.03, depth / 2 - 0.03):
            beams.add_box((-length / 2 + 0.08, y - 0.025, top - 0.12), (length / 2 - 0.08, y + 0.025, top))
        boards.add_box((-length / 2 + 0.08, -depth / 2 + 0.06, top - 0.03),
                       (length / 2 - 0.08, depth / 2 - 0.06, top - 0.004))
    boxes = Mesh()
    for k, (x, size, rise) in enumerate(((-0.92, 0.74, 0.7), (0, 0.8, 0.62), (0.92, 0.7, 0.78))):
        for level, top in enumerate(SHELVES):
            if (k + level) % 4 == 3:
                continue  # an empty place
            half, deep = size / 2, 0.36
            boxes.add_box((x - half, -deep, top), (x + half, deep, top + rise * (0.85 if level == 1 else 1)))
    for name, made in (("frame", frame), ("beams", beams), ("boards", boards), ("boxes", boxes)):
        made.write(folder / "meshes" / f"{name}.obj")
    parts = [
        visual("frame", mesh("frame"), material(BLUE, roughness=0.5, metalness=0.2)),
        visual("beams", mesh("beams"), material(ORANGE, roughness=0.5)),
        visual("boards", mesh("boards"), material(texture="beech", roughness=0.8)),
        visual("boxes", mesh("boxes"), material(texture="cardboard", roughness=0.95)),
        collision("lowest_shelf", box(length, depth, SHELVES[0]), (0, 0, SHELVES[0] / 2)),
        collision("load", box(length - 0.16, 0.72, height - 0.2), (0, 0, height / 2)),
    ]
    for k, (x, y) in enumerate(posts):
        parts.append(collision(f"post_{k}", box(0.08, 0.08, height), (x, y, height / 2)))
    write_model(folder, "A rack of three shelves, 2.8 by 1 m, 3 m high. Origin on the floor below its middle.",
                "Pallet rack", "A rack of 2.8 by 1 by 3 m, full of boxes.", [link("rack", parts)], static=True)


def make_pallet(folder):
    wood, boxes = Mesh(), Mesh()
    for k in range(5):
        y = -0.36 + 0.18 * k
        wood.add_box((-0.6, y - 0.05, 0.122), (0.6, y + 0.05, 0.144))
    for x in (-0.53, 0, 0.53):
        wood.add_box((x - 0.07, -0.4, 0.1), (x + 0.07, 0.4, 0.122))
        for y in (-0.33, 0, 0.33):
            wood.add_box((x - 0.07, y - 0.07, 0.02), (x + 0.07, y + 0.07, 0.1))
    for y in (-0.33, 0, 0.33):
        wood.add_box((-0.6, y - 0.05, 0), (0.6, y + 0.05, 0.02))
    for level in range(2):
        for x in (-0.39, 0, 0.39):
            for y in (-0.2, 0.2):
                low = 0.144 + 0.38 * level
                boxes.add_box((x - 0.19, y - 0.19, low), (x + 0.19, y + 0.19, low + 0.375))
    wood.write(folder / "meshes" / "wood.obj")
    boxes.write(folder / "meshes" / "boxes.obj")
    write_model(
        folder, "A pallet of 1.2 by 0.8 m with twelve boxes, 0.9 m high. Origin on the floor below its middle.",
        "Loaded pallet", "A pallet with twelve boxes.",
        [link("pallet", [
            visual("wood", mesh("wood"), material((0.86, 0.78, 0.66), texture="beech", roughness=0.9)),
            visual("boxes", mesh("boxes"), material(texture="cardboard", roughness=0.95)),
            collision("wood", box(1.2, 0.8, 0.144), (0, 0, 0.072)),
            collision("boxes", box(1.16, 0.78, 0.755), (0, 0, 0.5215)),
        ])], static=True)


def make_world(path):
    parts = [
        '<model name="ground"><static>true</static><link name="link">\n'
        '  <collision name="plane"><geometry><plane><normal>0 0 1</normal><size>80 80</size></plane></geometry>'
        "</collision>\n"
        '  <visual name="plane"><pose>0 0 -0.03 0 0 0</pose><geometry><plane><normal>0 0 1</normal>'
        "<size>80 80</size></plane></geometry>" + material((0.42, 0.44, 0.42), roughness=0.95) +
        "</visual>\n</link></model>",
        include("warehouse_hall", "hall"),
    ]
    for row, y in enumerate((-6.7, -3.4, 3.4, 6.7)):
        for k in range(5):
            parts.append(include("pallet_rack", f"rack_{row}{k}", -8.2 + 2.9 * k, y))
    pallets = [(8, -4, 0), (8.2, -1.9, 1.5708), (8, 4.2, 0.2), (9.8, 3.1, 1.5), (-10.4, 0, 1.5708),
               (6.5, 6.6, 0)]
    for k, (x, y, yaw) in enumerate(pallets):
        parts.append(include("loaded_pallet", f"pallet_{k}", x, y, 0, 0, 0, yaw))
    for k, (x, y, yaw) in enumerate(((10.6, -6.8, 0.1), (10.4, -5.9, 0.5), (-10.8, 6.9, 0.2))):
        parts.append(include("crate", f"crate_{k}", x, y, 0, 0, 0, yaw))
    write_world(path,
                "A warehouse of 24 by 16 m, its middle the origin: four rows of racks along x, a way of 5.8 m\n"
                "     between the middle rows and ways of 2.3 m between the outer ones; gates in the east.",
                parts, ambient="0.55 0.55 0.56")
