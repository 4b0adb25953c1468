"""The programs that chaos.py disturbs: a broker, a server with its simulations, and behaviours."""

import http.client
import json
import os
import re
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

TIMEOUT_S = 60  # time limit of each operation; an operation that takes longer counts as hung
MEMORY_SLACK_MIB = 64  # arenas of malloc and copies in the renderer remain
SLACK = 4  # threads and descriptors that omniORB keeps for some time for the next caller


class Patience:
    """Waits in small steps for an event that must occur."""

    def __init__(self, what, seconds=TIMEOUT_S):
        self.what = what
        self.end = time.monotonic() + seconds
        self.may_run_out = False

    def is_over(self):
        self.may_run_out = True
        return time.monotonic() > self.end

    def wait(self):
        if time.monotonic() > self.end and not self.may_run_out:
            raise TimeoutError(f"{self.what} did not come within {TIMEOUT_S} s")
        time.sleep(0.05)


class Refused(Exception):
    """The server answered a request with an error. The text contains its error message."""


class Laboratory:
    def __init__(self, build, folder, serve=()):
        self.serve = serve  # further arguments of the server
        self.build = build
        self.folder = folder
        self.recordings = folder / "recordings"
        self.recordings.mkdir()
        self.behaviours = []  # the behaviours that attacks may kill
        self.others = []
        self.stopped = set()
        self.slowest = 0.0
        self.count = 0
        self.reference = None
        self.broker_port = free_port()
        self.viewer_port = free_port()
        self.start_broker()
        self.start_server()

    # Programs

    def environment(self):
        return {**os.environ, "HOME": str(self.folder), "XDG_RUNTIME_DIR": str(self.folder),
                "XDG_STATE_HOME": str(self.folder / "state")}

    def start(self, name, *arguments, line=None):
        log = open(self.folder / f"{name}-{self.count}.log", "wb")
        self.count += 1
        process = subprocess.Popen([str(self.build / "bin" / arguments[0]), *arguments[1:]], stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=log, env=self.environment(),
                                   cwd=self.folder)
        process.behaviour = name
        if line:
            for said in process.stdout:
                if line in said.decode(errors="replace"):
                    return process
            process.wait()
            raise RuntimeError(f"{' '.join(arguments)} ended: {(Path(log.name)).read_text()}")
        return process

    def start_broker(self):
        self.broker = self.start("broker", "gsv", "broker", "--port", str(self.broker_port),
                                 "--data", str(self.folder / "offers.db"), line="corbaloc")
        self.reference = f"corbaloc::1.2@127.0.0.1:{self.broker_port}/TradingService"

    def start_server(self):
        self.server = self.start("server", "gsv", "serve", "--broker", self.reference, "--port", str(self.viewer_port),
                                 "--recordings", str(self.recordings), *self.serve, line="viewer:")

    def restart_server(self):
        self.server.kill()
        self.server.wait()
        self.start_server()

    def start_behaviour(self, name, is_victim=True, arguments=()):
        process = self.start(name, "gsv-wander", "--broker", self.reference, "--name", name, *arguments,
                             line="offered at")
        (self.behaviours if is_victim else self.others).append(process)
        return process

    def gsv(self, *arguments):
        return subprocess.run([str(self.build / "bin" / "gsv"), *arguments], capture_output=True, text=True,
                              timeout=TIMEOUT_S, env=self.environment())

    # The server, by its HTTP API

    def request(self, method, path, body=None, timeout=TIMEOUT_S):
        """Returns the JSON of the response. Raises Refused with the server's error message."""
        status, text = self.answer(method, path, body, timeout)
        answer = json.loads(text) if text else {}
        if status >= 400:
            raise Refused(f"{method} {path}: {status} {answer.get('error', answer)}")
        return answer

    def answer(self, method, path, body=None, timeout=TIMEOUT_S):
        start = time.monotonic()
        connection = http.client.HTTPConnection("127.0.0.1", self.viewer_port, timeout=timeout)
        try:
            connection.request(method, path, json.dumps(body) if body is not None else None,
                               {"Content-Type": "application/json"})
            response = connection.getresponse()
            text = response.read()
        finally:
            connection.close()
            self.slowest = max(self.slowest, time.monotonic() - start)
        return response.status, text

    def get(self, path):
        return self.request("GET", path)

    def create(self, scenario):
        return self.request("POST", "/api/simulations", scenario)

    def press(self, simulation, button):
        return self.request("POST", f"/api/simulations/{simulation}/{button}", {})

    def record(self, simulation, on):
        return self.request("POST", f"/api/simulations/{simulation}/recording", {"record": on})["path"]

    def status(self, simulation):
        return self.get(f"/api/simulations/{simulation}")

    def simulations(self):
        return [line["name"] for line in self.get("/api/simulations")]

    def destroy(self, simulation):
        return self.request("DELETE", f"/api/simulations/{simulation}")

    def footprint(self):
        allocated = self.metric("gsv_allocated_memory_bytes")
        return {**footprint_of(self.server.pid), "allocated_mib": round(allocated / 2**20, 1)}

    def metric(self, name):
        _, text = self.answer("GET", "/metrics")
        return float(re.search(rf"^{name} (\S+)$", text.decode(), re.MULTILINE)[1])

    # The end

    def end_victims(self):
        """Returns a sentence for each simulation that hangs after the death of its behaviours."""
        for process in self.behaviours:
            process.kill()
            process.wait()
        broken = []
        for name in self.simulations():
            if name == "witness":
                continue
            patience = Patience(f"the end of {name}")
            while True:
                status = self.status(name)
                alive = [robot for robot in status["robots"]
                         if not robot["is_avatar"] and robot["agent_phase"] in ("running", "waiting")]
                if status["phase"] not in ("running", "starting", "stopping") or not alive:
                    break
                if patience.is_over():
                    broken.append(f"{name} is {status['phase']} and waits for '{status['waiting_for']}', whose "
                                  f"process is dead: {alive}")
                    break
                patience.wait()
            self.destroy(name)
        return broken

    def close(self):
        for process in [*self.behaviours, *self.others, self.server, self.broker]:
            process.kill()
            process.wait()
        subprocess.run(["umount", str(self.recordings)], capture_output=True, check=False)  # if the recordings had a separate disk


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


def proceed(process):
    """Continues a stopped process, if it still exists."""
    try:
        process.send_signal(signal.SIGCONT)
    except ProcessLookupError:
        pass


def footprint_of(pid):
    """Returns the number of threads and descriptors of a process, and its memory in MiB."""
    process = Path("/proc") / str(pid)
    status = dict(line.split(":", 1) for line in (process / "status").read_text().splitlines())
    return {"threads": int(status["Threads"]), "descriptors": len(list((process / "fd").iterdir())),
            "memory_mib": round(int(status["VmRSS"].split()[0]) / 1024)}


def enter_own_network():
    """Restarts this program in its own network and mount namespace, if the system permits it."""
    own = ["unshare", "--net", "--mount", "sh", "-c", 'ip link set lo up && exec "$@"', "sh"]
    if "GSV_CHAOS_NETWORK" in os.environ or subprocess.run([*own, "true"], capture_output=True, check=False).returncode:
        return
    os.environ["GSV_CHAOS_NETWORK"] = "own"
    os.execvp(own[0], [*own, sys.executable, *sys.argv])
