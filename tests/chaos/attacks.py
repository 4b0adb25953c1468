"""The disturbances that chaos.py causes, one class each.

An attack has `refusal`, the reason why it is not possible on this machine (None: it is possible),
strike(), which takes at most two seconds, and end(), which removes all of its effects.

The server promises to respond to every HTTP request (chaos.py lists all promises). A refusal, which is
a response with a status of 400 or more, also counts as a response. If a request gets no response within
TIMEOUT_S (laboratory.py), the test ends with an error. Only requests of the attack Flood may remain
without a response.
"""

import base64
import os
import signal
import socket
import subprocess
import threading
import time

from laboratory import Refused, proceed

MOST_BEHAVIOURS = 6
MOST_SIMULATIONS = 6
MOST_VIEWERS = 20


class Attack:
    refusal = None

    def __init__(self, laboratory, chance):
        self.laboratory = laboratory
        self.chance = chance

    def end(self):
        pass

    def victims(self):
        return [name for name in self.laboratory.simulations() if name.startswith("victim")]

    def living(self):
        return [process for process in self.laboratory.behaviours if process.poll() is None]


class StartBehaviour(Attack):
    def strike(self):
        if len(self.living()) < MOST_BEHAVIOURS:
            self.laboratory.start_behaviour(f"victim{self.chance.randrange(MOST_BEHAVIOURS)}")


class KillBehaviour(Attack):
    def strike(self):
        if living := self.living():
            process = self.chance.choice(living)
            process.kill()
            process.wait()
            self.laboratory.behaviours.remove(process)


class StopBehaviour(Attack):
    """Stops a behaviour for up to a second. The server cannot know whether it will continue."""

    def strike(self):
        if living := self.living():
            process = self.chance.choice(living)
            process.send_signal(signal.SIGSTOP)
            time.sleep(self.chance.uniform(0, 1))
            proceed(process)


class CreateSimulation(Attack):
    count = 0

    def strike(self):
        if len(self.victims()) >= MOST_SIMULATIONS or not self.living():
            return
        CreateSimulation.count += 1
        name = f"victim-{CreateSimulation.count}"
        behaviours = [process.behaviour for process in self.living()]
        robots = [{"model": "pebble", "x": x, "y": -1.5, "behaviour": self.chance.choice(behaviours)}
                  for x in (-1.0, 1.0)]
        try:
            self.laboratory.create({"name": name, "world": "playground", "seed": self.chance.randrange(100),
                                    "mode": self.chance.choice(["lockstep", "real_time"]), "robots": robots,
                                    "duration": self.chance.choice([0, 5])})
            self.laboratory.press(name, "start")
        except Refused:
            pass  # the behaviour has just died


class PressButtons(Attack):
    def strike(self):
        for _ in range(5):
            if not (victims := self.victims()):
                return
            try:
                self.laboratory.press(self.chance.choice(victims),
                                      self.chance.choice(["start", "pause", "resume", "stop", "reset", "step"]))
            except Refused:
                pass


class DestroySimulation(Attack):
    def strike(self):
        if victims := self.victims():
            try:
                self.laboratory.destroy(self.chance.choice(victims))
            except Refused:
                pass


class Record(Attack):
    def strike(self):
        if victims := self.victims():
            try:
                self.laboratory.record(self.chance.choice(victims), self.chance.random() < 0.6)
            except Refused:
                pass


class StalledViewers(Attack):
    """Viewers subscribe to all topics and never read. Later they disappear without closing the connection."""

    def __init__(self, laboratory, chance):
        super().__init__(laboratory, chance)
        self.viewers = []

    def strike(self):
        while len(self.viewers) > MOST_VIEWERS or (self.viewers and self.chance.random() < 0.3):
            self.viewers.pop(self.chance.randrange(len(self.viewers))).close()
        viewer = socket.create_connection(("127.0.0.1", self.laboratory.viewer_port), timeout=10)
        key = base64.b64encode(bytes(self.chance.randrange(256) for _ in range(16))).decode()
        viewer.sendall((f"GET /ws HTTP/1.1\r\nHost: 127.0.0.1:{self.laboratory.viewer_port}\r\nUpgrade: websocket\r\n"
                        f"Connection: Upgrade\r\nSec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n"
                        "Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n\r\n").encode())
        text = '{"op":"subscribe","subscriptions":[%s]}' % ",".join(
            '{"id":%d,"channelId":%d}' % (i, i) for i in range(1, 60))
        payload = text.encode()
        viewer.sendall(b"\x81\xfe" + len(payload).to_bytes(2, "big") + b"\0\0\0\0" + payload)
        self.viewers.append(viewer)

    def end(self):
        for viewer in self.viewers:
            viewer.close()


class Noise(Attack):
    """Sends random bytes to every port on which the server and the broker listen."""

    def strike(self):
        ports = [self.laboratory.viewer_port, self.laboratory.broker_port,
                 *listening_ports(self.laboratory.server.pid)]
        for _ in range(10):
            start = self.chance.choice([b"", b"GET / HTTP/1.1\r\n", b"GIOP\x01\x02\x01\x00\xff\xff\xff\x7f",
                                        b"POST /api/simulations HTTP/1.1\r\nContent-Length: 999999999\r\n\r\n"])
            noise = start + bytes(self.chance.randrange(256) for _ in range(self.chance.randrange(2000)))
            try:
                with socket.create_connection(("127.0.0.1", self.chance.choice(ports)), timeout=5) as victim:
                    victim.sendall(noise)
            except OSError:
                pass  # the server has closed the connection, as it should


class Flood(Attack):
    """Sends many requests at the same time."""

    def strike(self):
        def ask():
            for _ in range(20):
                try:
                    self.laboratory.get("/api/simulations")
                except (Refused, OSError):
                    pass  # a refusal is a response

        threads = [threading.Thread(target=ask) for _ in range(10)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()


class KillApplication(Attack):
    """A program that uses the services dies while it uses them."""

    def strike(self):
        command = self.chance.choice([["ps"], ["offers"], ["run", "playground", "--robot", "pebble@0,-1.5", "--headless",
                                                           "--behaviour", "witness", "--duration", "30"]])
        application = self.laboratory.start("application", "gsv", *command, "--broker", self.laboratory.reference)
        time.sleep(self.chance.uniform(0, 1))
        application.kill()
        application.wait()


class KillBroker(Attack):
    def strike(self):
        self.laboratory.broker.kill()
        self.laboratory.broker.wait()
        time.sleep(self.chance.uniform(0, 0.5))
        self.laboratory.start_broker()


class BadDisk(Attack):
    """The disk of the recordings is full, is read-only, or does not respond for some time."""

    SIZE = 8 << 20  # bytes

    def __init__(self, laboratory, chance):
        super().__init__(laboratory, chance)
        self.folder = str(laboratory.recordings)
        self.filler = laboratory.recordings / "filler"
        image = laboratory.folder / "disk"
        with open(image, "wb") as file:
            file.truncate(self.SIZE)
        # A separate disk can be frozen. If no disk can be mounted, the recordings are in a file
        # system in memory, which can also be full or read-only.
        self.may_freeze = (run(["mkfs.ext4", "-q", str(image)]) is None
                           and run(["mount", "-o", "loop", str(image), self.folder]) is None)
        if not self.may_freeze:
            self.refusal = run(["mount", "-t", "tmpfs", "-o", f"size={self.SIZE}", "tmpfs", self.folder])

    def strike(self):
        self.chance.choice([self.fill, self.forbid, self.freeze] if self.may_freeze else [self.fill, self.forbid])()
        # Removes old recordings, as users do when a disk becomes full.
        for recording in sorted(self.laboratory.recordings.glob("*.mcap"))[:-2]:
            recording.unlink()

    def fill(self):
        with open(self.filler, "wb", buffering=0) as filler:
            try:
                while filler.write(bytes(1 << 16)) == 1 << 16:
                    pass
            except OSError:
                pass  # full
        time.sleep(self.chance.uniform(0.5, 1.5))
        self.filler.unlink()

    def forbid(self):
        run(["mount", "-o", "remount,ro", self.folder])  # fails while a recording is being written
        time.sleep(self.chance.uniform(0.1, 1))
        run(["mount", "-o", "remount,rw", self.folder])

    def freeze(self):
        # A shell freezes the disk, because it also thaws the disk if this program dies.
        seconds = self.chance.uniform(0.1, 1.5)
        run(["sh", "-c", f'fsfreeze -f "$0"; sleep {seconds}; fsfreeze -u "$0"', self.folder])


class CutNetwork(Attack):
    """The loopback device of the laboratory's own network goes down and comes back."""

    def __init__(self, laboratory, chance):
        super().__init__(laboratory, chance)
        if os.environ.get("GSV_CHAOS_NETWORK") != "own":
            self.refusal = "a network of its own takes root (unshare --net)"

    def strike(self):
        subprocess.run(["ip", "link", "set", "lo", "down"], check=True)
        time.sleep(self.chance.uniform(0, 1))
        subprocess.run(["ip", "link", "set", "lo", "up"], check=True)


class BadNetwork(Attack):
    """The laboratory's own network is slow and loses packets for a while.

    If the kernel has netem, uses netem. Otherwise limits the rate of the device; its queue then delays
    packets by up to 30 ms and drops further packets.
    """

    def __init__(self, laboratory, chance):
        super().__init__(laboratory, chance)
        if os.environ.get("GSV_CHAOS_NETWORK") != "own":
            self.refusal = "a network of its own takes root (unshare --net)"
            return
        self.has_netem = self.shape(["netem", "delay", "1ms"]) is None
        if not self.has_netem:
            self.refusal = self.shape(self.narrow_line(8))
        self.end()

    def shape(self, how):
        """Returns the kernel's reason for a refusal, or None."""
        return run(["tc", "qdisc", "replace", "dev", "lo", "root", *how])

    def narrow_line(self, megabits):
        return ["tbf", "rate", f"{megabits}mbit", "burst", "64kbit", "latency", "30ms"]

    def strike(self):
        if self.has_netem:
            self.shape(["netem", "delay", f"{self.chance.randrange(1, 100)}ms", "10ms", "loss",
                        f"{self.chance.randrange(0, 20)}%"])
        else:
            self.shape(self.narrow_line(self.chance.choice([1, 2, 8])))
        time.sleep(self.chance.uniform(0.5, 2))
        self.end()

    def end(self):
        run(["tc", "qdisc", "del", "dev", "lo", "root"])


def run(command):
    """Returns the error output of a command that fails, or None."""
    environment = {**os.environ, "PATH": os.environ.get("PATH", "") + ":/usr/sbin:/sbin"}
    try:
        ended = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    except FileNotFoundError as error:
        return str(error)
    return ended.stderr.strip() or command[0] if ended.returncode != 0 else None


def listening_ports(pid):
    """Returns the TCP ports of 127.0.0.1 on which the process listens."""
    inodes = set()
    for descriptor in os.listdir(f"/proc/{pid}/fd"):
        try:
            target = os.readlink(f"/proc/{pid}/fd/{descriptor}")
        except OSError:
            continue
        if target.startswith("socket:["):
            inodes.add(target[8:-1])
    ports = []
    with open(f"/proc/{pid}/net/tcp", encoding="ascii") as table:
        for line in list(table)[1:]:
            words = line.split()
            if words[3] == "0A" and words[9] in inodes:
                ports.append(int(words[1].split(":")[1], 16))
    return ports


ATTACKS = [StartBehaviour, KillBehaviour, StopBehaviour, CreateSimulation, PressButtons, DestroySimulation, Record,
           StalledViewers, Noise, Flood, KillApplication, KillBroker, BadDisk, CutNetwork, BadNetwork]
