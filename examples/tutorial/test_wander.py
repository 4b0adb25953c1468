"""Tests that robots with the behaviour wander move without collisions, and leave a corner."""
import pytest

pytest_plugins = ["gsv.testing"]


@pytest.fixture(scope="session", autouse=True)
def wander(simulator):
    simulator.start("gsv-wander")


@pytest.mark.parametrize("seed", range(3))
def test_wander_moves_without_collisions(simulate, seed):
    simulation = simulate("playground", seed=seed)
    for y in (-1.0, 0.0, 1.0):
        simulation.add("pebble", y=y, yaw=seed, behaviour="wander")
    simulation.run_until(30)
    for robot in simulation.state().robots.values():
        assert robot.distance > 3, robot
        assert robot.collisions == 0, robot


def test_wander_leaves_the_corner(simulate):
    simulation = simulate("playground")
    simulation.add("pebble", x=-4.5, y=-4.5, yaw=-2.4, behaviour="wander")
    assert simulation.run_until_true(
        lambda state: state.robots["pebble"].place.x > -3.5, at_most=60)
