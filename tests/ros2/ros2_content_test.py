#!/usr/bin/env python3
"""Compares messages of a robot's sensors, which another DDS decodes, with values in closed form.

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
from xml.etree import ElementTree

from domains import take_domain

GSV, PEER = sys.argv[1:3]
os.environ.setdefault("ASAN_OPTIONS", "new_delete_type_mismatch=0")
DOMAIN = str(take_domain())

WORLD = """<sdf version="1.9"><world name="room"><gravity>0 0 -9.8</gravity>
<physics type="ode"><max_step_size>0.01</max_step_size></physics>
<scene><background>0 0 1 1</background><sky/></scene>
<magnetic_field>2e-05 0 -4e-05</magnetic_field>
<spherical_coordinates><surface_model>EARTH_WGS84</surface_model><latitude_deg>50</latitude_deg>
<longitude_deg>8</longitude_deg><elevation>100</elevation><heading_deg>0</heading_deg></spherical_coordinates>
<model name="ground"><static>true</static><link name="link"><collision name="plane"><geometry>
<plane><normal>0 0 1</normal></plane></geometry></collision></link></model>
<model name="wall"><static>true</static><pose>2.5 0 1 0 0 0</pose><link name="link"><collision name="box"><geometry>
<box><size>1 20 2</size></box></geometry></collision><visual name="box"><geometry><box><size>1 20 2</size></box></geometry>
</visual></link></model></world></sdf>
"""
ROBOT = """<sdf version="1.11"><model name="arm"><link name="base_link">
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
<link name="shade"><pose>0 0 0.6 0 0 0</pose></link>
<joint name="shade_joint" type="prismatic"><parent>base_link</parent><child>shade</child><axis><xyz>0 0 1</xyz>
<mimic joint="lift_joint"><multiplier>-2</multiplier></mimic></axis></joint>
<plugin filename="gz-sim-velocity-control-system" name="gz::sim::systems::VelocityControl"/></model></sdf>
"""
# A box of 2 kg that carries a mast of 0.5 kg. It rests on the ground, by rigid-body dynamics, and
# has no drive.
PROBE = """<sdf version="1.9"><model name="probe"><link name="base_link">
<inertial><pose>0 0 0.1 0 0 0</pose><mass>2</mass><inertia><ixx>0.03</ixx><iyy>0.03</iyy><izz>0.05</izz></inertia></inertial>
<collision name="body"><pose>0 0 0.1 0 0 0</pose><geometry><box><size>0.4 0.4 0.2</size></box></geometry></collision>
<sensor name="rows" type="gpu_lidar"><pose>0 0 1 0 0 0</pose><update_rate>10</update_rate><lidar><scan><horizontal>
<samples>11</samples><min_angle>-0.5</min_angle><max_angle>0.5</max_angle></horizontal><vertical><samples>3</samples>
<min_angle>-0.1</min_angle><max_angle>0.1</max_angle></vertical></scan><range><min>0.1</min><max>10</max></range></lidar>
</sensor>
<sensor name="depth" type="depth_camera"><pose>0.5 0 1 0 0 0</pose><update_rate>10</update_rate><camera>
<horizontal_fov>0.6</horizontal_fov><image><width>32</width><height>24</height><format>R_FLOAT32</format></image>
<clip><near>0.1</near><far>10</far></clip></camera></sensor>
<sensor name="eye" type="camera"><pose>0 0 1 0 0 0</pose><update_rate>10</update_rate><camera>
<horizontal_fov>0.6</horizontal_fov><image><width>32</width><height>24</height></image>
<clip><near>0.1</near><far>10</far></clip></camera></sensor>
<sensor name="navsat" type="navsat"><update_rate>10</update_rate></sensor>
<sensor name="compass" type="magnetometer"><update_rate>10</update_rate></sensor>
<sensor name="battery" type="battery"/>
<sensor name="bumper" type="contact"><update_rate>10</update_rate><contact><collision>body</collision></contact></sensor>
<sensor name="beacon" type="positioning"/>
</link>
<link name="mast"><pose>0 0 0.2 0 0 0</pose><inertial><pose>0.1 0 0.1 0 0 0</pose><mass>0.5</mass>
<inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial></link>
<joint name="mount" type="fixed"><parent>base_link</parent><child>mast</child>
<sensor name="load" type="force_torque"><update_rate>50</update_rate></sensor></joint></model></sdf>
"""


@contextlib.contextmanager
def running_gsv(robot="arm", *options):
    with tempfile.TemporaryDirectory() as folder:
        pathlib.Path(folder, "room.sdf").write_text(WORLD, encoding="ascii")
        pathlib.Path(folder, "arm.sdf").write_text(ROBOT, encoding="ascii")
        pathlib.Path(folder, "probe.sdf").write_text(PROBE, encoding="ascii")
        gsv = subprocess.Popen([GSV, "run", f"{folder}/room.sdf", "--robot", f"{folder}/{robot}.sdf@0,0", "--ros2",
                                "--headless", *options],
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

    def test_rarer_sensors_have_their_values_in_closed_form(self):
        with running_gsv("probe", "--movement", "probe=rigid"):
            messages = listen(
                "sensor_msgs/msg/PointCloud2:/probe/points", "sensor_msgs/msg/Image:/probe/depth/image_raw",
                "sensor_msgs/msg/PointCloud2:/probe/depth/points", "sensor_msgs/msg/CameraInfo:/probe/depth/camera_info",
                "sensor_msgs/msg/CompressedImage:/probe/camera/image_raw/compressed",
                "sensor_msgs/msg/NavSatFix:/probe/fix", "sensor_msgs/msg/MagneticField:/probe/magnetic_field",
                "sensor_msgs/msg/BatteryState:/probe/battery_state", "gsv_msgs/msg/Bumper:/probe/contacts",
                "geometry_msgs/msg/WrenchStamped:/probe/wrench", "geometry_msgs/msg/PoseStamped:/probe/pose",
                "geometry_msgs/msg/PoseStamped:/probe/ground_truth/pose", "std_msgs/msg/String:/probe/robot_description",
                "diagnostic_msgs/msg/DiagnosticArray:/diagnostics", "rcl_interfaces/msg/Log:/rosout")
        self.check_points(messages["/probe/points"])
        self.check_depth(messages["/probe/depth/image_raw"], messages["/probe/depth/points"],
                         messages["/probe/depth/camera_info"])
        self.check_compressed(messages["/probe/camera/image_raw/compressed"])
        self.check_fix(messages["/probe/fix"])
        self.check_magnetic_field(messages["/probe/magnetic_field"])
        self.check_battery(messages["/probe/battery_state"])
        self.check_contacts(messages["/probe/contacts"])
        self.check_wrench(messages["/probe/wrench"])
        for topic in ("/probe/pose", "/probe/ground_truth/pose"):
            self.check_pose(messages[topic])
        self.check_description(messages["/probe/robot_description"]["data"])
        self.check_diagnostics(messages["/diagnostics"]["status"])
        self.check_log(messages["/rosout"])

    def check_points(self, cloud):
        self.assertEqual(cloud["header"]["frame_id"], "probe/rows")
        self.assertEqual((cloud["height"], cloud["width"], cloud["is_bigendian"], cloud["point_step"], cloud["row_step"],
                          cloud["data"]["bytes"], cloud["is_dense"]), (3, 11, False, 16, 176, 528, False))
        self.assertEqual(cloud["fields"], [["x", 0, 7, 1], ["y", 4, 7, 1], ["z", 8, 7, 1], ["ring", 12, 4, 1]])
        for i, (x, y, z) in enumerate(cloud["points"]):
            row, column = divmod(i, 11)
            azimuth, elevation = 0.1 * column - 0.5, 0.1 * row - 0.1
            self.assertAlmostEqual(x, 2, 4)
            self.assertAlmostEqual(y, 2 * math.tan(azimuth), 4)
            self.assertAlmostEqual(z, 2 / math.cos(azimuth) * math.tan(elevation), 4)

    def check_depth(self, image, cloud, info):
        self.assertEqual(image["header"]["frame_id"], "probe/depth/optical")
        self.assertEqual((image["height"], image["width"], image["encoding"], image["is_bigendian"], image["step"],
                          image["data"]["bytes"]), (24, 32, "32FC1", 0, 128, 24 * 128))
        self.assertAlmostEqual(image["centre"], 1.5, 3)
        focal = 16 / math.tan(0.3)  # pixels
        self.assertEqual(info["header"]["frame_id"], "probe/depth/optical")
        for found, expected in zip(info["k"], [focal, 0, 16, 0, focal, 12, 0, 0, 1]):
            self.assertAlmostEqual(found, expected, 9)
        self.assertEqual(cloud["header"]["frame_id"], "probe/depth")
        self.assertEqual((cloud["height"], cloud["width"], cloud["point_step"], cloud["row_step"]), (24, 32, 12, 384))
        for row, column in ((12, 16), (10, 5), (14, 30)):
            x, y, z = cloud["points"][32 * row + column]
            self.assertAlmostEqual(x, 1.5, 3)
            self.assertAlmostEqual(y, -1.5 * (column + 0.5 - 16) / focal, 3)
            self.assertAlmostEqual(z, -1.5 * (row + 0.5 - 12) / focal, 3)

    def check_compressed(self, image):
        self.assertEqual((image["header"]["frame_id"], image["format"]), ("probe/eye/optical", "jpeg"))
        self.assertEqual(image["first"], [0xff, 0xd8, 0xff])  # ITU-T T.81, B.1.1.3

    def check_fix(self, fix):
        self.assertEqual((fix["header"]["frame_id"], fix["status"], fix["service"]), ("probe/base_link", 0, 1))
        self.assertAlmostEqual(fix["latitude"], 50, 9)
        self.assertAlmostEqual(fix["longitude"], 8, 9)
        self.assertAlmostEqual(fix["altitude"], 100, 3)
        self.assertEqual((fix["position_covariance"], fix["position_covariance_type"]), ([0] * 9, 2))

    def check_magnetic_field(self, message):
        self.assertEqual(message["header"]["frame_id"], "probe/base_link")
        for axis, expected in {"x": 2e-5, "y": 0, "z": -4e-5}.items():
            self.assertAlmostEqual(message["magnetic_field"][axis], expected, 9)

    def check_battery(self, battery):
        stamp = battery["header"]["stamp"]
        fraction = 1 - 0.5 * (stamp["sec"] + stamp["nanosec"] / 1e9) / 3600 / 5  # 0.5 A of 5 Ah
        self.assertAlmostEqual(battery["voltage"], 10.5 + 2.1 * fraction - 0.1 * 0.5, 4)
        self.assertAlmostEqual(battery["current"], -0.5, 6)
        self.assertAlmostEqual(battery["charge"], 5 * fraction, 5)
        self.assertAlmostEqual(battery["percentage"], fraction, 5)
        self.assertEqual((battery["capacity"], battery["design_capacity"], battery["present"]), (5, 5, True))
        self.assertEqual(battery["power_supply_status"], 2)  # DISCHARGING
        self.assertEqual(battery["temperature"], "nan")  # not measured

    def check_contacts(self, bumper):
        self.assertEqual(bumper["header"]["frame_id"], "probe/base_link")
        self.assertEqual({contact["other"] for contact in bumper["contacts"]}, {"ground"})
        self.assertAlmostEqual(sum(contact["force"]["z"] for contact in bumper["contacts"]), 2.5 * 9.8, 1)
        for contact in bumper["contacts"]:
            self.assertAlmostEqual(contact["normal"]["z"], -1, 6)
            self.assertAlmostEqual(abs(contact["point"]["x"]), 0.2, 3)

    def check_wrench(self, message):
        """Checks the wrench that the mast exerts on the box, about the joint."""
        self.assertEqual(message["header"]["frame_id"], "probe/mast")
        self.assertAlmostEqual(message["force"]["z"], -0.5 * 9.8, 2)
        self.assertAlmostEqual(message["torque"]["y"], 0.1 * 0.5 * 9.8, 2)

    def check_pose(self, message):
        self.assertEqual(message["header"]["frame_id"], "world")
        for axis in "xyz":
            self.assertAlmostEqual(message["pose"]["position"][axis], 0, 3)
        self.assertAlmostEqual(message["pose"]["orientation"]["w"], 1, 6)

    def check_description(self, text):
        robot = ElementTree.fromstring(text)
        self.assertEqual([link.get("name") for link in robot.iter("link")], ["base_link", "mast"])
        masses = [float(mass.get("value")) for mass in robot.iter("mass")]
        self.assertEqual(masses, [2, 0.5])
        self.assertEqual([(joint.get("name"), joint.get("type")) for joint in robot.findall("joint")], [("mount", "fixed")])

    def check_diagnostics(self, all_status):
        simulation, robot = all_status
        self.assertEqual((simulation["name"], simulation["values"]["mode"]), ("simulation", "real_time"))
        self.assertEqual((robot["name"], robot["level"], robot["values"]["collisions"]), ("probe", 0, "0"))

    def check_log(self, message):
        self.assertEqual((message["name"], message["msg"], message["level"]), ("gsv", "started", 20))

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
        self.assertEqual(joints["name"], ["lift_joint", "shade_joint"])
        self.assertEqual(joints["position"], [0, 0])
        self.assertEqual(joints["velocity"], [0, 0])

    def check_odometry(self, odometry):
        self.assertEqual((odometry["header"]["frame_id"], odometry["child_frame_id"]), ("arm/odom", "arm/base_link"))
        self.assertEqual(odometry["pose"]["pose"]["position"], {"x": 0, "y": 0, "z": 0})
        self.assertEqual(odometry["twist"]["twist"]["linear"], {"x": 0, "y": 0, "z": 0})

    # The array has a number for the lift, and none for the shade, which follows the lift.
    def test_moves_a_joint_by_arrays_of_numbers(self):
        for field, value in (("position", "0.25"), ("velocity", "0.05")):
            with running_gsv() as gsv:
                done = subprocess.run([PEER, "joint", "/arm", field, value, "--domain", DOMAIN, "--timeout", "40"],
                                      capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                result = json.loads(done.stdout)
                self.assertAlmostEqual(result["value"], float(value), 6)
                self.assertFalse(result["moved_by_bad"])
            # Only the robot's first refusal is logged.
            self.assertEqual(gsv.log.count("from ROS 2 is refused"), 1, gsv.log)

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
        # Only the robot's first refusal is logged.
        self.assertEqual(gsv.log.count("from ROS 2 is refused"), 1, gsv.log)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
