#!/usr/bin/env python3
"""Holds what a robot's sensors publish, as another DDS decodes it, to values in closed form.

  ros2_content_test.py GSV ROS2_PEER

The robot "arm" stands at the origin and looks along x at a wall whose near side is the plane x = 2.
"""
import contextlib
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

GSV, PEER = sys.argv[1:3]
os.environ.setdefault("ASAN_OPTIONS", "new_delete_type_mismatch=0")
DOMAIN = str(140 + os.getpid() % 40)  # apart from others on this machine

WORLD = """<sdf version="1.9"><world name="room"><gravity>0 0 -9.8</gravity>
<physics type="ode"><max_step_size>0.01</max_step_size></physics>
<scene><background>0 0 1 1</background><sky/></scene>
<model name="ground"><static>true</static><link name="link"><collision name="plane"><geometry>
<plane><normal>0 0 1</normal></plane></geometry></collision></link></model>
<model name="wall"><static>true</static><pose>2.5 0 1 0 0 0</pose><link name="link"><collision name="box"><geometry>
<box><size>1 20 2</size></box></geometry></collision></link></model></world></sdf>
"""
ROBOT = """<sdf version="1.9"><model name="arm"><link name="base_link">
<collision name="body"><pose>0 0 0.15 0 0 0</pose><geometry><cylinder><radius>0.2</radius><length>0.3</length>
</cylinder></geometry></collision>
<sensor name="lidar" type="gpu_lidar"><pose>0.1 0 0.35 0 0 0</pose><update_rate>10</update_rate><lidar><scan><horizontal>
<samples>91</samples><min_angle>-0.7853981634</min_angle><max_angle>0.7853981634</max_angle></horizontal></scan>
<range><min>0.1</min><max>2.5</max></range></lidar></sensor>
<sensor name="imu" type="imu"><update_rate>50</update_rate></sensor>
<sensor name="sonar" type="sonar"><pose>0.2 0 0.4 0 0 0</pose>
<sonar><min>0.02</min><max>3</max><radius>0.4</radius></sonar></sensor>
<sensor name="camera" type="camera"><pose>0 0 0.5 0 0 0</pose><update_rate>10</update_rate><camera>
<horizontal_fov>1.2</horizontal_fov><image><width>64</width><height>48</height><format>R8G8B8</format></image>
<clip><near>0.1</near><far>10</far></clip></camera></sensor></link>
<link name="lift"><pose>0 0 0.4 0 0 0</pose></link>
<joint name="lift_joint" type="prismatic"><parent>base_link</parent><child>lift</child><axis><xyz>0 0 1</xyz>
<limit><lower>0</lower><upper>0.5</upper></limit></axis></joint>
<plugin filename="gz-sim-velocity-control-system" name="gz::sim::systems::VelocityControl"/></model></sdf>
"""


@contextlib.contextmanager
def running_gsv():
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "room.sdf").write_text(WORLD, encoding="ascii")
        pathlib.Path(folder, "arm.sdf").write_text(ROBOT, encoding="ascii")
        gsv = subprocess.Popen([GSV, "run", f"{folder}/room.sdf", "--robot", f"{folder}/arm.sdf@0,0", "--ros2", "--headless"],
                               env={**os.environ, "ROS_DOMAIN_ID": DOMAIN}, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True)
        try:
            yield gsv
        finally:
            gsv.terminate()
            gsv.log = gsv.communicate(timeout=30)[1]


def listen(*topics):
    done = subprocess.run([PEER, "listen", *topics, "--domain", DOMAIN, "--timeout", "40"], capture_output=True,
                          text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return {sample["topic"]: sample["message"] for sample in map(json.loads, done.stdout.splitlines())}


class Contents(unittest.TestCase):
    def test_every_field_has_its_value_in_closed_form(self):
        with running_gsv():
            messages = listen(
                "sensor_msgs/msg/LaserScan:/arm/scan", "sensor_msgs/msg/Imu:/arm/imu",
                "sensor_msgs/msg/Range:/arm/range", "sensor_msgs/msg/Image:/arm/camera/image_raw",
                "sensor_msgs/msg/CameraInfo:/arm/camera/camera_info",
                "sensor_msgs/msg/JointState:/arm/joint_states", "nav_msgs/msg/Odometry:/arm/odom")
        self.check_scan(messages["/arm/scan"])
        self.check_imu(messages["/arm/imu"])
        self.check_range(messages["/arm/range"])
        self.check_image(messages["/arm/camera/image_raw"])
        self.check_camera_info(messages["/arm/camera/camera_info"])
        self.check_joints(messages["/arm/joint_states"])
        self.check_odometry(messages["/arm/odom"])

    def check_scan(self, scan):
        self.assertEqual(scan["header"]["frame_id"], "arm/lidar")
        self.assertEqual(scan["header"]["stamp"]["nanosec"] % 100_000_000, 0)  # 10 Hz
        self.assertAlmostEqual(scan["angle_min"], -math.pi / 4, 6)
        self.assertAlmostEqual(scan["angle_max"], math.pi / 4, 6)
        self.assertAlmostEqual(scan["angle_increment"], math.pi / 2 / 90, 6)
        self.assertEqual(scan["time_increment"], 0)  # all beams are of one instant
        self.assertAlmostEqual(scan["scan_time"], 0.1, 6)
        self.assertAlmostEqual(scan["range_min"], 0.1, 6)
        self.assertAlmostEqual(scan["range_max"], 2.5, 6)
        self.assertEqual(len(scan["ranges"]), 91)
        for i, measured in enumerate(scan["ranges"]):
            expected = 1.9 / math.cos(-math.pi / 4 + i * math.pi / 2 / 90)
            if expected < 2.5:
                self.assertAlmostEqual(measured, expected, 4)
            else:
                self.assertEqual(measured, "inf")

    def check_imu(self, imu):
        self.assertEqual(imu["header"]["frame_id"], "arm/base_link")
        self.assertAlmostEqual(imu["orientation"]["w"], 1)
        self.assertEqual(imu["angular_velocity"], {"x": 0, "y": 0, "z": 0})
        self.assertAlmostEqual(imu["linear_acceleration"]["z"], 9.8)
        self.assertAlmostEqual(imu["linear_acceleration"]["x"], 0)
        for covariance in ("orientation", "angular_velocity", "linear_acceleration"):
            self.assertEqual(len(imu[f"{covariance}_covariance"]), 9)

    def check_range(self, sonar):
        self.assertEqual(sonar["header"]["frame_id"], "arm/sonar")
        self.assertEqual(sonar["radiation_type"], 0)  # ULTRASOUND
        self.assertAlmostEqual(sonar["field_of_view"], 2 * math.atan(0.4 / 3), 6)
        self.assertAlmostEqual(sonar["min_range"], 0.02, 6)
        self.assertAlmostEqual(sonar["max_range"], 3, 6)
        self.assertAlmostEqual(sonar["range"], 1.8, 3)

    def check_image(self, image):
        self.assertEqual(image["header"]["frame_id"], "arm/camera/optical")
        self.assertEqual((image["height"], image["width"], image["encoding"], image["is_bigendian"], image["step"]),
                         (48, 64, "rgb8", 0, 192))
        self.assertEqual(image["data"]["bytes"], 48 * 192)

    def check_camera_info(self, info):
        focal = 32 / math.tan(0.6)  # pixels
        k = [focal, 0, 32, 0, focal, 24, 0, 0, 1]
        p = [focal, 0, 32, 0, 0, focal, 24, 0, 0, 0, 1, 0]
        self.assertEqual(info["header"]["frame_id"], "arm/camera/optical")
        self.assertEqual((info["height"], info["width"], info["distortion_model"]), (48, 64, "plumb_bob"))
        for found, expected in zip(info["k"] + info["p"] + info["r"], k + p + [1, 0, 0, 0, 1, 0, 0, 0, 1]):
            self.assertAlmostEqual(found, expected, 9)
        self.assertEqual(info["d"], [0] * 5)
        self.assertEqual((info["binning"], info["roi"], info["do_rectify"]), ([0, 0], [0, 0, 0, 0], False))

    def check_joints(self, joints):
        self.assertEqual(joints["name"], ["lift_joint"])
        self.assertEqual(joints["position"], [0])
        self.assertEqual(joints["velocity"], [0])

    def check_odometry(self, odometry):
        self.assertEqual((odometry["header"]["frame_id"], odometry["child_frame_id"]), ("arm/odom", "arm/base_link"))
        self.assertEqual(odometry["pose"]["pose"]["position"], {"x": 0, "y": 0, "z": 0})
        self.assertEqual(odometry["twist"]["twist"]["linear"], {"x": 0, "y": 0, "z": 0})

    def test_ignores_malformed_samples(self):
        with running_gsv() as gsv:
            done = subprocess.run([PEER, "malformed", "/arm", "--domain", DOMAIN, "--timeout", "40"],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            position = listen("nav_msgs/msg/Odometry:/arm/odom")["/arm/odom"]["pose"]["pose"]["position"]
            self.assertEqual(position, {"x": 0, "y": 0, "z": 0})
            self.assertIsNone(gsv.poll())
        for topic in ("/gsv/get_entity_state", "/gsv/set_parameters"):
            self.assertEqual(gsv.log.count(f"a request of ROS 2 to {topic} is ignored"), 1, gsv.log)
        self.assertEqual(gsv.log.count("from ROS 2 is refused"), 1, gsv.log)  # the first of the robot


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
