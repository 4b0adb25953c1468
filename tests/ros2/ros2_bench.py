#!/usr/bin/env python3
"""Measures what publishing to ROS 2 costs: robots with a lidar, one reader of all on Cyclone DDS.

  ros2_bench.py GSV ROS2_PEER [--robots N] [--seconds S]

Each robot has scan (360 beams, 10 Hz) and odom (50 Hz); /tf is read too. Prints the processor time of gsv and of
the reader in % of a core, without ROS 2, without a reader and with one, and the share of the samples that came.
Then the processor time for four cameras of 640 x 480 pixels at 30 Hz whose image_raw is read, drawing included.
"""
import argparse
import json
import os
import pathlib
import subprocess
import tempfile
import time

WORLD = """<sdf version="1.9"><world name="field">
<physics type="ode"><max_step_size>0.01</max_step_size></physics>
<model name="ground"><static>true</static><link name="link"><collision name="plane"><geometry>
<plane><normal>0 0 1</normal></plane></geometry></collision></link></model></world></sdf>
"""
ROBOT = """<sdf version="1.9"><model name="scout"><link name="base_link">
<collision name="body"><pose>0 0 0.15 0 0 0</pose><geometry><cylinder><radius>0.2</radius><length>0.3</length>
</cylinder></geometry></collision>
<sensor name="lidar" type="gpu_lidar"><pose>0 0 0.35 0 0 0</pose><update_rate>10</update_rate><lidar>
<scan><horizontal><samples>360</samples><min_angle>-3.14159</min_angle><max_angle>3.12414</max_angle></horizontal></scan>
<range><min>0.1</min><max>10</max></range></lidar></sensor></link>
<plugin filename="gz-sim-velocity-control-system" name="gz::sim::systems::VelocityControl"/></model></sdf>
"""
CAMERA = """<sdf version="1.9"><model name="eye"><link name="base_link">
<collision name="body"><pose>0 0 0.15 0 0 0</pose><geometry><cylinder><radius>0.2</radius><length>0.3</length>
</cylinder></geometry></collision>
<sensor name="camera" type="camera"><pose>0 0 0.5 0 0 0</pose><update_rate>30</update_rate><camera>
<horizontal_fov>1.2</horizontal_fov><image><width>640</width><height>480</height><format>R8G8B8</format></image>
<clip><near>0.1</near><far>30</far></clip></camera></sensor></link>
<plugin filename="gz-sim-velocity-control-system" name="gz::sim::systems::VelocityControl"/></model></sdf>
"""
SCAN, ODOM, TF = 10, 50, 50  # Hz
IMAGE = 30  # Hz


def processor_seconds(process):
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text(encoding="ascii").rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def percent(process, seconds):
    """Its processor time over so many seconds from now on."""
    before, begin = processor_seconds(process), time.monotonic()
    time.sleep(seconds)
    return 100 * (processor_seconds(process) - before) / (time.monotonic() - begin)


def start(command, domain):
    """gsv with ROS 2, once it is published."""
    gsv = subprocess.Popen(
        [*command, "--ros2"], env={**os.environ, "ROS_DOMAIN_ID": domain}, stdout=subprocess.PIPE, text=True)
    for line in gsv.stdout:
        if line.startswith("ros2:"):
            break
    return gsv


def read_images(folder, arguments, domain):
    robots = [f"{folder}/eye.sdf@{3 * i},0" for i in range(4)]
    names = ["eye", *(f"eye_{i}" for i in range(2, 5))]
    gsv = start([arguments.gsv, "run", f"{folder}/field.sdf", "--headless",
                 *(word for robot in robots for word in ("--robot", robot))], domain)
    time.sleep(3)
    topics = [f"sensor_msgs/msg/Image:/{name}/camera/image_raw" for name in names]
    reader = subprocess.Popen(
        [arguments.peer, "count", "--domain", domain, "--timeout", str(arguments.seconds + 60),
         "--seconds", str(arguments.seconds + 4), *topics], stdout=subprocess.PIPE, text=True)
    time.sleep(5)  # discovery
    busy = percent(gsv, arguments.seconds)
    result = json.loads(reader.communicate()[0])
    expected = len(names) * IMAGE * result["seconds"]
    print(f"4 cameras, image_raw read: gsv {busy:.1f} % with drawing, "
          f"{100 * result['samples'] / expected:.0f} % of {len(names) * IMAGE} images/s came")
    gsv.terminate()
    gsv.communicate()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("gsv")
    parser.add_argument("peer")
    parser.add_argument("--robots", type=int, default=100)
    parser.add_argument("--seconds", type=float, default=10)
    arguments = parser.parse_args()
    domain = str(100 + os.getpid() % 100)
    names = ["scout", *(f"scout_{i}" for i in range(2, arguments.robots + 1))]
    with tempfile.TemporaryDirectory(prefix="gsv-ros2-bench-") as folder:
        pathlib.Path(folder, "field.sdf").write_text(WORLD, encoding="ascii")
        pathlib.Path(folder, "scout.sdf").write_text(ROBOT, encoding="ascii")
        pathlib.Path(folder, "eye.sdf").write_text(CAMERA, encoding="ascii")
        robots = [f"{folder}/scout.sdf@{3 * (i % 10)},{3 * (i // 10)}" for i in range(arguments.robots)]
        command = [arguments.gsv, "run", f"{folder}/field.sdf", "--headless",
                   *(word for robot in robots for word in ("--robot", robot))]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL) as alone:
            time.sleep(3)  # start-up is not measured
            print(f"without --ros2: gsv {percent(alone, arguments.seconds):.1f} % of a core")
            alone.terminate()
        gsv = start(command, domain)
        time.sleep(3)
        print(f"nobody reads: gsv {percent(gsv, arguments.seconds):.1f} % of a core")
        topics = ["tf2_msgs/msg/TFMessage:/tf"]
        for name in names:
            topics += [f"sensor_msgs/msg/LaserScan:/{name}/scan", f"nav_msgs/msg/Odometry:/{name}/odom"]
        reader = subprocess.Popen(
            [arguments.peer, "count", "--domain", domain, "--timeout", str(arguments.seconds + 60),
             "--seconds", str(arguments.seconds + 4), *topics], stdout=subprocess.PIPE, text=True)
        time.sleep(5)  # discovery
        before, begin = processor_seconds(reader), time.monotonic()
        busy = percent(gsv, arguments.seconds)
        reading = 100 * (processor_seconds(reader) - before) / (time.monotonic() - begin)
        result = json.loads(reader.communicate()[0])
        expected = (arguments.robots * (SCAN + ODOM) + TF) * result["seconds"]
        print(f"one reader of {len(topics)} topics: gsv {busy:.1f} %, reader {reading:.1f} %, "
              f"{100 * result['samples'] / expected:.0f} % of {expected / result['seconds']:.0f} samples/s came, "
              f"all topics had one after {result['first_samples_s']:.2f} s")
        gsv.terminate()
        print(gsv.communicate()[0].splitlines()[0])
        read_images(folder, arguments, domain)


if __name__ == "__main__":
    main()
