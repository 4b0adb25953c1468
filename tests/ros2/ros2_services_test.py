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
import tempfile
import unittest

from domains import take_domain

GSV, PEER, FAST_CLIENT, PLUGINS = sys.argv[1:5]
os.environ.setdefault("ASAN_OPTIONS", "new_delete_type_mismatch=0")
DOMAIN = str(take_domain())
EARLY_CALLS = 5  # number of starts of gsv, each with a call as soon as its services are found
CALLS = "3400"  # number of calls of each client; 10,200 in all
UNSUPPORTED, OK, NOT_FOUND, INCORRECT_STATE, FAILED = range(5)
STOPPED, PLAYING, PAUSED, QUITTING = range(4)
SUCCEEDED, CANCELED, ABORTED = 4, 5, 6  # values of action_msgs/msg/GoalStatus


class Client:
    """The peer process, which answers each input line."""

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
def client_of(*command):
    gsv = subprocess.Popen([GSV, *command, "--ros2"], env={**os.environ, "ROS_DOMAIN_ID": DOMAIN},
                           stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    client = Client()
    try:
        yield client
    finally:
        client.close()
        gsv.terminate()
        gsv.communicate(timeout=30)


def running_gsv(*options):
    return client_of("run", "office", "--robot", "pebble@1,1", "--headless", *options)


def serving_gsv():
    return client_of("serve", "--port", "0")


POSTS = """<sdf version="1.9"><world name="posts">
  <frame name="post"><pose>2 0 0 0 0 1.5707963267948966</pose></frame>
  <frame name="gate" attached_to="post"><pose relative_to="post">1 0 0 0 0 0</pose></frame>
</world></sdf>"""


def result_of(reply):
    """Returns the result number of a reply. Some services return it inside an object, which is also named "result"."""
    result = reply["result"]
    return result["result"] if isinstance(result, dict) else result


def works(*lines):
    return lambda call: all(result_of(call(line)) == OK for line in lines)


def gets(line, holds):
    def trial(call):
        reply = call(line)
        return result_of(reply) == OK and holds(reply)
    return trial


def sets_state(call):
    is_stopped = call("get_simulation_state")["state"] == STOPPED
    return result_of(call(f"set_simulation_state {PLAYING if is_stopped else STOPPED}")) == OK


def pauses(call):
    if call("get_simulation_state")["state"] != PLAYING:
        call(f"set_simulation_state {PLAYING}")
    done = result_of(call(f"set_simulation_state {PAUSED}")) == OK
    while done and call("get_simulation_state")["state"] != PAUSED:
        pass
    return done


def steps_by_action(call):
    return call("send_goal 7 2") == {"accepted": True} and call("get_result 7")["status"] == SUCCEEDED


def resets_spawned(call):
    return (result_of(call("spawn_entity model://pebble added - 2 2.5 0")) == OK
            and result_of(call("reset_simulation 4")) == OK and call("get_entities ^added$")["entities"] == [])


WORLD_LOADING, WORLD_UNLOADING = 40, 43
# Tests of the features of simulation_interfaces 2 that gsv has, in an order in which each can
# succeed.
FEATURES = {
    45: gets("get_available_worlds", lambda reply: "office" in reply["names"]),                   # AVAILABLE_WORLDS
    44: gets("get_current_world", lambda reply: reply["name"] == "office"),                       # WORLD_INFO_GETTING
    2: works("get_named_poses"),                                                                  # NAMED_POSES
    14: gets("get_spawnables", lambda reply: "model://pebble" in reply["uris"]),                  # SPAWNABLES
    0: works("spawn_entity model://pebble tried - 1 2.5 0"),                                      # SPAWNING
    5: gets("get_entity_bounds tried", lambda reply: len(reply["bounds"]["points"]) == 2),        # ENTITY_BOUNDS
    6: gets("get_entity_bounds tried", lambda reply: reply["bounds"]["type"] == 1),               # ENTITY_BOUNDS_BOX
    8: gets("get_entity_info tried", lambda reply: reply["category"] == 1),                       # ENTITY_CATEGORIES
    10: gets("get_entity_state tried", lambda reply: abs(reply["state"]["position"][0] - 1) < 1e-6),
    11: works("set_entity_state tried 2 2.5 0"),                                                  # ENTITY_STATE_SETTING
    12: works("get_entity_info tried"),                                                           # ENTITY_INFO_GETTING
    1: works("delete_entity tried"),                                                              # DELETING
    24: works("get_simulation_state"),                                                 # SIMULATION_STATE_GETTING
    25: sets_state,                                                                    # SIMULATION_STATE_SETTING
    26: pauses,                                                                        # SIMULATION_STATE_PAUSE
    31: works("step_simulation 1"),                                                    # STEP_SIMULATION_SINGLE
    32: works("step_simulation 5"),                                                    # STEP_SIMULATION_MULTIPLE
    33: steps_by_action,                                                               # STEP_SIMULATION_ACTION
    23: resets_spawned,                                                                # SIMULATION_RESET_SPAWNED
    20: works("reset_simulation 0"),                                                   # SIMULATION_RESET
    WORLD_LOADING: works("load_world maze"),
    WORLD_UNLOADING: works("unload_world", "load_world office"),
}


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
            self.assertEqual(call("load_world office")["result"],
                             {"result": UNSUPPORTED, "error_message":
                              "`gsv run` keeps its world. To load worlds, start `gsv serve --ros2`"})
            self.assertEqual(call("unload_world")["result"], UNSUPPORTED)

    def test_load_and_unload_worlds(self):
        with tempfile.TemporaryDirectory() as folder, serving_gsv() as client:
            call = client.call
            self.assertEqual(call("unload_world")["result"], 101)  # NO_WORLD_LOADED
            self.assertEqual(call("get_current_world")["result"]["result"], INCORRECT_STATE)
            self.assertEqual(call("load_world offise")["result"]["result"], NOT_FOUND)
            self.assertEqual(call("load_world office"), {"result": {"result": OK, "error_message": ""},
                                                         "name": "office"})
            self.assertEqual(call("get_current_world")["name"], "office")
            path = os.path.join(folder, "posts.sdf")
            with open(path, "w", encoding="utf-8") as file:
                file.write(POSTS)
            self.assertEqual(call(f"load_world {path}")["name"], "posts")
            poses = call("get_named_poses")["poses"]
            # The post is at (2, 0, 0), and its x axis points along the world's y axis. The gate is 1 m
            # ahead of the post on this axis.
            for found, wanted in zip(poses["gate"], [2, 1, 0, 0, 0, 0.5 ** 0.5, 0.5 ** 0.5]):
                self.assertAlmostEqual(found, wanted)
            self.assertEqual(call("unload_world")["result"], OK)
            self.assertEqual(call("get_current_world")["result"]["result"], INCORRECT_STATE)

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
            self.assertEqual(call("get_result 1")["status"], ABORTED)  # the simulation was not paused
            call(f"set_simulation_state {PAUSED}")
            client.await_state(PAUSED)
            self.assertEqual(call("send_goal 2 3"), {"accepted": True})
            self.assertEqual(call("send_goal 2 3"), {"accepted": False})  # there is a goal with this id already
            self.assertEqual(call("get_result 2"),
                             {"status": SUCCEEDED, "result": {"result": OK, "error_message": ""}})
            self.assertEqual(client.lines("feedback 3", 3),
                             [{"completed": 1, "remaining": 2}, {"completed": 2, "remaining": 1},
                              {"completed": 3, "remaining": 0}])
            self.assertEqual(call("send_goal 3 1000000000"), {"accepted": True})
            self.assertEqual(call("cancel_goal 3"), {"return_code": 0, "canceling": 1})
            self.assertEqual(call("get_result 3")["status"], CANCELED)
            self.assertEqual(call("cancel_goal 9")["return_code"], 2)  # unknown

    def test_answer_the_first_call_after_the_start(self):
        for _ in range(EARLY_CALLS):
            with running_gsv() as client:
                self.assertEqual(client.call("get_current_world")["result"], {"result": OK, "error_message": ""})

    def test_answer_for_time(self):
        with running_gsv() as client:
            self.assertEqual(client.call("list_parameters"), ["use_sim_time"])
            self.assertEqual(client.call("get_parameters use_sim_time"), {"type": 1, "bool_value": True})
            self.assertEqual(client.call("get_parameters other"), {"type": 0, "bool_value": False})

    def test_do_each_feature_that_they_announce(self):
        with running_gsv() as client:
            features = client.call("get_simulator_features")
            self.assertEqual(features["spawn_formats"], ["sdf", "urdf"])
            self.assertEqual(set(features["features"]), set(FEATURES) - {WORLD_LOADING, WORLD_UNLOADING})
            self.try_features(client, features["features"])

    def test_do_each_feature_that_a_server_announces(self):
        with serving_gsv() as client:
            features = client.call("get_simulator_features")["features"]
            self.assertEqual(set(features), set(FEATURES))
            self.assertEqual(result_of(client.call("load_world office")), OK)
            self.try_features(client, features)
            self.assertEqual(result_of(client.call("load_world - - <sdf/>")), UNSUPPORTED)

    def try_features(self, client, features):
        """Tries features in the order of FEATURES, then calls services that no feature announces."""
        for feature, works in FEATURES.items():
            if feature in features:
                self.assertTrue(works(client.call), f"feature {feature}")
        for line in ("get_named_pose_bounds", "set_entity_info wall"):
            self.assertEqual(result_of(client.call(line)), UNSUPPORTED, line)

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
