"""Tests the fixtures with which pytest runs scenarios."""
import pytest

import gsv
from gsv.testing import run_scenarios

STILL = """world: playground
duration: 1
robots: [{model: pebble, x: 0, y: 0}]
expect: [{name: stays, always: {speed: {robot: pebble, at_most: 0}}}]
"""


def test_passing_scenario_passes_the_test(expect_passes, tmp_path):
    (tmp_path / "still.yaml").write_text(STILL)
    (result,) = expect_passes(tmp_path / "still.yaml", "--no-record", "--repeat", "2")
    assert result.status == "passed" and len(set(result.state_hashes)) == 1
    assert result.report["sim_time_s"] == 1


def test_failing_scenario_fails_the_test_with_its_message(expect_passes, tmp_path):
    moving = tmp_path / "moving.yaml"
    moving.write_text(STILL.replace("always", "eventually").replace("at_most: 0", "at_least: 1"))
    with pytest.raises(pytest.fail.Exception, match="stays: violated at 1 s"):
        expect_passes(moving, "--no-record")


def test_invalid_scenario_is_reported(tmp_path):
    with pytest.raises(gsv.BadModel, match="there is no scenario file"):
        run_scenarios(tmp_path / "none.yaml")
    (tmp_path / "lost.yaml").write_text(STILL.replace("playground", "atlantis"))
    (result,) = run_scenarios(tmp_path / "lost.yaml", "--no-record",
                              "--failures", tmp_path / "failures")
    assert result.status == "error" and "atlantis" in result.message
