// What a person may do in each phase of a simulation. The server has the last word.
import type { Action } from "../api/SimulationApi";
import type { Phase, RobotStatus } from "../api/status";
import type { State } from "./State";
import { mayAct } from "./people";

const ALLOWED: Record<Phase, readonly Action[]> = {
  created: ["start", "step", "stop", "reset"],
  starting: ["pause", "stop", "reset"],
  running: ["pause", "stop", "reset"],
  paused: ["resume", "step", "stop", "reset"],
  stopped: ["reset"],
  finished: ["reset"],
  failed: ["reset"],
};

export function isAllowed(phase: Phase | undefined, action: Action): boolean {
  return phase !== undefined && ALLOWED[phase].includes(action);
}

// Whether anything can be asked of the server now.
export function canAct({ connection, pending, people }: State): boolean {
  return connection.phase === "open" && pending === null && mayAct(people);
}

// Whether the simulation can be edited; one that runs is paused first.
export function canEdit({ abilities, replay, status, setUp, people }: State): boolean {
  const phase = status?.phase;
  return (
    abilities.creates &&
    mayAct(people) &&
    replay === null &&
    setUp === null &&
    (phase === "created" || phase === "paused" || phase === "running")
  );
}

// The one action that the main button stands for: what makes it run, or stand still.
export function mainAction(phase: Phase | undefined): "start" | "pause" | "resume" {
  if (phase === "running" || phase === "starting") return "pause";
  return phase === "paused" ? "resume" : "start";
}

const SENTENCES: Record<Phase, string> = {
  created: "Ready to start",
  starting: "Starting",
  running: "Running",
  paused: "Paused",
  stopped: "Stopped",
  finished: "Finished",
  failed: "Failed",
};

export function phaseLabel(phase: Phase): string {
  return SENTENCES[phase];
}

// What a robot's agent does, in words.
export function agentLabel({ agentPhase, behaviour }: Pick<RobotStatus, "agentPhase" | "behaviour">): string {
  if (agentPhase === "none") return behaviour ? "not started" : "idle";
  return agentPhase;
}
