#!/usr/bin/env python3
"""Sends mutated GIOP requests to every servant of a real broker, server and behaviour.

usage: tests/giop/mutate.py BUILD [--seconds 60] [--seed 1] [--found FOLDER] [--prove]

First, the program sends a valid request of each operation of each interface in idl/ and of the
Trading Service, and checks the response (--prove does only this). Then, in rounds, it sends
mutated requests: it changes values, lengths, counts, TypeCodes, object keys, service contexts,
fragments, byte orders and versions. The seed determines these changes. The program checks these
promises:

- The programs continue to run, and each responds to a valid request after each round.
- At the end, every operation gives the same response as at the start, and memory, threads and
  descriptors have returned to their initial values.
- A lockstep simulation in the same server has the same result each time.
- All programs end normally on request. A build with AddressSanitizer then reports leaks.

If a program dies, the last messages before that are stored in FOLDER. For each promise that is not
kept, the program prints a sentence, and it exits with 1.
"""

import argparse
import collections
import http.client
import json
import random
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "chaos"))

from laboratory import Laboratory, Patience, enter_own_network, footprint_of  # noqa: E402
from witness import Witness, differences  # noqa: E402
from giop import Refused, read_reply  # noqa: E402
from mutations import mutant  # noqa: E402
from seeds import World, missing, prove  # noqa: E402

WORKERS = 6
OF_A_ROUND = 40  # messages that each worker sends in a round
ANSWER_S = 0.3   # time limit for the answer to a mutated request; a valid call has a minute
END_S = 60       # time limit for the end of a program


class Attack:
    def __init__(self, world, seed):
        self.world = world
        self.seed = seed
        self.sent = collections.Counter()
        self.answers = collections.Counter()
        self.last = collections.deque(maxlen=300)
        self.failure = None
        self.interfaces = sorted(world.targets)
        self.operations = {each: world.contracts.operations(each) for each in self.interfaces}
        world.names = sorted({operation.name for each in self.operations.values() for operation in each})

    def round(self, number):
        self.world.keys = [target.key for target in self.world.targets.values()]
        workers = [threading.Thread(target=self.work, args=(number, worker)) for worker in range(WORKERS)]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
        if self.failure:
            raise self.failure

    def work(self, number, worker):
        try:
            self.send_all(number, worker)
        except Exception as failure:  # a bug in this program
            self.failure = failure

    def send_all(self, number, worker):
        for count in range(OF_A_ROUND):
            chance = random.Random(f"{self.seed}:{number}:{worker}:{count}")
            interface = chance.choice(self.interfaces)
            operation = chance.choice(self.operations[interface])
            target = self.world.targets[interface]
            pieces = mutant(chance, self.world, target, operation)
            if any(b"start_recording" in piece and (b"/" in piece or b".." in piece) for piece in pieces):
                continue  # this operation would write a file to any path
            self.last.append((str(operation), target.port, [piece.hex() for piece in pieces]))
            self.sent[str(operation)] += 1
            self.answers[send(target, pieces, chance.random() < 0.8)] += 1


def send(target, pieces, is_last):
    """Sends a message. Returns the kind of response. `is_last` closes the sending side afterwards."""
    try:
        with socket.create_connection((target.host, target.port), timeout=5) as connection:
            for piece in pieces:
                connection.sendall(piece)
            if is_last:
                connection.shutdown(socket.SHUT_WR)
            connection.settimeout(ANSWER_S)
            header = connection.recv(4096)
            if not header:
                return "hung up"
            return read_reply(header)[0] if header[:4] == b"GIOP" else "no GIOP"
    except TimeoutError:
        return "nothing"
    except OSError:
        return "hung up"
    except Exception:  # the reply is longer than what was read
        return "long reply"


def processes_of(laboratory):
    return {"broker": laboratory.broker, "server": laboratory.server, "behaviour": laboratory.others[-1]}


def the_dead(laboratory):
    return [f"the {name} ended with {process.returncode}" for name, process in processes_of(laboratory).items()
            if process.poll() is not None]


def unanswered(world):
    """Returns sentences about programs that do not answer a valid call."""
    broken = []
    for interface, operation in (("sba::SimulationService", "list"), ("sba::AgentBehaviourFactory", "create"),
                                 ("CosTrading::Lookup", "_get_max_list")):
        try:
            world.call(interface, operation)
        except (Refused, OSError, EOFError, ValueError) as failure:
            broken.append(f"{interface}::{operation} is not answered rightly: {failure}")
    return broken


def after_round(laboratory, world, witness):
    """Returns sentences about promises that a round has broken, and prepares the next round."""
    try:
        broken = [*filter(None, [witness.look()])] + unanswered(world)
        if not broken:
            world.renew()
    except (Refused, OSError, EOFError, ValueError, http.client.HTTPException) as failure:
        broken = [f"the round's end: {type(failure).__name__} {failure}"]
    if broken:
        time.sleep(1)  # time for a core dump
    return the_dead(laboratory) + broken


def settle(laboratory, before, may_grow):
    patience = Patience("the return to what it was")
    while True:
        over = [sentence for name, process in processes_of(laboratory).items()
                for sentence in differences(name, before[name], footprint_of(process.pid), may_grow)]
        if not over or patience.is_over():
            return over
        patience.wait()


def attack(laboratory, options, report):
    witness = Witness(laboratory)
    laboratory.start_behaviour("giop", is_victim=False)
    world = World(laboratory)
    if broken := [*filter(None, [witness.run(1)])]:
        return broken
    world.renew()
    if broken := missing(world) + prove(world):
        return broken
    report["operations"] = sum(len(world.contracts.operations(each)) for each in world.targets)
    if options.prove:
        return []
    attack = Attack(world, options.seed)
    attack.round(0)  # so that memory that is allocated once does not count
    before = {name: footprint_of(process.pid) for name, process in processes_of(laboratory).items()}
    start = time.monotonic()
    number = 0
    while time.monotonic() - start < options.seconds:
        number += 1
        attack.round(number)
        if broken := after_round(laboratory, world, witness):
            options.found.mkdir(parents=True, exist_ok=True)
            (options.found / f"seed-{options.seed}-round-{number}.json").write_text(json.dumps(list(attack.last), indent=0))
            return broken
    report.update(rounds=number, sent=sum(attack.sent.values()), operations_sent=len(attack.sent),
                  answers=dict(attack.answers), witness_rounds=witness.rounds, before=before)
    broken = [*filter(None, [witness.run(1)])] + prove(world)
    for name in laboratory.simulations():
        if name not in world.simulations:
            laboratory.destroy(name)
    broken += settle(laboratory, before, is_asan(options.build))
    report["after"] = {name: footprint_of(process.pid) for name, process in processes_of(laboratory).items()}
    return broken + end_in_order(laboratory)


def end_in_order(laboratory):
    """Returns sentences about programs that do not end normally. With AddressSanitizer, leaks are a reason."""
    broken = []
    for name, process in reversed(processes_of(laboratory).items()):
        process.terminate()
        try:
            code = process.wait(END_S)
        except subprocess.TimeoutExpired:
            code = "nothing yet"
        if code != 0:
            broken.append(f"the {name} was told to end, and ended with {code}")
    return broken


def is_asan(build):
    return b"__asan_init" in (build / "bin" / "gsv").read_bytes()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--found", type=Path, help="where the last messages before a death go; BUILD/giop")
    parser.add_argument("--prove", action="store_true", help="send right requests only")
    options = parser.parse_args()
    enter_own_network()
    options.build = options.build.resolve()
    options.found = options.found or options.build / "giop"
    folder = Path(tempfile.mkdtemp(prefix="gsv-giop-"))
    laboratory = Laboratory(options.build, folder, serve=["--scenarios", "2"])
    report, broken = {"seed": options.seed}, ["it came to no end"]
    try:
        broken = attack(laboratory, options, report)
        print(json.dumps({**report, "broken": broken}, indent=1), flush=True)
    finally:
        laboratory.close()
        if broken:
            print(f"the programs' output is in {folder}", file=sys.stderr)
        else:
            shutil.rmtree(folder, ignore_errors=True)
    for sentence in broken:
        print(f"broken: {sentence}", file=sys.stderr)
    return 1 if broken else 0


sys.exit(main())
