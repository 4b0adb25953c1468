#!/usr/bin/env python3
"""Checks that docs/formats/scenario.schema.json and gsv's own reader agree about scenarios.

usage: check_scenarios.py GSV SCHEMA FOLDER

python3-jsonschema must accept each *.yaml of FOLDER by the schema. For each text of CASES, the
schema and `gsv test` must give the same verdict. `gsv test` refuses an invalid scenario with exit
code 3 before it runs anything.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import jsonschema
import yaml

GOOD = """
world: nowhere.sdf
duration: 10
"""
CASES = [  # (text, is a scenario)
    ("", True),
    ("seed: 18446744073709551615", True),
    ("seed: -1", False),
    ("seed: '1'", False),
    ("mode: fast", False),
    ("wrold: office", False),
    ("step: 0", True),
    ("step: 1.0e-9", False),
    ("in_process: 'true'", False),
    ("robots: [{model: pebble, x: 1, y: 2, yaw: 90deg}]", True),
    ("robots: [{model: pebble, x: 1}]", False),
    ("robots: [{behaviour: wander}]", False),
    ("avatars: [{model: avatar, behaviour: wander}]", False),
    ("faults: [{at: 1, sensor: scout/front}]", True),
    ("faults: [{at: 1, sensor: scout/front, fails: error}]", True),
    ("faults: [{at: 1, sensor: scout}]", False),
    ("faults: [{sensor: scout/front}]", False),
    ("faults: [{at: 1, motor: scout, behaviour: scout}]", False),
    ("faults: [{at: 1, move: door, x: 1, y: 2}]", True),
    ("faults: [{at: 1, move: door, x: 1}]", False),
    ("faults: [{at: 1, joint: door/hinge, position: 1}]", True),
    ("faults: [{at: 1, joint: door/hinge, position: 1, effort: 2}]", False),
    ("expect: [{reaches: {robot: a, x: 1, y: 2}, by: 5, name: there}]", True),
    ("expect: [{reaches: {robot: a, x: 1}}]", False),
    ("expect: [{stays_within: {robot: a, x: [0, 1]}, from: 1}]", True),
    ("expect: [{stays_within: {robot: a}}]", False),
    ("expect: [{never_collides: [a, b]}, {never_collides: a}]", True),
    ("expect: [{never: stuck}, {never: {contact: a}, by: 3}]", True),
    ("expect: [{never: {stuck: {robot: a, after: 2}}}, {eventually: {stuck: a}}]", True),
    ("expect: [{never: a}]", False),
    ("expect: [{never: {stuck: {after: 0}}}]", False),
    ("stuck_after: 0.5", True),
    ("stuck_after: 0", False),
    ("expect: [{distance_at_least: {between: [a, a], metres: 1}}]", False),
    ("expect: [{before: [{ended: a}, {contact: [a, b]}]}]", True),
    ("expect: [{before: [{ended: a}]}]", False),
    ("expect: [{always: {implies: [{sensor: {of: a/s, at_most: 1}}, {eventually: {ended: a}, by: 2}]}}]", True),
    ("expect: [{sensor: {of: a, at_most: 1}}]", False),
    ("expect: [{speed: {robot: a}}]", False),
    ("expect: [{speed: {robot: a, at_most: 1}, by: 3}]", False),
    ("expect: [{never: a}]", False),
    ("expect: [{ended: a, contact: a}]", False),
    ("expect: [{any: []}]", False),
    ("expect: [{until: [{time: {at_least: 1}}, {not: {distance: {between: [a, b], at_least: 1}}}]}]", True),
]


def main():
    gsv, schema_file, folder = sys.argv[1:]
    schema = json.loads(Path(schema_file).read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    problems = []
    scenarios = sorted(Path(folder).glob("*.yaml"))
    if not scenarios:
        problems.append(f"{folder} holds no scenario")
    for file in scenarios:
        for error in validator.iter_errors(yaml.safe_load(file.read_text())):
            problems.append(f"{file}: {error.json_path}: {error.message}")
    with tempfile.TemporaryDirectory() as place:
        for text, is_scenario in CASES:
            file = Path(place) / "case.yaml"
            file.write_text(GOOD + text + "\n")
            by_schema = validator.is_valid(yaml.safe_load(file.read_text()))
            # The second share of one scenario is empty: the file is read, but nothing is run.
            run = subprocess.run([gsv, "test", file, "--shard", "2/2"], capture_output=True, text=True, check=False)
            by_gsv = {0: True, 3: False}.get(run.returncode)
            for who, verdict in (("the schema", by_schema), ("gsv", by_gsv)):
                if verdict != is_scenario:
                    problems.append(f"{who} says {verdict} of: {text} {run.stderr}")
    for problem in problems:
        print(problem)
    print(f"{len(scenarios)} scenarios, {len(CASES)} cases: {'bad' if problems else 'good'}")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
