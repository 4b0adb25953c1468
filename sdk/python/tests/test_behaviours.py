"""Tests behaviours in Python."""
import json
import os
import signal
import subprocess
import sys
import threading

import pytest

import gsv
from gsv.testing import find_program


def hash_of(simulate, behaviour, seconds=20.0):
    simulation = simulate("playground", seed=1)
    simulation.add("pebble", behaviour=behaviour)
    simulation.run_until(seconds)
    assert simulation.state().robots["pebble"].distance > 1
    return simulation.state_hash()


def test_first_behaviour_has_the_same_hash_as_in_cpp(simulator, simulate, examples):
    simulator.start("gsv-first", "--name", "first-cpp")
    simulator.start(str(examples / "first_behaviour.py"), "--name", "first-py")
    assert hash_of(simulate, "first-cpp") == hash_of(simulate, "first-py")


def test_wander_has_the_same_hash_as_in_cpp(simulator, simulate, examples):
    simulator.start("gsv-wander", "--name", "wander-cpp")
    simulator.start(str(examples / "wander.py"), "--name", "wander-py")
    assert hash_of(simulate, "wander-cpp") == hash_of(simulate, "wander-py")


class First(gsv.Behaviour):
    def init(self, robot):
        self.sonars = gsv.SonarRing(robot, 8)

    def run(self, robot):
        while True:
            blocked = gsv.nearest(self.sonars.read(), 0.0, 0.9) < robot.footprint_radius + 0.4
            robot.drive(0.0 if blocked else 0.3, 0.8 if blocked else 0.0)
            if not robot.sleep_for(0.05):
                return


def test_class_in_the_process_of_the_application_has_the_same_hash(simulator, simulate):
    simulator.start("gsv-first", "--name", "first-beside")
    assert hash_of(simulate, First) == hash_of(simulate, "first-beside")


def test_controller_equals_a_loop_of_exchanges(simulate):
    class Controlled(gsv.Controller):
        def init(self, robot):
            self.sonars = gsv.SonarRing(robot, 8)
            self.limit = robot.footprint_radius + 0.4

        def control(self, readings):
            assert {reading.sensor for reading in readings.values()} == set(readings)
            echoes = self.sonars.from_readings(readings)
            assert len(echoes) == 8
            return (0.0, 0.8) if gsv.nearest(echoes, 0.0, 0.9) < self.limit else (0.3, 0.0)

    class Looping(Controlled):
        def run(self, robot):
            cycle, command = 0, (0.0, 0.0)
            while True:
                cycle += 1
                readings = robot.exchange(*command, until=cycle * 0.05)
                if readings is None:
                    return
                command = self.control(readings)

    assert hash_of(simulate, Controlled) == hash_of(simulate, Looping)


SLIDER = """<sdf version='1.9'><model name='slider'><link name='base'>
    <collision name='c'><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision></link>
  <plugin filename='gz-sim-velocity-control-system' name='gz::sim::systems::VelocityControl'/>
</model></sdf>"""


class Sideways(gsv.Behaviour):
    def run(self, robot):
        robot.drive(0.0, 0.0, lateral=0.5)
        robot.sleep_for(2.0)


class ControlledSideways(gsv.Controller):
    def control(self, readings):
        return 0.0, 0.0, 0.5


@pytest.mark.parametrize("behaviour", [Sideways, ControlledSideways])
def test_omnidirectional_base_moves_sideways(simulate, tmp_path, behaviour):
    (tmp_path / "slider.sdf").write_text(SLIDER)
    simulation = simulate("playground")
    simulation.add(str(tmp_path / "slider.sdf"), behaviour=behaviour)
    simulation.run_until(1.0)
    slider = simulation.state().robots["slider"]
    assert slider.distance == pytest.approx(0.5, abs=0.05)
    assert slider.place.y == pytest.approx(0.5, abs=0.05)


def test_one_instance_drives_one_robot(simulate):
    instances = []

    class Named(gsv.Behaviour):
        def init(self, robot):
            self.name = robot.name
            instances.append(self)

        def run(self, robot):
            while robot.sleep_for(0.05):
                robot.drive(0.2, 0.0)

    simulation = simulate("playground")
    names = [simulation.add("pebble", y=y, behaviour=Named) for y in (-1, 0, 1)]
    simulation.run_until(2)
    assert sorted(each.name for each in instances) == sorted(names)
    assert all(robot.distance > 0.3 for robot in simulation.state().robots.values())


def test_exception_in_init_rejects_the_robot(simulate):
    class Picky(gsv.Behaviour):
        def init(self, robot):
            raise ValueError("I want a gripper")

        def run(self, robot):
            pass

    with pytest.raises(gsv.Error, match="ValueError: I want a gripper"):
        simulate("playground").add("pebble", behaviour=Picky)


def test_exception_in_run_ends_only_the_run(simulate):
    class Faulty(gsv.Behaviour):
        def run(self, robot):
            robot.sleep_for(0.5)
            raise ZeroDivisionError

    simulation = simulate("playground")
    simulation.add("pebble", behaviour=Faulty, name="faulty")
    simulation.add("pebble", y=1, behaviour=First, name="first")
    simulation.run_until(2)
    robots = simulation.state().robots
    assert robots["faulty"].agent == "dead"
    assert robots["first"].distance > 0.3


def test_robot_does_nothing_after_the_end_of_the_run(simulate):
    kept, ended = {}, threading.Event()

    class Keeping(gsv.Behaviour):
        def init(self, robot):
            kept.update(robot=robot, sonar=robot.open("sonar_00"),
                        camera=robot.open("camera"), ring=gsv.SonarRing(robot, 4))

        def run(self, robot):
            while robot.sleep_for(0.05):
                pass
            ended.set()

    simulation = simulate("playground")
    simulation.add("pebble", behaviour=Keeping)
    simulation.run_until(0.2)
    simulation.destroy()
    assert ended.wait(60)
    robot, sonar = kept["robot"], kept["sonar"]
    assert not robot.is_running and robot.error == ""
    assert robot.sleep_for(1) is False and robot.exchange(1, 0, until=9) is None
    robot.drive(1, 0)
    assert sonar.range() == sonar.max_range and sonar.measure().values.size == 0
    assert kept["camera"].take_image().shape == (0, 0, 3)
    assert not any(echo.in_reach for echo in kept["ring"].read())
    with pytest.raises(gsv.Error):
        robot.open("sonar_01")


def test_pause_is_notified(simulate):
    told, both = [], threading.Event()

    class Listening(First):
        def paused(self):
            told.append("paused")

        def resumed(self):
            told.append("resumed")
            both.set()

    simulation = simulate("playground", lockstep=False)
    simulation.add("pebble", behaviour=Listening)
    simulation.start()
    simulation.pause()
    simulation.resume()
    assert both.wait(60)
    assert told == ["paused", "resumed"]


def test_invalid_times_are_rejected(simulate):
    refused = []

    class Timeless(gsv.Behaviour):
        def run(self, robot):
            for time in (float("nan"), float("inf"), 1e18):
                with pytest.raises(ValueError, match="expected a time in seconds"):
                    robot.sleep_for(time)
                refused.append(time)

    simulation = simulate("playground")
    simulation.add("pebble", behaviour=Timeless)
    simulation.run_until(0.1)
    assert len(refused) == 3


def test_commands_that_are_not_finite_are_rejected_and_the_robot_continues(simulate):
    refused = []

    class Careless(gsv.Behaviour):
        def run(self, robot):
            for value in (float("nan"), float("inf")):
                with pytest.raises(ValueError, match="linear velocity of pebble must be finite"):
                    robot.drive(value, 0)
                with pytest.raises(ValueError, match="angular velocity of pebble must be finite"):
                    robot.exchange(0, value, until=0.01)
                refused.append(value)
            robot.drive(0.2, 0)
            robot.sleep_until(2)

    simulation = simulate("playground")
    simulation.add("pebble", behaviour=Careless)
    simulation.run_until(2)
    assert len(refused) == 2
    assert simulation.state().robots["pebble"].distance > 0.2


def start_program(program, *arguments):
    return subprocess.Popen([sys.executable, str(program), *arguments], text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_signal_withdraws_the_offer_and_ends_the_program_cleanly(simulator, examples, number):
    program = start_program(examples / "first_behaviour.py", "--broker", simulator.broker,
                            "--name", "fleeting")
    assert program.stdout.readline() == f"fleeting: offered at {simulator.broker}\n"
    offers = [find_program("gsv"), "offers", "--broker", simulator.broker]
    assert "fleeting" in subprocess.run(offers, capture_output=True, text=True).stdout
    program.send_signal(number)
    assert program.communicate(timeout=60) == ("", "")
    assert program.returncode == 0
    assert "fleeting" not in subprocess.run(offers, capture_output=True, text=True).stdout


def test_signal_to_another_thread_ends_the_program(simulator, tmp_path):
    script = tmp_path / "threads.py"
    script.write_text("""
import signal, threading, gsv
def take():  # the main thread blocks the signal; this thread does not
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
    threading.Event().wait()
signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
threading.Thread(target=take, daemon=True).start()
gsv.serve("threads", gsv.Behaviour)
""")
    program = start_program(script, "--broker", simulator.broker)
    program.stdout.readline()
    program.send_signal(signal.SIGINT)
    assert program.communicate(timeout=60) == ("", "")
    assert program.returncode == 0


@pytest.mark.parametrize("arguments, code, sentence", [
    ([], 2, "--broker"),
    (["--broker", "nonsense"], 2, "nonsense"),
    (["--broker", "corbaloc::1.2@127.0.0.1:1/TradingService"], 5, "127.0.0.1:1"),
])
def test_behaviour_that_cannot_be_offered_is_reported(examples, arguments, code, sentence):
    environment = {key: value for key, value in os.environ.items() if key != "GSV_BROKER"}
    ended = subprocess.run([sys.executable, str(examples / "first_behaviour.py"), *arguments],
                           capture_output=True, text=True, env=environment)
    assert ended.returncode == code, ended.stderr
    assert sentence in ended.stderr and "Traceback" not in ended.stderr


def test_output_of_a_behaviour_is_printed_and_does_not_block_it(tmp_path):
    script = tmp_path / "gsv-chatter"
    script.write_text(f"""#!{sys.executable}
import gsv
class Chatter(gsv.Behaviour):
    def run(self, robot):
        while robot.sleep_for(0.01):
            print("word " * 1000)  # all lines together exceed the size of a pipe
gsv.serve("chatter", Chatter)
""")
    script.chmod(0o755)
    environment = dict(os.environ, PATH=f"{tmp_path}:{os.environ['PATH']}")
    ended = subprocess.run(
        [find_program("gsv"), "run", "playground", "--robot", "pebble@0,0", "--behaviour",
         "chatter", "--lockstep", "--duration", "0.5", "--headless"],
        capture_output=True, text=True, env=environment, timeout=120)
    assert ended.returncode == 0, ended.stderr[-500:]
    assert "unresponsive" not in ended.stderr and ended.stderr.count("word") > 40_000


def test_gsv_run_starts_a_python_program_by_name(tmp_path, examples):
    (tmp_path / "gsv-first-in-python").symlink_to(examples / "first_behaviour.py")
    environment = dict(os.environ, PATH=f"{tmp_path}:{os.environ['PATH']}")
    ended = subprocess.run(
        [find_program("gsv"), "run", "playground", "--robot", "pebble@0,0", "--behaviour",
         "first-in-python", "--lockstep", "--duration", "1", "--headless"],
        capture_output=True, text=True, env=environment)
    assert ended.returncode == 0, ended.stderr


def run_recorded(tmp_path, name, body):
    """Runs a behaviour `body`, of a robot `pebble`, and returns the run and its recorded output."""
    script = tmp_path / f"gsv-{name}"
    script.write_text(f"#!{sys.executable}\n{body}")
    script.chmod(0o755)
    recording = tmp_path / f"{name}.mcap"
    environment = dict(os.environ, PATH=f"{tmp_path}:{os.environ['PATH']}")
    ended = subprocess.run(
        [find_program("gsv"), "run", "playground", "--robot", "pebble@0,0", "--behaviour", name,
         "--lockstep", "--duration", "1", "--headless", "--record", recording],
        capture_output=True, text=True, env=environment, timeout=120)
    printed = subprocess.run(
        [find_program("gsv"), "rec", "cat", recording, "--topic", "/gsv/output"],
        capture_output=True, text=True)
    return ended, [json.loads(line)["message"] for line in printed.stdout.splitlines()]


def test_output_of_a_behaviour_that_died_is_recorded_and_reported(tmp_path):
    ended, lines = run_recorded(tmp_path, "faller", """import gsv
class Faller(gsv.Behaviour):
    def run(self, robot):
        print("on my way")
        robot.sleep_for(0.5)
        raise ValueError("too far")
gsv.serve("faller", Faller)
""")
    assert ended.returncode == 4, ended.stderr
    assert "ValueError: too far in gsv-faller line 7" in ended.stderr
    assert "[faller] on my way" in ended.stderr
    assert "was dead from 0.5 s" in ended.stdout
    assert ("pebble", "on my way", "stdout") in [(m["name"], m["msg"], m["file"]) for m in lines]
    assert ("pebble", "ValueError: too far", "stderr") in [
        (m["name"], m["msg"], m["file"]) for m in lines]


def test_end_of_a_behaviour_program_is_recorded_with_its_last_error(tmp_path):
    ended, lines = run_recorded(tmp_path, "crasher", """import os, sys, gsv
class Crasher(gsv.Behaviour):
    def run(self, robot):
        print("OSError: the wheel is off", file=sys.stderr, flush=True)
        os._exit(3)
gsv.serve("crasher", Crasher)
""")
    assert ended.returncode == 4, ended.stderr
    assert "behaviour crasher ended with exit code 3: OSError: the wheel is off" in [
        m["msg"] for m in lines]
