// The status of a simulation. HTTP responses (JSON) and messages of the live stream are both
// converted to this structure.
import type { SimulationStatusMessage } from "../protocol/messages";
import { seconds } from "../protocol/messages";
import type { JsonObject } from "./json";
import { listAt, numberOr, objectAt, textAt, textOr } from "./json";
import type { Replay } from "./replay";
import { parseReplay } from "./replay";

export const PHASES = ["created", "starting", "running", "paused", "stopped", "finished", "failed"] as const;
export type Phase = (typeof PHASES)[number];

export interface RobotStatus {
  name: string;
  model: string;
  behaviour: string; // empty if the robot has no behaviour
  agentPhase: string;
  detail: string;
  distance: number; // m
  collisions: number;
}

export interface SimulationStatus {
  phase: Phase;
  mode: "real_time" | "lockstep";
  step: number;
  time: number; // s, simulated
  targetFactor: number;
  realTimeFactor: number;
  lateSteps: number;
  // The robot that the simulation waits for, such as "robot_3 (wander on host:pid) since 2.1 s";
  // empty if the simulation waits for no robot.
  waitingFor: string;
  // Why the simulation failed; empty if it has not failed. Only HTTP responses report it, and not
  // the live stream.
  failure: string;
  robots: RobotStatus[];
  // Null if this is not a replay. Only HTTP responses report it, and not the live stream.
  replay: Replay | null;
}

export interface SimulationSummary {
  name: string;
  phase: Phase;
  robots: number;
}

export function parseStatus(json: unknown): SimulationStatus {
  const status = objectAt(json, "status");
  return {
    phase: phaseOf(status.phase),
    mode: modeOf(status.mode),
    step: numberOr(status.step, 0),
    time: numberOr(status.time_s, 0),
    targetFactor: numberOr(status.target_factor, 1),
    realTimeFactor: numberOr(status.real_time_factor, 0),
    lateSteps: numberOr(status.late_steps, 0),
    waitingFor: textOr(status.waiting_for, ""),
    failure: textOr(status.failure, ""),
    robots: listAt(status.robots ?? [], "robots").map((robot, i) =>
      parseRobot(objectAt(robot, `robots[${i}]`)),
    ),
    replay: status.replay === undefined ? null : parseReplay(status.replay),
  };
}

export function statusFromMessage(message: SimulationStatusMessage): SimulationStatus {
  return {
    phase: phaseOf(message.state),
    mode: modeOf(message.mode),
    step: Number(message.step),
    time: seconds(message.stamp),
    targetFactor: message.target_factor,
    realTimeFactor: message.real_time_factor,
    lateSteps: Number(message.late_steps),
    waitingFor: message.waiting_for,
    failure: "",
    robots: message.robots.map((robot) => ({
      name: robot.name,
      model: robot.model,
      behaviour: robot.behaviour,
      agentPhase: robot.agent_state,
      detail: robot.detail,
      distance: robot.distance_m,
      collisions: Number(robot.collisions),
    })),
    replay: null,
  };
}

export function parseSummaries(json: unknown): SimulationSummary[] {
  return listAt(json, "simulations").map((each, i) => {
    const summary = objectAt(each, `simulations[${i}]`);
    return {
      name: textAt(summary.name, `simulations[${i}].name`),
      phase: phaseOf(summary.phase),
      robots: numberOr(summary.robots, 0),
    };
  });
}

function parseRobot(robot: JsonObject): RobotStatus {
  return {
    name: textAt(robot.name, "robot.name"),
    model: textOr(robot.model, ""),
    behaviour: textOr(robot.behaviour, ""),
    agentPhase: textOr(robot.agent_phase, "none"),
    detail: textOr(robot.detail, ""),
    distance: numberOr(robot.distance_m, 0),
    collisions: numberOr(robot.collisions, 0),
  };
}

function phaseOf(value: unknown): Phase {
  const phase = PHASES.find((each) => each === value);
  if (!phase) throw new Error(`phase: expected one of ${PHASES.join(", ")}, found ${String(value)}`);
  return phase;
}

function modeOf(value: unknown): SimulationStatus["mode"] {
  return value === "lockstep" ? "lockstep" : "real_time";
}
