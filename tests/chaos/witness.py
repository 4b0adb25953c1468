"""Checks what no attack may change: the result of a simulation, and the resources of the server."""

import json

from laboratory import MEMORY_SLACK_MIB, SLACK, Patience

WITNESS = {"name": "witness", "world": "playground", "mode": "lockstep", "seed": 7, "duration": 4,
           "robots": [{"name": f"w{i}", "model": "pebble", "x": x, "y": -1.5, "behaviour": "witness"}
                      for i, x in enumerate((-1.0, 0.0, 1.0))]}


class Witness:
    """Repeats one simulation, and compares its results."""

    def __init__(self, laboratory):
        self.laboratory = laboratory
        laboratory.start_behaviour("witness", is_victim=False)
        laboratory.create(WITNESS)
        self.rounds = 0
        self.expected = None
        self.is_running = False

    def look(self):
        """Returns a sentence if the result differs, else None. Sends at most two requests."""
        if not self.is_running:
            self.laboratory.press("witness", "start")
            self.is_running = True
            return None
        status = self.laboratory.status("witness")
        if status["phase"] == "failed":
            return f"the witness failed: {status['failure']}"
        if status["phase"] != "finished":
            return None
        outcome = json.dumps([status["step"], [[robot["pose"], robot["distance_m"], robot["collisions"]]
                                               for robot in status["robots"]]])
        self.laboratory.press("witness", "reset")
        self.is_running = False
        self.rounds += 1
        if self.expected is None:
            self.expected = outcome
        return None if outcome == self.expected else f"the witness did\n{outcome}\ninstead of\n{self.expected}"

    def run(self, rounds):
        patience = Patience("the witness's run")
        until = self.rounds + rounds
        broken = None
        while self.rounds < until and broken is None:
            broken = self.look()
            patience.wait()
        return broken


def differences(name, before, now, may_grow=False):
    """Returns sentences about resources that a process did not release. With `may_grow`, memory is ignored."""
    over = [f"{name}: {now[kind]} {kind} instead of {before[kind]}" for kind in ("threads", "descriptors")
            if now[kind] > before[kind] + SLACK]
    if not may_grow and now["memory_mib"] > before["memory_mib"] + MEMORY_SLACK_MIB:
        over.append(f"{name}: {now['memory_mib']} MiB instead of {before['memory_mib']}")
    return over
