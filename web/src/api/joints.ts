// The joints of a body: their limits, their state, and their commands (docs/api.yaml).
import { listAt, numberAt, numberOr, objectAt, textAt, textOr } from "./json";

export const COMMAND_KINDS = ["position", "velocity", "effort"] as const;
export type JointCommandKind = (typeof COMMAND_KINDS)[number];

export interface Joint {
  name: string;
  kind: string; // "revolute", "continuous", "prismatic" or "screw"
  unit: "rad" | "m"; // unit of the position and of its limits
  position: number;
  velocity: number; // in the position's unit per second
  minimum: number; // infinite if there is no limit
  maximum: number;
  maxVelocity: number;
  maxEffort: number; // unit: N m or N
  command: { kind: JointCommandKind; value: number } | null; // the latest command; null: none
  refusal: string; // why the joint accepts no commands; empty if it accepts commands
}

// The joints of one body, at one instant.
export interface BodyJoints {
  time: number; // s, simulated
  joints: Joint[];
  refusal: string; // why no joint of the body accepts commands from viewers; empty if the joints accept them
}

export function parseJoints(json: unknown): BodyJoints {
  const body = objectAt(json, "joints");
  return {
    time: numberAt(body.time_s, "time_s"),
    joints: listAt(body.joints, "joints").map((each, i) => parseJoint(each, `joints[${i}]`)),
    refusal: textOr(body.refusal, ""),
  };
}

function parseJoint(json: unknown, where: string): Joint {
  const joint = objectAt(json, where);
  const command = joint.command === undefined ? {} : objectAt(joint.command, `${where}.command`);
  const kind = COMMAND_KINDS.find((each) => typeof command[each] === "number");
  return {
    name: textAt(joint.name, `${where}.name`),
    kind: textAt(joint.kind, `${where}.kind`),
    unit: joint.unit === "m" ? "m" : "rad",
    position: numberAt(joint.position, `${where}.position`),
    velocity: numberAt(joint.velocity, `${where}.velocity`),
    minimum: numberOr(joint.minimum, -Infinity),
    maximum: numberOr(joint.maximum, Infinity),
    maxVelocity: numberOr(joint.max_velocity, Infinity),
    maxEffort: numberOr(joint.max_effort, Infinity),
    command: kind === undefined ? null : { kind, value: command[kind] as number },
    refusal: textOr(joint.refusal, ""),
  };
}
