"""Tests how tools/try_files sorts worlds and models that are correct, faulty, incomplete and broken.

usage: try_files_test.py GSV [REAL_FOLDER]    REAL_FOLDER has worlds and robots of other people. None of them may
                                              crash or be refused. If the folder does not exist, it is not tested.
"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL = Path(__file__).parent / "try_files"
BOX = "<geometry><box><size>1 1 1</size></box></geometry>"
MODEL = f'<model name="crate"><link name="l"><collision name="c">{BOX}</collision></link></model>'
GSV = None
REAL = None


def tried(folder, *options):
    """Returns ({file: row}, exit code, printed text)."""
    with tempfile.TemporaryDirectory() as out:
        done = subprocess.run([sys.executable, TOOL, "--gsv", GSV, "--out", out, *options, folder],
                              capture_output=True, text=True, timeout=600)
        results = Path(out) / "results.json"
        rows = {row["file"]: row for row in json.loads(results.read_text())} if results.exists() else {}
        sheet = Path(out) / "index.html"
        images = {row["image"] for row in rows.values() if row["image"] and (Path(out) / row["image"]).stat().st_size > 0}
        return rows, done.returncode, done.stdout + (sheet.read_text() if sheet.exists() else ""), images


class TryFiles(unittest.TestCase):
    def test_states_of_worlds_and_models(self):
        files = {
            "whole.world": f'<sdf version="1.9"><world name="w">{MODEL}</world></sdf>',
            "absent.sdf": '<sdf version="1.9"><world name="w">'
                          f'<include><uri>model://nowhere</uri></include>{MODEL}</world></sdf>',
            "torn.urdf": '<robot name="r"><link name="l">',
            "light/model.config": '<model><name>lamp</name><sdf version="1.9">model.sdf</sdf></model>',
            "light/model.sdf": '<sdf version="1.9"><light name="lamp" type="point"/></sdf>',
            "crate/model.config": '<model><name>crate</name><sdf version="1.9">model.sdf</sdf></model>',
            "crate/model.sdf": f'<sdf version="1.9">{MODEL}</sdf>',
            "joint.urdf": '<robot name="r"><link name="a"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" '
                          'ixy="0" ixz="0" iyz="0"/></inertial></link><link name="b"><inertial><mass value="1"/>'
                          '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>'
                          '<joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint></robot>',
            "notes.xml": "<notes/>",
        }
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = Path(folder) / name
                path.parent.mkdir(exist_ok=True)
                path.write_text(text)
            rows, code, text, images = tried(folder)
        self.assertEqual({name: row["state"] for name, row in rows.items()},
                         {"absent.sdf": "incomplete", "crate": "ok", "joint.urdf": "ok", "torn.urdf": "refused",
                          "whole.world": "ok"})
        self.assertEqual(code, 0)
        self.assertIn("| all | 5 | 80.0 % | 3 | 0 | 1 | 1 | 0 |", text)
        self.assertIn("nowhere", text)
        self.assertEqual(len(images), 4)

    def test_a_program_that_dies_is_a_crash(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "a.world").write_text("<sdf version='1.9'><world name='w'/></sdf>")
            dying = Path(folder) / "dying"
            dying.write_text("#!/bin/sh\nkill -SEGV $$\n")
            dying.chmod(0o755)
            rows, code, text, _ = tried(folder, "--gsv", dying, "--no-draw")
        self.assertEqual((rows["a.world"]["state"], code), ("crashed", 1))
        self.assertIn("exit -11", text)

    def test_a_folder_without_worlds(self):
        with tempfile.TemporaryDirectory() as folder:
            _, code, text, _ = tried(folder)
        self.assertEqual((code, text), (2, ""))

    def test_other_peoples_files_run(self):
        if not REAL or not Path(REAL).is_dir():
            self.skipTest("there is no folder of other people's files")
        rows, code, _, _ = tried(REAL, "--no-draw")
        self.assertGreater(len(rows), 30)
        self.assertEqual({name: row["problems"] for name, row in rows.items() if not row["ran"]}, {})
        self.assertEqual(code, 0)


if __name__ == "__main__":
    GSV, *rest = sys.argv[1:]
    REAL = rest[0] if rest else None
    unittest.main(argv=sys.argv[:1])
