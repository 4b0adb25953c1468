// The actions that a viewer may request in each phase of a simulation. The server decides whether
// to perform them.
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

// Whether requests to the server are possible now.
export function canAct({ connection, pending, people }: State): boolean {
  return connection.phase === "open" && pending === null && mayAct(people);
}

// Whether the simulation can be edited. A running simulation is paused first.
export function canEdit({ abilities, connection, replay, status, setUp, people }: State): boolean {
  const phase = status?.phase;
  return (
    abilities.creates &&
    connection.phase === "open" &&
    mayAct(people) &&
    replay === null &&
    setUp === null &&
    (phase === "created" || phase === "paused" || phase === "running")
  );
}

// The action of the main button: run or pause.
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

// The state of a robot's agent, in words.
export function agentLabel({ agentPhase, behaviour }: Pick<RobotStatus, "agentPhase" | "behaviour">): string {
  if (agentPhase === "none") return behaviour ? "not started" : "idle";
  return agentPhase;
}
