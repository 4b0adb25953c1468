// @vitest-environment jsdom
import { expect, test } from "vitest";
import type { SimulationStatus } from "../../api/status";
import type { Health, RobotHealth } from "../../state/health";
import { testPorts } from "../contract/testPorts";
import { createOutput } from "./Output";
import { createWhy } from "./Why";

const STUCK: RobotHealth = {
  robot: "a",
  state: "stuck",
  level: 1,
  since: 10,
  command: { linear: 0.3, lateral: 0, angular: 0 },
  actual: { linear: 0, angular: 0 },
  limit: { sensor: "sonar_00", value: 0.26, unit: "m" },
  contact: "",
  summary: "is stuck",
  reason: "commanded 0.30 m/s, sonar_00 reads 0.26 m",
};
const HEALTH: Health = { time: 30, stuckAfter: 5, robots: new Map([["a", STUCK]]) };
const ROBOTS = ["a", "b"].map((name) => ({ name, behaviour: "wander", agentPhase: "running", collisions: 0, distance: 0, detail: "", model: "" }));
const STATE = { status: { robots: ROBOTS } as unknown as SimulationStatus, health: HEALTH, selection: "a", time: 30 };

test("the selected robot's sentence, command, motion and limit are shown", () => {
  const { ports, store } = testPorts(STATE);
  const why = createWhy(ports);
  expect(why.querySelector(".why-sentence")!.textContent).toBe("is stuck for 20 s: commanded 0.30 m/s, sonar_00 reads 0.26 m");
  const rows = () =>
    [...why.querySelectorAll<HTMLElement>("dt")].filter(({ hidden }) => !hidden).map((term) => `${term.textContent}: ${term.nextElementSibling!.textContent}`);
  expect(rows()).toEqual(["Commanded: 0.30 m/s", "Actual: 0", "Nearest obstacle: sonar_00 reads 0.260 m", "Since: 0:10.00"]);
  const close = { ...STUCK, limit: { sensor: "lidar", value: -Infinity, unit: "m" } };
  store.set({ health: { ...HEALTH, robots: new Map([["a", close]]) } });
  expect(rows()).toContain("Nearest obstacle: lidar reads less than its minimum range");
  store.set({ selection: "b" });
  expect(why.querySelector(".why-sentence")!.textContent).toBe("moving");
  expect(rows()).toEqual([]);
  store.set({ health: null });
  expect(why.hidden).toBe(true);
});

const said = (name: string, sec: number, msg: string, level = 20) => ({ stamp: { sec, nsec: 0 }, level, name, msg });

test("only its behaviour's output is shown, with the past lines first", async () => {
  const output = async () => [{ time: 5, level: 20, text: "hello" }];
  const { ports, topics } = testPorts(STATE, { output });
  const made = createOutput(ports);
  await Promise.resolve();
  await Promise.resolve();
  await new Promise((resolve) => setTimeout(resolve));
  topics.send("/gsv/output", said("a", 5, "hello"));
  topics.send("/gsv/output", said("a", 6, "ZeroDivisionError", 40));
  topics.send("/gsv/output", said("c", 7, "not mine"));
  const lines = [...made.querySelectorAll(".output-lines > div")];
  expect(lines.map(({ textContent }) => textContent)).toEqual(["hello", "ZeroDivisionError"]);
  expect(lines[1]!.className).toBe("error");
  expect(made.hidden).toBe(false);
});

test("the output of another robot replaces it, and is hidden without lines", async () => {
  const { ports, store, topics } = testPorts(STATE);
  const made = createOutput(ports);
  await new Promise((resolve) => setTimeout(resolve));
  topics.send("/gsv/output", said("a", 6, "x"));
  store.set({ selection: "b" });
  await new Promise((resolve) => setTimeout(resolve));
  expect(made.hidden).toBe(true);
  store.set({ selection: null });
  expect(topics.read).toEqual([]);
});
