"""Tests how the programs read, draw and end files and behaviours of other people that have faults.

usage: flawed_files_test.py GSV [PYTHON_FOLDER]    PYTHON_FOLDER is the folder of the Python package gsv
"""

import os
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib
from pathlib import Path

GSV = None
PYTHON_FOLDER = None
BOX = "<geometry><box><size>1 1 1</size></box></geometry>"
CONFIG = '<model><name>m</name><sdf version="1.9">model.sdf</sdf></model>'
# A behaviour that blocks its only thread and ignores SIGTERM.
BUSY = """#!/usr/bin/env python3
import signal
import gsv

signal.signal(signal.SIGTERM, signal.SIG_IGN)


class Busy(gsv.Behaviour):
    def run(self, robot):
        while True:
            pass


gsv.serve("busy", Busy)
"""


def png(width, height):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + bytes([128, 128, 255]) * width for _ in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def tiff(width, height):
    """A grey image, 8 bits a pixel, without compression."""
    entries = [(256, 3, width), (257, 3, height), (258, 3, 8), (259, 3, 1), (262, 3, 1), (273, 4, 8), (277, 3, 1),
               (278, 3, height), (279, 4, width * height)]
    pixels = bytes((10 * (x + y)) % 256 for y in range(height) for x in range(width))
    padding = b"\0" * (len(pixels) % 2)
    directory = struct.pack("<H", len(entries)) + b"".join(
        struct.pack("<HHI", tag, kind, 1) + (struct.pack("<HH", value, 0) if kind == 3 else struct.pack("<I", value))
        for tag, kind, value in entries) + struct.pack("<I", 0)
    return b"II*\0" + struct.pack("<I", 8 + len(pixels + padding)) + pixels + padding + directory


class FlawedFiles(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, name, content):
        path = Path(self.folder.name) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def gsv(self, *arguments, **options):
        return subprocess.run([GSV, *map(str, arguments)], cwd=self.folder.name, capture_output=True, text=True,
                              timeout=60, check=False, **options)

    def assertClean(self, done):
        self.assertEqual((done.returncode, done.stdout.splitlines()[-1:]), (0, ["0 errors, 0 warnings"]), done.stdout)

    def test_uris_of_models_are_percent_decoded(self):
        self.write("models/red chair/model.config", CONFIG)
        self.write("models/red chair/meshes/one leg.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.write("models/red chair/model.sdf",
                   '<sdf version="1.9"><model name="m"><static>true</static><link name="l"><visual name="v"><geometry><mesh>'
                   "<uri>model://red%20chair/meshes/one%20leg.obj</uri></mesh></geometry></visual></link></model></sdf>")
        world = self.write("hall.sdf", '<sdf version="1.9"><world name="w"><include><uri>model://red%20chair</uri></include>'
                                       "</world></sdf>")
        self.assertClean(self.gsv("world", "check", "--strict", world, "--model-path", "models"))

    def test_a_world_with_a_model_far_away_is_drawn(self):
        def model(name, z):
            return (f'<model name="{name}"><static>true</static><pose>1 0 {z} 0 0 0</pose><link name="l">'
                    f'<visual name="v">{BOX}</visual></link></model>')
        world = self.write("far.sdf", f'<sdf version="1.9"><world name="w">{model("near", 0.5)}{model("lost", 250000)}'
                                      "</world></sdf>")
        done = self.gsv("world", "draw", world, "far.png", "--width", 64, "--height", 48)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater((Path(self.folder.name) / "far.png").stat().st_size, 100)

    def test_a_normal_map_is_found_beside_the_material_script(self):
        self.write("wall/model.config", CONFIG)
        self.write("wall/materials/textures/bricks.png", png(4, 4))
        self.write("wall/materials/textures/dents.png", png(4, 4))
        self.write("wall/materials/scripts/wall.material",
                   "material Test/Wall { technique { pass { texture_unit { texture bricks.png } } } }\n")
        self.write("wall/model.sdf",
                   f'<sdf version="1.6"><model name="wall"><static>true</static><link name="l"><visual name="v">{BOX}<material>'
                   "<script><uri>model://wall/materials/scripts</uri><uri>model://wall/materials/textures</uri>"
                   '<name>Test/Wall</name></script><shader type="normal_map_tangent_space"><normal_map>dents.png</normal_map>'
                   "</shader></material></visual></link></model></sdf>")
        self.assertClean(self.gsv("model", "check", "--strict", "wall", "--model-path", "."))

    def test_a_heightmap_may_be_a_tiff_file(self):
        self.write("dunes.tif", tiff(5, 5))
        heightmap = "<geometry><heightmap><uri>dunes.tif</uri><size>10 10 2</size></heightmap></geometry>"
        model = self.write("dunes.sdf", '<sdf version="1.9"><model name="m"><static>true</static><link name="l">'
                                        f'<collision name="c">{heightmap}</collision></link></model></sdf>')
        self.assertClean(self.gsv("model", "check", "--strict", model))

    def test_a_behaviour_that_never_waits_does_not_hold_up_the_end(self):
        if not PYTHON_FOLDER or not (Path(PYTHON_FOLDER) / "gsv").is_dir():
            self.skipTest("there is no Python package gsv")
        self.write("bin/gsv-busy", BUSY).chmod(0o755)
        environment = {**os.environ, "PATH": f"{self.folder.name}/bin:{os.environ['PATH']}", "PYTHONPATH": str(PYTHON_FOLDER)}
        began = time.monotonic()
        done = self.gsv("run", "playground", "--robot", "pebble@0,0", "--behaviour", "busy", "--headless", "--lockstep",
                        "--duration", "5", "--wall-timeout", "3", env=environment)
        self.assertEqual(done.returncode, 124, done.stderr)
        self.assertLess(time.monotonic() - began, 15)


if __name__ == "__main__":
    GSV = Path(sys.argv.pop(1)).resolve()
    PYTHON_FOLDER = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else None
    unittest.main()
