#!/usr/bin/env python3
"""Calls the services of `gsv run --ros2` by clients of both conventions.

  ros2_services_test.py GSV ROS2_PEER ROS2_FAST_CLIENT PLUGIN_FOLDER

ROS2_PEER is on Cyclone DDS, with types generated from IDL, and calls as rmw_cyclonedds does. ROS2_FAST_CLIENT calls as
rmw_fastrtps does. The numbers of results are those of simulation_interfaces.
"""
import contextlib
import json
import os
import subprocess
import sys
import unittest

GSV, PEER, FAST_CLIENT, PLUGINS = sys.argv[1:5]
os.environ.setdefault("ASAN_OPTIONS", "new_delete_type_mismatch=0")
DOMAIN = str(100 + os.getpid() % 40)  # apart from others on this machine
CALLS = "3400"  # of each client: 10,200 in all
UNSUPPORTED, OK, NOT_FOUND, INCORRECT_STATE, FAILED = range(5)
STOPPED, PLAYING, PAUSED, QUITTING = range(4)
SUCCEEDED, CANCELED, ABORTED = 4, 5, 6  # of action_msgs/msg/GoalStatus


class Client:
    """The peer, which answers each line."""

    def __init__(self):
        self.peer = subprocess.Popen([PEER, "call", "--domain", DOMAIN, "--timeout", "60"],
                                     stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def call(self, line):
        self.peer.stdin.write(line + "\n")
        self.peer.stdin.flush()
        reply = self.peer.stdout.readline()
        if not reply:
            raise AssertionError(f"no reply to {line}")
        return json.loads(reply)

    def lines(self, line, count):
        first = self.call(line)
        return [first, *(json.loads(self.peer.stdout.readline()) for _ in range(count - 1))]

    def await_state(self, state):
        while self.call("get_simulation_state")["state"] != state:
            pass

    def close(self):
        self.peer.stdin.close()
        self.peer.wait(timeout=30)
        self.peer.stdout.close()


@contextlib.contextmanager
def running_gsv(*options):
    gsv = subprocess.Popen([GSV, "run", "office", "--robot", "pebble@1,1", "--ros2", "--headless", *options],
                           env={**os.environ, "ROS_DOMAIN_ID": DOMAIN}, stdout=subprocess.DEVNULL,
                           stderr=subprocess.PIPE, text=True)
    client = Client()
    try:
        yield client
    finally:
        client.close()
        gsv.terminate()
        gsv.communicate(timeout=30)


class Services(unittest.TestCase):
    def test_read_entities(self):
        with running_gsv() as client:
            call = client.call
            self.assertEqual(call("get_entities ^pebble$"), {"result": {"result": OK, "error_message": ""},
                                                             "entities": ["pebble"]})
            self.assertEqual(call("get_entities (")["result"]["result"], FAILED)
            info = call("get_entity_info pebble")
            self.assertEqual((info["category"], info["description"]), (1, "model pebble"))
            self.assertEqual(call("get_entity_info pebbel")["result"],
                             {"result": NOT_FOUND, "error_message":
                              "pebbel: there is no entity of this name. Did you mean pebble?"})
            bounds = call("get_entity_bounds pebble")["bounds"]
            upper, lower = bounds["points"]
            self.assertEqual(bounds["type"], 1)
            for high, low in zip(upper, lower):
                self.assertGreater(high, low)
            state = call("get_entity_state pebble")["state"]
            self.assertEqual(state["frame_id"], "world")
            self.assertAlmostEqual(state["position"][0], 1)
            states = call("get_entities_states pebble")
            self.assertEqual(states["entities"], ["pebble"])
            self.assertEqual(states["states"], [state])
            self.assertEqual(call("get_current_world")["name"], "office")
            self.assertEqual(call("get_named_pose_bounds")["result"], UNSUPPORTED)
            worlds = call("get_available_worlds")
            self.assertEqual(worlds["result"]["result"], OK)
            self.assertLessEqual({"office", "maze"}, set(worlds["names"]))
            self.assertEqual(call("load_world office"),
                             {"result": UNSUPPORTED, "error_message": "a simulation keeps its world. Start "
                              "another one with gsv run WORLD --ros2"})

    def test_move_spawn_and_delete_while_it_runs(self):
        with running_gsv() as client:
            call = client.call
            client.await_state(PLAYING)
            self.assertEqual(call("set_entity_state pebble 1 2 0"), {"result": OK, "error_message": ""})
            position = call("get_entity_state pebble")["state"]["position"]
            self.assertAlmostEqual(position[0], 1)
            self.assertAlmostEqual(position[1], 2)
            self.assertEqual(call("set_entity_state pebble 3 2 0 1")["result"], UNSUPPORTED)
            self.assertEqual(call("get_simulation_state")["state"], PLAYING)
            self.assertIn("model://pebble", call("get_spawnables")["uris"])
            self.assertEqual(call("spawn_entity model://pebble second fleet/two 1 2.5 0")["entity_name"], "second")
            self.assertEqual(call("spawn_entity pebble second - 2 2.5 0")["result"]["result"], 101)  # NAME_NOT_UNIQUE
            self.assertEqual(call("spawn_entity pebbel - - 0 0 0")["result"]["result"], NOT_FOUND)
            self.assertEqual(call("spawn_entity pebble third no-name 2 2.5 0")["result"]["result"], 105)
            found = json.loads(subprocess.run(
                [PEER, "listen", "nav_msgs/msg/Odometry:/fleet/two/odom", "--domain", DOMAIN, "--timeout", "40"],
                capture_output=True, text=True, check=True).stdout)
            self.assertEqual(found["message"]["header"]["frame_id"], "fleet/two/odom")
            self.assertEqual(call("delete_entity second")["result"], OK)
            self.assertEqual(call("delete_entity second")["result"], NOT_FOUND)
            self.assertEqual(call("get_entities second|third")["entities"], [])

    def test_control_the_run(self):
        with running_gsv() as client:
            call = client.call
            client.await_state(PLAYING)
            self.assertEqual(call("step_simulation 1")["result"], INCORRECT_STATE)
            self.assertEqual(call(f"set_simulation_state {PLAYING}")["result"], 101)  # ALREADY_IN_TARGET_STATE
            self.assertEqual(call(f"set_simulation_state {PAUSED}")["result"], OK)
            client.await_state(PAUSED)
            self.assertEqual(call("step_simulation 5")["result"], OK)
            self.assertEqual(call("reset_simulation 1")["result"], UNSUPPORTED)
            self.assertEqual(call("reset_simulation 0")["result"], OK)
            client.await_state(PAUSED)

    def test_simulate_steps_with_feedback(self):
        with running_gsv() as client:
            call = client.call
            client.await_state(PLAYING)
            self.assertEqual(call("send_goal 1 3"), {"accepted": True})
            self.assertEqual(call("get_result 1")["status"], ABORTED)  # it was not paused
            call(f"set_simulation_state {PAUSED}")
            client.await_state(PAUSED)
            self.assertEqual(call("send_goal 2 3"), {"accepted": True})
            self.assertEqual(call("send_goal 2 3"), {"accepted": False})  # its id is known
            self.assertEqual(call("get_result 2"),
                             {"status": SUCCEEDED, "result": {"result": OK, "error_message": ""}})
            self.assertEqual(client.lines("feedback 3", 3),
                             [{"completed": 1, "remaining": 2}, {"completed": 2, "remaining": 1},
                              {"completed": 3, "remaining": 0}])
            self.assertEqual(call("send_goal 3 1000000000"), {"accepted": True})
            self.assertEqual(call("cancel_goal 3"), {"return_code": 0, "canceling": 1})
            self.assertEqual(call("get_result 3")["status"], CANCELED)
            self.assertEqual(call("cancel_goal 9")["return_code"], 2)  # unknown

    def test_tell_the_truth_about_features_and_time(self):
        with running_gsv() as client:
            features = client.call("get_simulator_features")["features"]
            self.assertEqual(features, [0, 1, 5, 6, 8, 10, 11, 12, 14, 20, 23, 24, 25, 26, 31, 32, 33, 44, 45])
            self.assertEqual(client.call("list_parameters"), ["use_sim_time"])
            self.assertEqual(client.call("get_parameters use_sim_time"), {"type": 1, "bool_value": True})
            self.assertEqual(client.call("get_parameters other"), {"type": 0, "bool_value": False})

    def test_lose_no_reply_to_clients_of_both_conventions_at_once(self):
        with running_gsv():
            environment = {**os.environ, "ROS_DOMAIN_ID": DOMAIN}
            commands = [[FAST_CLIENT, PLUGINS, "pebble", CALLS, "20"],
                        *[[PEER, "call-many", "pebble", "--count", CALLS, "--window", "20", "--domain", DOMAIN,
                           "--timeout", "60"]] * 2]
            clients = [subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True)
                       for command in commands]
            outputs = [client.communicate(timeout=100)[0] for client in clients]
        for output, client in zip(outputs, clients):
            self.assertEqual(json.loads(output), {"calls": int(CALLS), "replies": int(CALLS)}, client.args[0])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
