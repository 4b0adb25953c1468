#!/usr/bin/env python3
"""Checks the contents of a build with -DGSV_ROS2=OFF, without compiling it.

  ros2_off_test.py SOURCE BUILD GSV

A build without ROS 2 has the same programs, but not the plug-in, and needs no Fast DDS. So the test configures such
a build, and hides Fast DDS from it. Then it compares the commands with those of BUILD. Then it runs GSV without the
plug-in. The comparison needs a build by Ninja, because only Ninja lists its commands; otherwise it is skipped.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SOURCE, BUILD, GSV = sys.argv[1:4]
PLUGIN = ("gsv-ros2", "ros2_bridge_test", "ros2_fast_client", "ros2_peer", "tests/ros2/")  # the plug-in and its tests
SETTINGS = re.compile(r"^(CMAKE_BUILD_TYPE|CMAKE_(?:C|CXX)_(?:COMPILER|COMPILER_LAUNCHER|FLAGS)|GSV_\w+):\w+=(.*)$")
EXIT_UNAVAILABLE = 5


def cache():
    return pathlib.Path(BUILD, "CMakeCache.txt").read_text(encoding="utf-8")


def commands(build):
    """Returns the command for each output of a build, with the build's folder as BUILD."""
    listed = subprocess.run(["ninja", "-C", build, "-t", "compdb"], capture_output=True, text=True, check=True)
    return {entry["output"]: re.sub(r"CMakeFiles/d/\w+\.d", "CMakeFiles/d", entry["command"].replace(build, "BUILD"))
            for entry in json.loads(listed.stdout) if "cmake.verify_globs" not in entry["output"]}


def rest_of(outputs):
    return [output for output in outputs if not any(part in output for part in PLUGIN)]


class WithoutRos2(unittest.TestCase):
    @unittest.skipUnless("CMAKE_GENERATOR:INTERNAL=Ninja" in cache(), "not built by Ninja")
    def test_differs_by_the_plug_in_alone(self):
        settings = dict(match.groups() for match in map(SETTINGS.match, cache().splitlines()) if match)
        settings.update(GSV_ROS2="OFF", CMAKE_DISABLE_FIND_PACKAGE_fastrtps="ON")
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(["cmake", "-S", SOURCE, "-B", folder, "-G", "Ninja",
                                   *(f"-D{name}={value}" for name, value in settings.items())],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            without = commands(folder)
        whole = commands(BUILD)
        self.assertGreater(len(without), 1000)
        self.assertIn("lib/gsv/gsv-ros2.so", whole)
        self.assertNotIn("lib/gsv/gsv-ros2.so", without)
        self.assertEqual(set(rest_of(whole)), set(rest_of(without)))
        self.assertEqual([each for each in rest_of(without) if without[each] != whole[each]], [])
        self.assertEqual([each for each in without if re.search("fastrtps|fastcdr", without[each])], [])

    def test_says_so_where_ros_2_is_asked_for_and_runs_otherwise(self):
        with tempfile.TemporaryDirectory(dir=BUILD) as folder:
            os.mkdir(f"{folder}/bin")
            os.link(GSV, f"{folder}/bin/gsv")
            os.symlink(f"{BUILD}/share", f"{folder}/share")
            run = ["run", "office", "--robot", "pebble", "--headless", "--lockstep", "--duration", "0.1"]
            scenario = pathlib.Path(folder, "ros2.yaml")
            scenario.write_text("world: office\nduration: 0.1\nros2: true\n", encoding="ascii")

            def end_of(*words):
                done = subprocess.run([f"{folder}/bin/gsv", *words], capture_output=True, text=True, check=False)
                return done.returncode, done.stderr

            self.assertEqual(end_of(*run, "--record", f"{folder}/run.mcap"), (0, ""))
            for words in ([*run, "--ros2"], ["run", str(scenario), "--headless"], ["serve", "--ros2", "--port", "0"],
                          ["replay", f"{folder}/run.mcap", "--ros2"], ["ros2", "topics"]):
                code, log = end_of(*words)
                self.assertEqual(code, EXIT_UNAVAILABLE, words)
                self.assertRegex(log, "this gsv was built without ROS 2: .*Build with -DGSV_ROS2=ON", words)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
