"""Installs GSV by `cmake --install` of the build folder into a temporary prefix."""
import os
import subprocess

import pytest


def run(*command, **environment):
    ended = subprocess.run([str(part) for part in command], text=True, capture_output=True,
                           env={**os.environ, **environment}, timeout=240)
    assert ended.returncode == 0, f"{command}: {ended.returncode}\n{ended.stdout}\n{ended.stderr}"
    return ended.stdout


@pytest.fixture(scope="session")
def prefix(tmp_path_factory):
    """Installs GSV into one folder and moves it to another, because nothing may depend on its original path."""
    first = tmp_path_factory.mktemp("installed") / "first"
    run("cmake", "--install", os.environ["GSV_BUILD_DIR"], "--prefix", first)
    return first.rename(first.parent / "moved")
