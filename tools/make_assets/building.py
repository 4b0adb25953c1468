"""Makes the meshes and collision boxes of the office floor from a plan of walls with openings.

The floor is 16 by 12 m inside. The origin is in its middle, and x points along the corridor.
"""

from dataclasses import dataclass

from mesh import Mesh

HEIGHT = 2.5
DOOR = 2.1  # height of doors
INNER, OUTER = 0.12, 0.2  # thickness of inner and outer walls


@dataclass
class Opening:
    begin: float
    end: float
    bottom: float = 0.0
    top: float = DOOR
    filling: str = "nothing"  # "nothing" (an opening), "glass" or "leaf" (a door)


@dataclass
class Wall:
    along: str  # "x" or "y"
    across: float  # coordinate of the wall's middle on the other axis
    begin: float
    end: float
    thickness: float
    openings: tuple = ()


def door(middle, width=1.4):
    return Opening(middle - width / 2, middle + width / 2)


def window(begin, end, bottom=0.9):
    return Opening(begin, end, bottom, 2.15, "glass")


PLAN = [
    # The outer walls: north, south, west, east.
    Wall("x", 6.1, -8.2, 8.2, OUTER,
         (window(-7.2, -5.6), window(-5.0, -3.4), window(-1.2, 1.2), window(3.4, 5.0), window(5.6, 7.2))),
    Wall("x", -6.1, -8.2, 8.2, OUTER,
         (window(-6.8, -4.2), window(-2.2, 2.2, bottom=0.5), window(4.4, 6.6))),
    Wall("y", -8.1, -6, 6, OUTER, (window(-0.7, 0.7), window(-4.8, -2.6), window(2.6, 4.8))),
    Wall("y", 8.1, -6, 6, OUTER,
         (Opening(-0.6, 0.6, 0, DOOR, "leaf"), window(-4.8, -2.6), window(2.6, 4.8))),
    # The walls along the corridor, which is 2.38 m wide.
    Wall("x", 1.25, -8, 8, INNER, (door(-4.2), door(0), door(5.1))),
    Wall("x", -1.25, -8, -3, INNER, (door(-5.5),)),
    Wall("x", -1.25, 3, 8, INNER, (door(5.5),)),
    # The walls between the rooms.
    Wall("y", -2.5, 1.31, 6, INNER),
    Wall("y", 2.5, 1.31, 6, INNER, (door(3.9),)),
    Wall("y", -3, -6, -1.31 + INNER, INNER),
    Wall("y", 3, -6, -1.31 + INNER, INNER),
]

FLOORS = {  # material: rectangles (x0, y0, x1, y1)
    "oak": [(-8, -6, -3, -1.25), (-3, -6, 3, -1.25)],
    "carpet": [(-8, 1.25, 2.5, 6), (3, -6, 8, -1.25)],
    "tiles": [(-8, -1.25, 8, 1.25), (2.5, 1.25, 8, 6)],
}
TEXTURE_SCALE = {"oak": 0.6, "carpet": 0.5, "tiles": 0.5, "plaster": 0.5, "wood": 0.5}


def make(folder):
    meshes = {name: Mesh() for name in ("plaster", "wood", "glass", *FLOORS)}
    collisions = []
    for wall in PLAN:
        for name, low, high in parts_of(wall):
            meshes[name].add_box(low, high)
            collisions.append((low, high))
        for low, high in trim_of(wall):
            meshes["wood"].add_box(low, high)
    for name, rectangles in FLOORS.items():
        for x0, y0, x1, y1 in rectangles:
            corners = [(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)]
            meshes[name].add_quad(corners, [(x, y) for x, y, _ in corners])
    for name, mesh in meshes.items():
        mesh.write(folder / "meshes" / f"{name}.obj", TEXTURE_SCALE.get(name, 1.0))
    (folder / "model.sdf").write_text(model_file(collisions), encoding="utf-8")


def placed(wall, begin, end, bottom, top, thickness):
    """Returns a part of a wall as (low corner, high corner)."""
    low, high = wall.across - thickness / 2, wall.across + thickness / 2
    if wall.along == "x":
        return (begin, low, bottom), (end, high, top)
    return (low, begin, bottom), (high, end, top)


def parts_of(wall):
    """Returns the wall's solid parts as (mesh, low corner, high corner)."""
    at = wall.begin
    for opening in sorted(wall.openings, key=lambda o: o.begin):
        yield ("plaster", *placed(wall, at, opening.begin, 0, HEIGHT, wall.thickness))
        if opening.bottom > 0:
            yield ("plaster",
                   *placed(wall, opening.begin, opening.end, 0, opening.bottom, wall.thickness))
        yield ("plaster",
               *placed(wall, opening.begin, opening.end, opening.top, HEIGHT, wall.thickness))
        if opening.filling != "nothing":
            name, thickness = ("glass", 0.02) if opening.filling == "glass" else ("wood", 0.05)
            yield (name, *placed(wall, opening.begin, opening.end, opening.bottom, opening.top, thickness))
        at = opening.end
    yield ("plaster", *placed(wall, at, wall.end, 0, HEIGHT, wall.thickness))


def trim_of(wall):
    """Returns door frames, window frames and skirting, which protrude by 1 cm and have no collisions."""
    proud, width, lap = wall.thickness + 0.02, 0.06, 0.01
    at = wall.begin
    for opening in sorted(wall.openings, key=lambda o: o.begin):
        begin, end = opening.begin - width, opening.end + width
        yield placed(wall, begin, opening.begin + lap, opening.bottom, opening.top, proud)
        yield placed(wall, opening.end - lap, end, opening.bottom, opening.top, proud)
        yield placed(wall, begin, end, opening.top - lap, opening.top + width, proud)
        if opening.bottom > 0:
            yield placed(wall, begin, end, opening.bottom - 0.04, opening.bottom + lap, proud + 0.04)
            continue
        yield placed(wall, at, begin, 0, 0.08, proud)
        at = end
    yield placed(wall, at, wall.end, 0, 0.08, proud)


VISUALS = [  # mesh, material
    ("plaster", "<diffuse>1 1 1 1</diffuse>", "plaster", 0.95),
    ("wood", "<diffuse>0.72 0.6 0.5 1</diffuse>", "beech", 0.6),
    ("oak", "<diffuse>1 1 1 1</diffuse>", "oak", 0.55),
    ("carpet", "<diffuse>1 1 1 1</diffuse>", "carpet", 1.0),
    ("tiles", "<diffuse>1 1 1 1</diffuse>", "tiles", 0.4),
]


def model_file(collisions):
    lines = [
        '<?xml version="1.0"?>',
        "<!-- Made by tools/make_assets from the plan in building.py. -->",
        '<sdf version="1.9">',
        '  <model name="office_building">',
        "    <static>true</static>",
        '    <link name="building">',
    ]
    for name, colour, texture, roughness in VISUALS:
        lines += [
            f'      <visual name="{name}">',
            f"        <geometry><mesh><uri>meshes/{name}.obj</uri></mesh></geometry>",
            f"        <material>{colour}<pbr><metal>"
            f"<albedo_map>model://textures/{texture}.jpg</albedo_map>"
            f"<roughness>{roughness}</roughness><metalness>0</metalness></metal></pbr></material>",
            "      </visual>",
        ]
    lines += [
        '      <visual name="glass">',
        "        <cast_shadows>false</cast_shadows>",
        "        <transparency>0.75</transparency>",
        "        <geometry><mesh><uri>meshes/glass.obj</uri></mesh></geometry>",
        "        <material><diffuse>0.7 0.82 0.86 1</diffuse><pbr><metal>"
        "<roughness>0.1</roughness><metalness>0</metalness></metal></pbr></material>",
        "      </visual>",
    ]
    for number, (low, high) in enumerate(collisions):
        middle = " ".join(f"{(a + b) / 2:.6g}" for a, b in zip(low, high))
        size = " ".join(f"{b - a:.6g}" for a, b in zip(low, high))
        lines += [
            f'      <collision name="part_{number:02d}">',
            f"        <pose>{middle} 0 0 0</pose><geometry><box><size>{size}</size></box></geometry>",
            "      </collision>",
        ]
    lines += ["    </link>", "  </model>", "</sdf>", ""]
    return "\n".join(lines)
