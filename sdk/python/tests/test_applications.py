"""Tests applications in Python: they find simulators, run simulations and check results."""
import signal
import subprocess
import sys

import pytest

import gsv
from gsv.testing import PrivateSimulator


class Ahead(gsv.Behaviour):
    def run(self, robot):
        while robot.sleep_for(0.05):
            robot.drive(0.2, 0.0)


def test_simulator_is_found_by_constraint(simulator):
    with simulator.create("playground", constraint="cores >= 1 and name == 'gsv'",
                          preference="min load") as simulation:
        assert simulation.state().phase == "created"
    with pytest.raises(gsv.NotFound, match="no simulator is available at the broker that matches the constraint"):
        simulator.create("playground", constraint="cores > 100000")
    with pytest.raises(gsv.Refused, match="character 8"):
        simulator.create("playground", constraint="cores >")


def test_run_until_pauses_at_the_instant_and_is_reproducible(simulate):
    hashes = set()
    for _ in range(2):
        simulation = simulate("playground", seed=3)
        assert simulation.add("pebble", x=-0.5, yaw=1.57, behaviour=Ahead, name="cart") == "cart"
        simulation.run_until(1.0)
        simulation.run_for(0.5)
        state = simulation.state()
        assert (state.phase, state.time) == ("paused", 1.5)
        assert state.robots["cart"].model == "pebble"
        hashes.add(simulation.state_hash())
    assert len(hashes) == 1


def test_reset_returns_to_the_start(simulate):
    simulation = simulate("playground")
    simulation.add("pebble", behaviour=Ahead)
    simulation.run_until(1)
    first = simulation.state_hash()
    simulation.reset()
    assert simulation.state().time == 0
    simulation.run_until(1)
    assert simulation.state_hash() == first


def test_real_time_factor_can_be_set(simulator, simulate):
    with simulator.create("playground", lockstep=False, factor=1e-4) as simulation:
        simulation.set_factor(1e6)
        simulation.run_until(5)  # at its first real-time factor, this would take fourteen hours
        assert simulation.state().time == 5
        with pytest.raises(gsv.Refused, match="above 0"):
            simulation.set_factor(0)
    with pytest.raises(gsv.Refused, match="as fast as possible"):
        simulate("playground").set_factor(2)


def test_commands_are_called_by_name(simulate):
    simulation = simulate("playground")
    before = simulation.state_hash()
    simulation.command("set_gravity", z=-1.62)
    assert simulation.state_hash() != before
    simulation.command("set_gravity")
    assert simulation.state_hash() == before
    with pytest.raises(gsv.Refused, match="set_gravity: 'z' must be a number from -100 to 100"):
        simulation.command("set_gravity", z=float("nan"))
    with pytest.raises(gsv.Refused, match="no command 'explode'"):
        simulation.command("explode", loudly=True)


def test_run_until_a_condition_stops_at_the_same_instant(simulate):
    instants = set()
    for _ in range(2):
        simulation = simulate("playground")
        simulation.add("pebble", behaviour=Ahead)
        state = simulation.run_until_true(lambda state: state.robots["pebble"].distance > 0.5,
                                          at_most=10)
        assert state is not None and state.robots["pebble"].distance > 0.5
        instants.add(state.time)
    assert len(instants) == 1
    assert simulation.run_until_true(lambda state: False, at_most=0.25) is None


def test_refused_requests_contain_the_reason(simulate):
    with pytest.raises(gsv.Refused, match="nowhere"):
        simulate("nowhere")
    with pytest.raises(ValueError, match="step_ns"):
        simulate("playground", step=-1.0)
    simulation = simulate("playground")
    with pytest.raises(gsv.Refused, match="unicorn"):
        simulation.add("unicorn")
    with pytest.raises(gsv.Error, match="nobody"):
        simulation.add("pebble", behaviour="nobody")
    with pytest.raises(TypeError, match="a callable that returns a behaviour"):
        simulation.add("pebble", behaviour=3)
    with pytest.raises(gsv.NotRunning, match="paused"):
        simulation.resume()
    simulation.destroy()
    with pytest.raises(gsv.Ended):
        simulation.state()


def test_robots_can_be_added_and_removed(simulate):
    simulation = simulate("playground")
    simulation.add("pebble", x=-1, name="one", behaviour=Ahead)
    simulation.add("pebble", x=1, name="two")
    simulation.remove("two")
    assert list(simulation.state().robots) == ["one"]


def test_simulation_can_be_recorded(simulate, tmp_path):
    simulation = simulate("playground")
    simulation.add("pebble", behaviour=Ahead)
    simulation.start_recording(str(tmp_path / "run.mcap"))
    simulation.run_until(0.5)
    simulation.stop_recording()
    assert (tmp_path / "run.mcap").read_bytes().startswith(b"\x89MCAP")


def test_missing_broker_is_reported(monkeypatch):
    with pytest.raises(ConnectionError, match="127.0.0.1:1"):
        gsv.connect("corbaloc::1.2@127.0.0.1:1/TradingService")
    monkeypatch.delenv("GSV_BROKER", raising=False)
    with pytest.raises(gsv.Refused, match="no broker was named"):
        gsv.connect()


def run_script(text, *arguments):
    return subprocess.Popen([sys.executable, "-c", text, *arguments], text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def test_control_c_ends_a_wait(simulator):
    program = run_script("""
import sys, gsv
class Says(gsv.Behaviour):
    def run(self, robot):
        print("under way", flush=True)
        while robot.sleep_for(0.05):
            pass
with gsv.connect(sys.argv[1]).create("playground", lockstep=False) as simulation:
    simulation.add("pebble", behaviour=Says)
    simulation.run_until(3600)
""", simulator.broker)
    assert program.stdout.readline() == "under way\n"
    program.send_signal(signal.SIGINT)
    _, errors = program.communicate(timeout=60)
    assert errors.endswith("KeyboardInterrupt\n"), errors
    assert program.returncode == -signal.SIGINT  # the exit code with which Python itself ends


def test_program_that_does_not_close_its_objects_ends_cleanly(simulator):
    program = run_script("""
import sys, gsv
class Busy(gsv.Behaviour):
    def run(self, robot):
        while robot.sleep_for(0.01):
            robot.drive(0.1, 0)
simulation = gsv.connect(sys.argv[1]).create("playground", lockstep=False)
simulation.add("pebble", behaviour=Busy)
simulation.start()
offer = gsv.Offer(sys.argv[1], "busy", Busy)
""", simulator.broker)
    assert program.communicate(timeout=60) == ("", "")
    assert program.returncode == 0


def test_orb_starts_again_after_its_last_user_has_ended(simulator):
    text = """
import sys, gsv
for _ in range(3):
    application = gsv.connect(sys.argv[1])
    with application.create("playground") as simulation:
        simulation.run_until(0.1)
    del application, simulation
    with gsv.Offer(sys.argv[1], "again", gsv.Behaviour):
        pass
print("well")
"""
    assert run_script(text, simulator.broker).communicate(timeout=60) == ("well\n", "")


def test_private_simulator_that_cannot_start_reports_the_reason():
    with pytest.raises(gsv.Unavailable, match="--no-such-option"):
        PrivateSimulator("--no-such-option")
