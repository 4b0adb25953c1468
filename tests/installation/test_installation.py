"""Tests an installed GSV: it runs, and behaviours and applications can be built outside its tree."""
import json
import os
import re
import subprocess
from pathlib import Path

import pytest
from conftest import run

SOURCE = Path(os.environ["GSV_SOURCE_DIR"])
BUILD = Path(os.environ["GSV_BUILD_DIR"])


def hash_of(gsv, *options, **environment):
    """Returns the state hash after ten seconds in which the behaviour "first" drives a robot."""
    out = run(gsv, "run", "playground", "--robot", "pebble@0,0", "--behaviour", "first",
              "--lockstep", "--duration", "10", "--seed", "1", "--headless", "--json", *options,
              **environment)
    report = json.loads(out.strip().splitlines()[-1])
    assert report["robots"][0]["distance_m"] > 1
    return report["state_hash"]


@pytest.fixture(scope="session")
def ours():
    return hash_of(BUILD / "bin/gsv")


@pytest.fixture(scope="session")
def mine(prefix, tmp_path_factory):
    """Builds examples/out_of_tree by find_package."""
    folder = tmp_path_factory.mktemp("mine")
    run("cmake", "-S", SOURCE / "examples/out_of_tree", "-B", folder,
        f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Debug")
    run("cmake", "--build", folder, "--parallel", "2")
    return folder


def path_with(folder):
    return {"PATH": f"{folder}:{os.environ['PATH']}"}


def test_the_tutorial_runs_from_what_is_installed(prefix):
    environment = path_with(f"{prefix}/share/gsv/examples/tutorial:{prefix}/bin")
    environment["PYTHONPATH"] = str(prefix / "lib/python3/dist-packages")
    run(prefix / "bin/gsv", "run", "playground", "--robot", "pebble@0,0", "--behaviour", "hello",
        "--lockstep", "--headless", "--duration", "5", **environment)


def test_programs_find_worlds_models_and_the_viewer(prefix):
    doctor = run(prefix / "bin/gsv", "doctor")
    assert f"viewer: ok, {prefix}/share/gsv/web" in doctor
    run(prefix / "bin/gsv", "run", "--duration", "1", "--lockstep", "--headless")
    run(prefix / "bin/gsv", "run", "maze", "--robot", "pebble@0,0", "--behaviour", "follow-wall",
        "--in-process", "--duration", "1", "--lockstep", "--headless")


def test_every_command_has_a_manual_page(prefix):
    pages = prefix / "share/man/man1"
    names = re.findall(r"^  ([a-z][\w-]*)", run(prefix / "bin/gsv", "--help"), re.MULTILINE)
    assert {page.name for page in pages.iterdir()} == {"gsv.1", *(f"gsv-{name}.1" for name in names)}


def test_shells_find_the_completion(prefix):
    for file in ("bash-completion/completions/gsv", "zsh/vendor-completions/_gsv",
                 "fish/vendor_completions.d/gsv.fish"):
        assert "resume" in (prefix / "share" / file).read_text(), file


def test_the_documentation_site_is_installed_where_it_was_built(prefix):
    if not (BUILD / "share/gsv/docs/index.html").exists():
        pytest.skip("the site was not built: mkdocs or doxygen is not installed")
    assert (prefix / "share/gsv/docs/reference/cpp/index.html").exists()


def test_nothing_installed_names_the_folders_it_was_made_in(prefix):
    made_in = [str(BUILD).encode(), str(SOURCE).encode()]
    for file in prefix.rglob("*"):
        if file.is_file() and file.suffix in ("", ".cmake", ".pc", ".py", ".so", ".0"):
            # Only the dynamic section of programs is checked, because messages of assertions may
            # contain paths of source files.
            paths = run("readelf", "-d", file).encode() if file.read_bytes()[:4] == b"\x7fELF" \
                else file.read_bytes()
            assert not any(place in paths for place in made_in), file


def test_a_behaviour_built_by_find_package_gives_the_same_hash(prefix, mine, ours):
    assert hash_of(prefix / "bin/gsv", **path_with(mine)) == ours
    assert hash_of(prefix / "bin/gsv", "--in-process", GSV_PLUGIN_PATH=str(mine)) == ours


def test_a_behaviour_built_by_pkg_config_gives_the_same_hash(prefix, ours, tmp_path):
    environment = {"PKG_CONFIG_PATH": str(prefix / "lib/pkgconfig")}
    ask = lambda *options: run("pkg-config", *options, "gsv", **environment).split()
    assert run("pkg-config", "--modversion", "gsv", **environment).startswith("0.")
    run("c++", "-std=c++20", "-o", tmp_path / "gsv-first", SOURCE / "examples/first_behaviour.cc",
        *ask("--variable=main"), *ask("--cflags", "--libs"))
    libraries = {"LD_LIBRARY_PATH": str(prefix / "lib")}
    assert hash_of(prefix / "bin/gsv", **path_with(tmp_path), **libraries) == ours


def serving(gsv):
    server = subprocess.Popen([gsv, "serve", "--headless"], text=True, stdout=subprocess.PIPE)
    for line in server.stdout:
        if line.startswith("broker: "):
            return server, line.removeprefix("broker: ").strip()
    raise AssertionError("gsv serve said nothing of its broker")


def test_an_application_and_hardware_of_ones_own_are_built_and_run(prefix, mine):
    server, broker = serving(prefix / "bin/gsv")
    wander = subprocess.Popen([prefix / "bin/gsv-wander", "--broker", broker], text=True,
                              stdout=subprocess.PIPE)
    try:
        assert "offered at" in wander.stdout.readline()
        assert "verdict: passed" in run(mine / "test-wandering", "--broker", broker, "--world",
                                        "playground", "--places", "-1", "0", "--seconds", "10")
        assert "readings" in run(mine / "real-robot", "--broker", broker)
    finally:
        for process in (wander, server):
            process.terminate()
            process.communicate()


def test_a_sensor_from_outside_is_built_with_the_installed_headers(prefix, tmp_path):
    run("cmake", "-S", SOURCE / "examples/infrared", "-B", tmp_path,
        f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Debug")
    run("cmake", "--build", tmp_path)
    run(prefix / "bin/gsv", "run", "playground", "--robot", "pebble@0,0", "--duration", "0.1",
        "--headless", "--lockstep", "--sensor-plugin", tmp_path / "gsv-sensor-infrared.so")


def test_python_finds_the_installed_programs(prefix):
    packages = prefix / "lib/python3/dist-packages"
    out = run("/usr/bin/python3", "-c", """
import gsv, gsv.testing, importlib.metadata
assert importlib.metadata.version("gsv") == gsv.__version__
print(gsv.testing.find_program("gsv"))
with gsv.testing.PrivateSimulator() as simulator:
    with simulator.create("playground") as simulation:
        simulation.run_until(0.1)
        print(simulation.state())
""", PYTHONPATH=str(packages), PATH="/usr/bin:/bin")
    assert out.splitlines() == [f"{prefix}/bin/gsv", "<paused at 0.100 s, 0 robots>"]
