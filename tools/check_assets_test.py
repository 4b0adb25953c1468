#!/usr/bin/env python3
"""Tests assets/: the worlds and robots of GSV have no errors, and the default robots start without contacts.

Reads the SDFormat files with its own code, so that an error in the simulator's reader cannot hide
an error in the files. All collisions must be upright boxes, cylinders and spheres. The tests
compare their outlines as seen from above.
"""

import math
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

ASSETS = Path(__file__).resolve().parent.parent / "assets"
MODELS = ASSETS / "models"

# Where `gsv run` places its robots by default: model, x, y.
DEFAULT_ROBOTS = [
    ("b21r", -3.0, 0.0),
    ("b21r", 0.0, -3.0),
    ("pebble", 2.5, 0.0),
    ("pebble", -5.0, 3.0),
    ("rover4", 4.8, 3.5),
]
CLEARANCE = 0.6  # minimum distance between a robot's outline and any obstacle, m


class Obstacle:
    """An outline seen from above, between two heights: a rectangle, or a disc if it has a radius."""

    def __init__(self, owner, x, y, yaw, half_x, half_y, radius, low, high):
        self.owner, self.x, self.y, self.yaw = owner, x, y, yaw
        self.half_x, self.half_y, self.radius = half_x, half_y, radius
        self.low, self.high = low, high

    def distance(self, x, y):
        """Returns the distance from a point to the outline; 0 inside."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        dx, dy = x - self.x, y - self.y
        across = max(abs(c * dx + s * dy) - self.half_x, 0)
        along = max(abs(c * dy - s * dx) - self.half_y, 0)
        return max(math.hypot(across, along) - self.radius, 0)

    def corners(self):
        """Returns points of the outline: the corners of a rectangle, or sixteen points of a disc."""
        if self.radius:
            for k in range(16):
                a = math.pi * k / 8
                yield self.x + self.radius * math.cos(a), self.y + self.radius * math.sin(a)
            return
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        for u, v in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
            a, b = u * self.half_x, v * self.half_y
            yield self.x + c * a - s * b, self.y + s * a + c * b


def pose_of(element):
    """Returns x, y, z and yaw of an element's <pose>. Roll and pitch must be zero."""
    pose = element.find("pose")
    if pose is None:
        return 0.0, 0.0, 0.0, 0.0
    x, y, z, roll, pitch, yaw = map(float, pose.text.split())
    if (roll, pitch) != (0, 0):
        raise ValueError(f"a collision is tilted: {pose.text}")
    return x, y, z, math.radians(yaw) if pose.get("degrees") == "true" else yaw


def compose(outer, inner):
    ox, oy, oz, oyaw = outer
    ix, iy, iz, iyaw = inner
    c, s = math.cos(oyaw), math.sin(oyaw)
    return ox + c * ix - s * iy, oy + s * ix + c * iy, oz + iz, oyaw + iyaw


def parse(path):
    return ElementTree.parse(path).getroot()


def model_named(name):
    return parse(MODELS / name / "model.sdf").find("model")


def obstacles_of_model(model, owner, world_from_model):
    for link in model.findall("link"):
        world_from_link = compose(world_from_model, pose_of(link))
        for collision in link.findall("collision"):
            x, y, z, yaw = compose(world_from_link, pose_of(collision))
            geometry = collision.find("geometry")
            if geometry.find("plane") is not None:
                continue
            if (size := geometry.findtext("box/size")) is not None:
                a, b, height = (float(value) for value in size.split())
                yield Obstacle(owner, x, y, yaw, a / 2, b / 2, 0, z - height / 2, z + height / 2)
            elif (radius := geometry.findtext("cylinder/radius")) is not None:
                height = float(geometry.findtext("cylinder/length"))
                yield Obstacle(owner, x, y, 0, 0, 0, float(radius), z - height / 2, z + height / 2)
            else:
                radius = float(geometry.findtext("sphere/radius"))
                yield Obstacle(owner, x, y, 0, 0, 0, radius, z - radius, z + radius)


def obstacles_of_world(name):
    world = parse(ASSETS / "worlds" / name).find("world")
    found = []
    for include in world.findall("include"):
        model = model_named(include.findtext("uri").removeprefix("model://"))
        owner = include.findtext("name") or model.get("name")
        found += obstacles_of_model(model, owner, pose_of(include))
    for model in world.findall("model"):
        found += obstacles_of_model(model, model.get("name"), pose_of(model))
    return found


def reach(model):
    """Returns the radius of a circle about the origin that contains a robot's body. Wheels count as balls."""
    farthest = 0.0
    for link in model.findall("link"):
        if link.get("name").endswith("wheel"):
            x, y = map(float, link.findtext("pose").split()[:2])
            farthest = max(farthest, math.hypot(x, y) + float(link.findtext(".//radius")))
            continue
        for obstacle in obstacles_of_model(as_model(link), "robot", (0, 0, 0, 0)):
            rim = obstacle.radius + math.hypot(obstacle.half_x, obstacle.half_y)
            farthest = max(farthest, math.hypot(obstacle.x, obstacle.y) + rim)
    return farthest


def as_model(link):
    model = ElementTree.Element("model")
    model.append(link)
    return model


class Office(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.obstacles = obstacles_of_world("office.sdf")
        # The obstacles for a robot of the B21r's height.
        cls.low = [o for o in cls.obstacles if o.low < 1.2]

    def test_default_robots_start_in_the_clear(self):
        for robot, x, y in DEFAULT_ROBOTS:
            radius = reach(model_named(robot))
            nearest = min(self.low, key=lambda o: o.distance(x, y))
            with self.subTest(robot=robot, x=x, y=y, nearest=nearest.owner):
                self.assertGreaterEqual(nearest.distance(x, y) - radius, CLEARANCE)

    def test_default_robots_start_apart(self):
        for i, (a, ax, ay) in enumerate(DEFAULT_ROBOTS):
            for b, bx, by in DEFAULT_ROBOTS[i + 1 :]:
                gap = math.hypot(ax - bx, ay - by) - reach(model_named(a)) - reach(model_named(b))
                self.assertGreater(gap, CLEARANCE, f"{a} and {b}")

    def test_every_room_can_be_reached_by_the_widest_robot(self):
        free = self.free_cells(spacing=0.2, radius=0.3)
        reached = {(0, 0)}
        todo = [(0, 0)]
        while todo:
            i, j = todo.pop()
            for cell in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)):
                if cell in free and cell not in reached:
                    reached.add(cell)
                    todo.append(cell)
        rooms = {"west office": (-5.2, 3), "middle office": (0, 3), "laboratory": (5, 3),
                 "meeting room": (-6.8, -2), "lounge": (0, -3), "east office": (5.4, -3)}
        for room, (x, y) in rooms.items():
            self.assertIn((round(x / 0.2), round(y / 0.2)), reached, room)

    def free_cells(self, spacing, radius):
        return {
            (i, j)
            for i in range(round(-8 / spacing), round(8 / spacing) + 1)
            for j in range(round(-6 / spacing), round(6 / spacing) + 1)
            if all(o.distance(i * spacing, j * spacing) > radius for o in self.low)
        }

    def test_no_piece_of_furniture_stands_in_another_or_in_a_wall(self):
        for i, a in enumerate(self.obstacles):
            for b in self.obstacles[i + 1 :]:
                if a.owner == b.owner or a.low >= b.high - 1e-6 or b.low >= a.high - 1e-6:
                    continue
                nearest = min(
                    min(a.distance(x, y) for x, y in (*b.corners(), (b.x, b.y))),
                    min(b.distance(x, y) for x, y in (*a.corners(), (a.x, a.y))),
                )
                self.assertGreater(nearest, 0, f"{a.owner} and {b.owner}")

    def test_doors_are_at_least_1_2_m_wide(self):
        for x, y in ((-4.2, 1.25), (0, 1.25), (5.1, 1.25), (-5.5, -1.25), (5.5, -1.25), (2.5, 3.9)):
            nearest = min(o.distance(x, y) for o in self.low)
            self.assertGreaterEqual(2 * nearest, 1.2, f"the door at {x}, {y}")


class Playground(unittest.TestCase):
    def test_stands_as_its_comment_says(self):
        obstacles = {o.owner: o for o in obstacles_of_world("playground.sdf")}
        self.assertEqual(
            {name: (o.x, o.y) for name, o in obstacles.items() if not name.endswith("wall")},
            {"red_box": (2, 2), "blue_cylinder": (-2, 2), "green_bar": (-2, -2), "yellow_ball": (2, -2)},
        )
        self.assertAlmostEqual(obstacles["east_wall"].distance(0, 0), 5)
        self.assertAlmostEqual(obstacles["west_wall"].distance(0, 0), 5)
        self.assertAlmostEqual(obstacles["north_wall"].distance(0, 0), 5)
        self.assertAlmostEqual(obstacles["south_wall"].distance(0, 0), 5)
        self.assertGreater(min(o.distance(0, 0) for o in obstacles.values()), 1.5)


class Maze(unittest.TestCase):
    def test_cell_middles_are_clear_by_nearly_a_metre(self):
        obstacles = obstacles_of_world("maze.sdf")
        for x in range(-4, 5, 2):
            for y in range(-4, 5, 2):
                nearest = min(o.distance(x, y) for o in obstacles)
                self.assertAlmostEqual(nearest, 0.94, msg=f"at {x}, {y}", delta=0.07)

    def test_is_closed(self):
        obstacles = obstacles_of_world("maze.sdf")
        for k in range(-49, 50):
            for x, y in ((k / 10, 5), (k / 10, -5), (5, k / 10), (-5, k / 10)):
                self.assertEqual(min(o.distance(x, y) for o in obstacles), 0, f"a gap at {x}, {y}")


class Warehouse(unittest.TestCase):
    def setUp(self):
        self.obstacles = obstacles_of_world("warehouse.sdf")

    def test_its_ways_are_as_wide_as_its_comment_says(self):
        for k in range(-70, 45):
            x = k / 10
            distance = min(o.distance(x, 0) for o in self.obstacles)
            self.assertAlmostEqual(distance, 5.8 / 2, delta=0.01, msg=f"at x = {x}")
            for y in (-5.05, 5.05):
                distance = min(o.distance(x, y) for o in self.obstacles)
                self.assertAlmostEqual(distance, 2.3 / 2, delta=0.01, msg=f"at {x}, {y}")

    def test_nothing_stands_in_anything_else(self):
        for a in self.obstacles:
            for b in self.obstacles:
                if a.owner >= b.owner or a.low >= b.high or b.low >= a.high:
                    continue
                for x, y in a.corners():
                    self.assertGreater(b.distance(x, y), 0, f"{a.owner} in {b.owner}")


class Robots(unittest.TestCase):
    def sonars(self, robot):
        return [s for s in model_named(robot).iter("sensor") if s.get("type") == "sonar"]

    def test_b21r_has_24_sonars_every_15_degrees_counter_clockwise_from_ahead(self):
        sonars = self.sonars("b21r")
        self.assertEqual([s.get("name") for s in sonars], [f"sonar_{k:02d}" for k in range(24)])
        for k, sonar in enumerate(sonars):
            x, y, z, _, _, yaw = map(float, sonar.findtext("pose").split())
            self.assertEqual(yaw % 360, 15 * k)
            self.assertAlmostEqual(math.degrees(math.atan2(y, x)) % 360, 15 * k, delta=0.02)
            self.assertAlmostEqual(z, 0.3)
            self.assertEqual(float(sonar.findtext("sonar/min")), 0.15)
            self.assertEqual(float(sonar.findtext("sonar/max")), 5.0)

    def test_the_small_robots_have_8_sonars_every_45_degrees(self):
        for robot in ("pebble", "rover4", "courier"):
            headings = [float(s.findtext("pose").split()[5]) % 360 for s in self.sonars(robot)]
            self.assertEqual(headings, [45 * k for k in range(8)], robot)

    def test_each_robot_has_a_drive_and_a_camera(self):
        for robot in ("b21r", "pebble", "rover4", "courier", "avatar"):
            model = model_named(robot)
            drives = [p for p in model.findall("plugin") if "JointPosition" not in p.get("name")]
            self.assertEqual(len(drives), 1, robot)
            cameras = [s for s in model.iter("sensor") if s.get("type") == "camera"]
            self.assertEqual(len(cameras), 1, robot)


class Files(unittest.TestCase):
    def test_every_model_has_a_config_and_a_name_of_its_own(self):
        for folder in self.model_folders():
            config = parse(folder / "model.config")
            self.assertEqual(config.findtext("sdf"), "model.sdf")
            self.assertEqual(parse(folder / "model.sdf").find("model").get("name"), folder.name)

    def test_whatever_a_file_names_is_there(self):
        for path in (*MODELS.glob("*/model.sdf"), *(ASSETS / "worlds").glob("*.sdf")):
            root = parse(path)
            for element in (*root.iter("uri"), *root.iter("albedo_map")):
                name = element.text
                if name.startswith("model://"):
                    place = MODELS / name.removeprefix("model://")
                else:
                    place = path.parent / name
                self.assertTrue(place.exists(), f"{path}: {name}")

    def test_textures_stay_small(self):
        sizes = [p.stat().st_size for p in (MODELS / "textures").iterdir()]
        self.assertLess(sum(sizes), 600_000)

    def model_folders(self):
        return [p for p in MODELS.iterdir() if p.is_dir() and p.name != "textures"]


if __name__ == "__main__":
    unittest.main()
