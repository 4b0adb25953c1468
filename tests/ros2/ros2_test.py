#!/usr/bin/env python3
"""Runs `gsv run --ros2` and checks with a peer on another DDS what it publishes and accepts.

  ros2_test.py GSV ROS2_PEER

Every field that the peer prints was decoded by Cyclone DDS with types generated from IDL. Traffic is
captured and dissected by tshark. If tshark is not installed or may not capture, that test is skipped.
"""
import contextlib
import json
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import unittest
from xml.etree import ElementTree

from domains import take_domain

GSV, PEER = sys.argv[1:3]
# Fast DDS 2.9 deletes objects through a type of another size. Without this option, AddressSanitizer
# would end the program because of that.
os.environ.setdefault("ASAN_OPTIONS", "new_delete_type_mismatch=0")
DOMAIN = take_domain()
PUBLISHED = {  # type hashes that ROS 2's packages contain
    "sensor_msgs::msg::dds_::LaserScan_":
        "RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828",
    "geometry_msgs::msg::dds_::Twist_":
        "RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a",
}


def peer(*words, timeout=40):
    done = subprocess.run([PEER, *words, "--domain", str(DOMAIN), "--timeout", str(timeout)],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"ros2_peer {' '.join(words)}: {done.stderr or done.stdout}")
    return [json.loads(line) for line in done.stdout.splitlines()]


@contextlib.contextmanager
def running_gsv(*options):
    """Runs gsv with ROS 2 in real time until the block ends."""
    environment = {**os.environ, "ROS_DOMAIN_ID": str(DOMAIN)}
    gsv = subprocess.Popen([GSV, "run", "office", "--robot", "pebble", "--ros2", "--headless", *options],
                           env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    try:
        yield gsv
    finally:
        gsv.terminate()
        gsv.log = gsv.communicate(timeout=30)[1]


@contextlib.contextmanager
def listening(topic):
    """Keeps a subscription until the block ends."""
    reader = subprocess.Popen([PEER, "listen", topic, "--domain", str(DOMAIN)],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield
    finally:
        reader.terminate()
        reader.wait(timeout=30)


@contextlib.contextmanager
def captured(*fields):
    """Yields a list. At the end of the block, it has these fields of each RTPS packet on this domain's ports."""
    first = 7400 + 250 * DOMAIN
    last = first + 249
    tshark = subprocess.Popen(
        ["tshark", "-l", "-i", "any", "-f", f"udp portrange {first}-{last}", "-Y", f"rtps || udp.dstport == {last}",
         "-T", "fields", "-e", "udp.dstport", *(f"-e{field}" for field in fields)],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        if not any("Capture started" in line for line in tshark.stderr):
            raise unittest.SkipTest("tshark has no permission to capture")
        rows = []
        yield rows
        # The kernel delivers captured packets in blocks, with a delay. This packet comes after all
        # others, so it marks the end.
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            sender.sendto(b"end", ("127.0.0.1", last))
        for line in tshark.stdout:
            port, *row = line.rstrip("\n").split("\t")
            if port == str(last):
                break
            rows.append(row)
        else:
            raise AssertionError("tshark ended before the last packet")
    finally:
        tshark.terminate()
        tshark.communicate(timeout=30)


class ForeignPeer(unittest.TestCase):
    def test_reads_topics_field_by_field(self):
        with running_gsv():
            samples = peer("listen", "--count", "2", "rosgraph_msgs/msg/Clock:/clock",
                           "nav_msgs/msg/Odometry:/pebble/odom", "tf2_msgs/msg/TFMessage:/tf",
                           "tf2_msgs/msg/TFMessage:/tf_static")
        by_topic = {}
        for sample in samples:
            by_topic.setdefault(sample["topic"], []).append(sample["message"])
        first, second = (m["clock"]["sec"] * 10**9 + m["clock"]["nanosec"] for m in by_topic["/clock"])
        self.assertLess(first, second)
        odometry = by_topic["/pebble/odom"][0]
        self.assertEqual(odometry["header"]["frame_id"], "pebble/odom")
        q = odometry["pose"]["pose"]["orientation"]
        self.assertAlmostEqual(sum(value * value for value in q.values()), 1, places=6)
        self.assertEqual(len(odometry["pose"]["covariance"]), 36)
        frames = {t["child_frame_id"] for t in by_topic["/tf"][0]["transforms"]}
        self.assertIn(odometry["child_frame_id"], frames)

    def test_is_found_by_a_peer_that_waits_for_multicast(self):
        topic = "nav_msgs/msg/Odometry:/pebble/odom"
        script = f"""
            ip link set lo up && ip link add here type veth peer name there &&
            ip addr add 192.0.2.1/24 dev here && ip link set here up && ip link set there up || exit 77
            "$1" run office --robot pebble --ros2 --headless >/dev/null &
            "$2" listen --multicast --domain {DOMAIN} --timeout 40 {topic}
            found=$?; kill $!; wait $!; exit $found"""
        done = subprocess.run(["unshare", "--map-root-user", "--net", "sh", "-c", script, "sh", GSV, PEER],
                              env={**os.environ, "ROS_DOMAIN_ID": str(DOMAIN)},
                              capture_output=True, text=True, check=False)
        if done.returncode == 77 or "unshare failed" in done.stderr:
            self.skipTest("a network of its own is not permitted here")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("pebble/odom", done.stdout)

    def test_drives_a_robot_a_metre(self):
        with running_gsv("--behaviour", "ros2"):
            result = peer("drive", "--distance", "1", "/pebble")[0]
        self.assertGreaterEqual(result["distance"], 1)

    def test_a_replay_publishes_the_recorded_topics(self):
        with tempfile.TemporaryDirectory() as folder:
            recording = os.path.join(folder, "run.mcap")
            subprocess.run([GSV, "run", "office", "--robot", "pebble@1,1", "--lockstep", "--duration", "30",
                            "--headless", "--record", recording], check=True, capture_output=True)
            gsv = subprocess.Popen([GSV, "replay", recording, "--ros2", "--port", "0"],
                                   env={**os.environ, "ROS_DOMAIN_ID": str(DOMAIN)},
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            try:
                samples = peer("listen", "--count", "2", "rosgraph_msgs/msg/Clock:/clock",
                               "tf2_msgs/msg/TFMessage:/tf", "sensor_msgs/msg/Range:/pebble/sonar_00")
            finally:
                gsv.terminate()
                log = gsv.communicate(timeout=30)[1]
        self.assertEqual(log, "")
        by_topic = {}
        for sample in samples:
            by_topic.setdefault(sample["topic"], []).append(sample["message"])
        self.assertIn("pebble/base_link", [t["child_frame_id"] for t in by_topic["/tf"][0]["transforms"]])
        first, second = (m["header"]["stamp"] for m in by_topic["/pebble/sonar_00"])
        self.assertLess((first["sec"], first["nanosec"]), (second["sec"], second["nanosec"]))
        self.assertEqual(by_topic["/pebble/sonar_00"][0]["header"]["frame_id"], "pebble/sonar_00")

    def step(self, speed):
        """Runs a robot in lockstep: each step waits for a ROS 2 node. Returns the report of the run."""
        gsv = subprocess.Popen(
            [GSV, "run", "office", "--robot", "pebble@0,0", "--behaviour", "ros2", "--ros2", "--ros2-cmd-vel",
             "twist_stamped", "--lockstep", "--duration", "1", "--headless", "--json"],
            env={**os.environ, "ROS_DOMAIN_ID": str(DOMAIN)},
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        node = subprocess.Popen([PEER, "step", "/pebble", "--speed", str(speed), "--seconds", "0.99", "--domain",
                                 str(DOMAIN), "--timeout", "40"], stdout=subprocess.DEVNULL)
        report = json.loads(gsv.communicate(timeout=60)[0])
        node.terminate()
        node.wait(timeout=30)
        return report

    def test_a_node_steps_a_robot_in_lockstep_reproducibly(self):
        first, second, faster = self.step(0.2), self.step(0.2), self.step(0.3)
        self.assertEqual(first["state_hash"], second["state_hash"])
        self.assertNotEqual(first["state_hash"], faster["state_hash"])
        distance = first["robots"][0]["distance_m"]
        self.assertGreater(distance, 0.15)  # 0.2 m/s for 1 s, less the time to accelerate
        self.assertLess(distance, 0.2 + 1e-9)

    def test_a_step_waits_for_its_node_until_the_deadline(self):
        done = subprocess.run(
            [GSV, "run", "office", "--robot", "pebble", "--behaviour", "ros2", "--ros2", "--ros2-cmd-vel",
             "twist_stamped", "--lockstep", "--duration", "0.1", "--deadline", "0.5", "--headless"],
            env={**os.environ, "ROS_DOMAIN_ID": str(DOMAIN)}, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 4, done.stdout + done.stderr)
        self.assertIn("unresponsive", done.stdout + done.stderr)

    def test_reports_bad_commands_once_and_keeps_driving(self):
        with running_gsv() as gsv:
            result = peer("disturb", "/pebble")[0]
        self.assertTrue(result["finite"])
        for sentence in ["the velocities must be finite, found NaN or infinity",
                         "2 ROS 2 publishers on /pebble/cmd_vel command pebble. The latest command counts",
                         "a ROS 2 node publishes std_msgs/msg/String on /pebble/cmd_vel, but pebble takes "
                         "geometry_msgs/msg/Twist"]:
            self.assertEqual(gsv.log.count(sentence), 1, gsv.log)
        self.assertEqual(gsv.returncode, 130, gsv.log)  # ended by SIGINT, and not by an error

    def test_refuses_a_domain_out_of_range(self):
        done = subprocess.run([GSV, "run", "office", "--robot", "pebble", "--ros2", "--headless"],
                              env={**os.environ, "ROS_DOMAIN_ID": "233"},
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("ROS_DOMAIN_ID: must be a number from 0 to 232, found '233'", done.stderr)

    def topics_alone(self, script="", domain=DOMAIN):
        """Runs a shell script and then `gsv ros2 topics`, both in a new network namespace."""
        done = subprocess.run(["unshare", "--map-root-user", "--net", "sh", "-c",
                               f'{script}\nexec "$1" ros2 topics --seconds 0.5', "sh", GSV],
                              env={**os.environ, "ROS_DOMAIN_ID": str(domain)},
                              capture_output=True, text=True, check=False)
        if done.returncode == 77 or "unshare failed" in done.stderr:
            self.skipTest("a network of its own is not permitted here")
        return done

    def test_refuses_a_domain_whose_ports_are_taken(self):
        domain = take_domain()
        with contextlib.ExitStack() as stack:
            for port in range(7400 + 250 * domain + 10, 7400 + 250 * (domain + 1)):
                taken = stack.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
                with contextlib.suppress(OSError):  # another process uses the port
                    taken.bind(("127.0.0.1", port))
            done = subprocess.run([GSV, "run", "office", "--robot", "pebble", "--ros2", "--headless"],
                                  env={**os.environ, "ROS_DOMAIN_ID": str(domain)},
                                  capture_output=True, text=True, check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn(f"all UDP ports of ROS 2 domain {domain} are in use. Choose another domain with ROS_DOMAIN_ID",
                      done.stderr)

    def test_refuses_to_start_while_loopback_is_down(self):
        done = self.topics_alone()
        self.assertNotEqual(done.returncode, 0, done.stdout)
        self.assertIn("the loopback interface lo is down, and ROS 2 uses it. Run `ip link set lo up`", done.stderr)

    def test_warns_of_missing_multicast_on_loopback_and_runs(self):
        done = self.topics_alone("ip link set lo up && sysctl -q -w net.ipv4.igmp_max_memberships=0 || exit 77")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("this machine has no multicast on loopback", done.stderr)

    def test_leaves_alone_what_others_left_in_shared_memory(self):
        port = 7410 + 250 * DOMAIN
        left = [f"/dev/shm/fastrtps_port{port}", f"/dev/shm/sem.fastrtps_port{port}_mutex"]
        for path in left:
            with open(path, "wb") as file:
                file.write(b"\xff" * 4096)
        before = set(os.listdir("/dev/shm"))
        try:
            with running_gsv("--behaviour", "ros2"):
                self.assertGreaterEqual(peer("drive", "--distance", "0.1", "/pebble")[0]["distance"], 0.1)
                made = {name for name in set(os.listdir("/dev/shm")) - before if "fastrtps" in name}
            self.assertEqual(made, set())
        finally:
            for path in left:
                os.remove(path)

    def test_doctor_finds_why_a_subscription_gets_nothing(self):
        with running_gsv(), listening("sensor_msgs/msg/Image:/pebble/odom"):
            peer("endpoints", "rt/pebble/odom")
            done = subprocess.run([GSV, "ros2", "doctor", "--seconds", "4"],
                                  env={**os.environ, "ROS_DOMAIN_ID": str(DOMAIN)},
                                  capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 5, done.stdout)
        self.assertIn(f"domain {DOMAIN}, this machine only", done.stdout)
        self.assertIn("problem: /pebble/odom: a publisher has type nav_msgs/msg/Odometry, a subscription "
                      "sensor_msgs/msg/Image", done.stdout)

    def test_is_listed_with_its_sockets_in_the_highest_domain_too(self):
        for domain in (DOMAIN, 232):
            with subprocess.Popen([GSV, "run", "office", "--robot", "pebble", "--ros2", "--headless"],
                                  env={**os.environ, "ROS_DOMAIN_ID": str(domain)}, stdout=subprocess.PIPE,
                                  stderr=subprocess.DEVNULL, text=True) as gsv:
                while not gsv.stdout.readline().startswith("ros2: "):
                    self.assertIsNone(gsv.poll())
                done = subprocess.run([GSV, "doctor", "--security", "--json"], capture_output=True, text=True,
                                      check=False)
                gsv.terminate()
            programs = {program["pid"]: program for program in map(json.loads, done.stdout.splitlines())}
            sockets = [each for each in programs[gsv.pid]["sockets"] if each["speaks"] == "ROS 2, UDP"]
            self.assertEqual(len(sockets), 2, domain)
            self.assertEqual([(each["local"], each["complaint"]) for each in sockets], [(True, "")] * 2)

    def test_describes_the_robot_as_urdf(self):
        with running_gsv():
            samples = peer("listen", "std_msgs/msg/String:/pebble/robot_description",
                           "tf2_msgs/msg/TFMessage:/tf_static", "tf2_msgs/msg/TFMessage:/tf")
        by_topic = {sample["topic"]: sample["message"] for sample in samples}
        robot = ElementTree.fromstring(by_topic["/pebble/robot_description"]["data"])
        self.assertEqual(robot.tag, "robot")
        links = {"pebble/" + link.get("name") for link in robot.iter("link")}
        frames = {t["child_frame_id"] for topic in ("/tf_static", "/tf") for t in by_topic[topic]["transforms"]}
        self.assertLessEqual(links, frames)
        for mesh in robot.iter("mesh"):
            self.assertTrue(mesh.get("filename").startswith("file:///"), mesh.get("filename"))

    def test_sees_types_and_their_published_hashes(self):
        with running_gsv():
            found = {e["topic"]: e for e in peer("endpoints", "rt/clock", "rt/pebble/cmd_vel")}
        self.assertEqual(found["rt/clock"]["type"], "rosgraph_msgs::msg::dds_::Clock_")
        self.assertTrue(found["rt/clock"]["reliable"])
        for endpoint in found.values():
            if published := PUBLISHED.get(endpoint["type"]):
                self.assertEqual(endpoint.get("user_data"), f"typehash={published};", endpoint)

    @unittest.skipUnless(shutil.which("tshark"), "tshark is not installed")
    def test_traffic_names_topics_types_and_qos_and_stays_on_this_machine(self):
        best_effort, reliable = "0x00000001", "0x00000002"
        fields = ["ip.src", "ip.dst", "rtps.param.topicName", "rtps.param.typeName", "rtps.reliability_kind"]
        with captured(*fields) as rows, running_gsv():
            peer("listen", "nav_msgs/msg/Odometry:/pebble/odom")
        # Linux sends no packet with a loopback source address to another machine.
        self.assertEqual({row[0] for row in rows}, {"127.0.0.1"})
        self.assertLessEqual({row[1] for row in rows}, {"127.0.0.1", "239.255.0.1"})
        # One packet may announce several endpoints: tshark then separates their values by commas.
        announced = {endpoint for row in rows
                     for endpoint in zip(*(column.split(",") for column in row[2:]))}
        for expected in [("rt/clock", "rosgraph_msgs::msg::dds_::Clock_", reliable),
                         ("rt/tf", "tf2_msgs::msg::dds_::TFMessage_", reliable),
                         ("rt/pebble/odom", "nav_msgs::msg::dds_::Odometry_", reliable),
                         ("rt/pebble/cmd_vel", "geometry_msgs::msg::dds_::Twist_", reliable),
                         ("rt/pebble/camera/image_raw", "sensor_msgs::msg::dds_::Image_", best_effort)]:
            self.assertIn(expected, announced)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[3:]])
