// The wall-clock time of steps over the last seconds (/gsv/step_costs), by part and by behaviour.
import type { SimulationStatus } from "../../api/status";
import { formatFactor } from "../../ui/format";

export const PARTS = [
  { key: "behaviours_s", label: "Behaviours", hint: "running the code of behaviours; in lockstep, also waiting for behaviours" },
  { key: "devices_s", label: "Devices", hint: "actuators, radios and other devices" },
  { key: "bodies_s", label: "Bodies", hint: "motion and contacts" },
  { key: "observers_s", label: "Observers", hint: "recording and viewers" },
  { key: "idle_s", label: "Idle", hint: "waiting until the next step is due, in real-time mode" },
] as const;
export type Part = (typeof PARTS)[number]["key"];

// The time that one step took, by part.
export interface StepCost extends Record<Part, number> {
  step: bigint;
  held_up_by: string;
}

export interface StepCostsMessage {
  steps: bigint;
  sum: StepCost;
  hold_ups: { robot: string; steps: bigint; total_s: number; longest_s: number }[];
  longest: StepCost[];
}

// A behaviour that delayed steps.
export interface HoldUp {
  robot: string;
  steps: number;
  total: number; // s
  longest: number; // s
}

const KEPT_MESSAGES = 10; // five seconds of wall-clock time
const SLOW = 0.95; // a run below this fraction of its target factor is slower than its target
const LARGE = 0.5; // if a part takes this fraction of the busy time, the page names it as the reason

export class StepCosts {
  private messages: StepCostsMessage[] = [];

  add(message: StepCostsMessage): void {
    this.messages = [...this.messages, message].slice(-KEPT_MESSAGES);
  }

  clear(): void {
    this.messages = [];
  }

  get steps(): number {
    return this.messages.reduce((sum, { steps }) => sum + Number(steps), 0);
  }

  // Returns the wall-clock time of this part, in seconds.
  of(part: Part): number {
    return this.messages.reduce((total, { sum }) => total + sum[part], 0);
  }

  // The time of all parts, except waiting for the next step.
  get busy(): number {
    return PARTS.reduce((sum, { key }) => (key === "idle_s" ? sum : sum + this.of(key)), 0);
  }

  get holdUps(): HoldUp[] {
    const found = new Map<string, HoldUp>();
    for (const { robot, steps, total_s, longest_s } of this.messages.flatMap(({ hold_ups }) => hold_ups)) {
      const known = found.get(robot) ?? { robot, steps: 0, total: 0, longest: 0 };
      known.steps += Number(steps);
      known.total += total_s;
      known.longest = Math.max(known.longest, longest_s);
      found.set(robot, known);
    }
    return [...found.values()].sort((a, b) => b.total - a.total);
  }

  // Returns at most `most` steps: those with the longest busy time, ordered by step number.
  longest(most: number): StepCost[] {
    const all = this.messages.flatMap(({ longest }) => longest);
    const chosen = [...all].sort((a, b) => busyTime(b) - busyTime(a)).slice(0, most);
    return chosen.sort((a, b) => (a.step < b.step ? -1 : 1));
  }
}

export function busyTime(cost: StepCost): number {
  return PARTS.reduce((sum, { key }) => (key === "idle_s" ? sum : sum + cost[key]), 0);
}

type Pace = Pick<SimulationStatus, "mode" | "phase" | "targetFactor" | "realTimeFactor">;

// Returns a sentence about what limits the speed of the run, and how the user can change this.
export function paceSentence({ mode, phase, targetFactor, realTimeFactor }: Pace, costs: StepCosts): string {
  if (phase !== "running") return "The simulation is not running. Start or resume it to measure its steps.";
  if (costs.steps === 0) return "No step yet.";
  const isSlow = mode === "real_time" && realTimeFactor < SLOW * targetFactor;
  if (mode === "real_time" && !isSlow) return "The simulation runs at its target speed.";
  const pace = isSlow
    ? `The simulation runs at ${formatFactor(realTimeFactor)} real time, not at the target ${formatFactor(targetFactor)}.`
    : `Lockstep: the simulation runs as fast as its steps allow, at ${formatFactor(realTimeFactor)} real time.`;
  return `${pace} ${reason(costs)}`;
}

function reason(costs: StepCosts): string {
  const { busy } = costs;
  const share = (part: Part) => costs.of(part) / Math.max(busy, 1e-12);
  const percent = (part: Part) => `${Math.round(100 * share(part))} % of the time`;
  const [first] = costs.holdUps;
  if (costs.of("idle_s") > busy) return "The steps themselves are fast. Other programs on this machine delay the steps.";
  if (share("behaviours_s") >= LARGE) {
    const name = first ? `the behaviour of ${first.robot}` : "the behaviours";
    return `Behaviours take ${percent("behaviours_s")}, most of all ${name}.`;
  }
  if (share("bodies_s") >= LARGE) {
    return `Motion and contacts take ${percent("bodies_s")}. A larger step, fewer bodies or planar kinematics would be faster.`;
  }
  if (share("observers_s") >= LARGE) return `Recording and viewers take ${percent("observers_s")}. Record fewer topics.`;
  if (share("devices_s") >= LARGE) return `Actuators and radios take ${percent("devices_s")}.`;
  return "No part takes more than half of the time.";
}
