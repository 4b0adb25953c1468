import { expect, test } from "vitest";
import type { RobotHealthMessage } from "../protocol/messages";
import { healthOf, motionText, sentenceOf, stateOf } from "./health";

const AT = (sec: number) => ({ sec, nsec: 0 });

export function told(robot: string, more: Partial<RobotHealthMessage> = {}): RobotHealthMessage {
  return {
    robot,
    state: "stuck",
    level: 1,
    since: AT(10),
    command_linear_m_s: 0.3,
    command_lateral_m_s: 0,
    command_angular_rad_s: 0,
    linear_m_s: 0,
    angular_rad_s: 0,
    limit_sensor: "sonar_00",
    limit_value: 0.26,
    limit_unit: "m",
    contact: "",
    summary: "has not moved",
    reason: "commanded 0.3 m/s, sonar_00 reads 0.26 m",
    ...more,
  };
}

function health(...robots: RobotHealthMessage[]) {
  const counts = { moving: 1, standing: 0, stuck: 1, contact: 0, dead: 0, late: 0 };
  return healthOf({ stamp: AT(30), step: 3000n, stuck_after_s: 5, ...counts, robots });
}

test("a robot that the health report does not list is shown as moving", () => {
  const known = health(told("a"));
  expect(stateOf(known, { name: "a", agentPhase: "running" })).toBe("stuck");
  expect(stateOf(known, { name: "b", agentPhase: "running" })).toBe("moving");
});

test("standing with a command is a separate state", () => {
  const known = health(told("a", { state: "standing" }), told("b", { state: "standing", command_linear_m_s: 0 }));
  expect(known.robots.get("a")!.state).toBe("told");
  expect(known.robots.get("b")!.state).toBe("standing");
});

test("without a report, only the behaviour's state is known", () => {
  expect(stateOf(null, { name: "a", agentPhase: "running" })).toBe("unknown");
  expect(stateOf(null, { name: "a", agentPhase: "dead" })).toBe("dead");
});

test("the sentence has the state, the duration and the reason", () => {
  const robot = health(told("a")).robots.get("a")!;
  expect(sentenceOf(robot, 30)).toBe("has not moved for 20 s: commanded 0.3 m/s, sonar_00 reads 0.26 m");
  expect(sentenceOf(robot, 135)).toContain("for 2 min 5 s");
  expect(sentenceOf({ ...robot, reason: "" }, 10)).toBe("has not moved");
  expect(sentenceOf({ ...robot, summary: "" }, 30)).toBe("");
});

test("motion has units", () => {
  expect(motionText(0, 0)).toBe("0");
  expect(motionText(0.3, -0.5)).toBe("0.30 m/s, -0.50 rad/s");
  expect(motionText(0, 0, 0.1)).toBe("0.10 m/s sideways");
});
