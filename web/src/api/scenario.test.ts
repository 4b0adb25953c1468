import { expect, test } from "vitest";
import { EMPTY_SCENARIO, findRobot, freeName, newRobot, parseScenario, scenarioJson } from "./scenario";
import { newPedestrians } from "./pedestrians";
import { withChangedRobot, withRobot, withoutRobot } from "./scenario";
import { changed, redone, robotOfField, undone } from "../state/setUp";
import type { SetUp } from "../state/setUp";

const pebble = newRobot(EMPTY_SCENARIO, "pebble");
const placed = { ...pebble, place: { x: 1, y: -2, yaw: 0.5 }, behaviour: "wander" };
const scenario = {
  ...EMPTY_SCENARIO,
  world: "office",
  mode: "lockstep" as const,
  duration: 60,
  seed: 7,
  record: true,
  robots: [placed, { ...pebble, name: "second", constraint: "pid > 0", movement: "rigid" as const, drive: "skid" }],
  avatars: [newRobot(EMPTY_SCENARIO, "avatar")],
  pedestrians: [newPedestrians([])],
};

test("a scenario's JSON omits defaults", () => {
  expect(scenarioJson({ ...EMPTY_SCENARIO, world: "maze" })).toEqual({ world: "maze" });
  expect(scenarioJson(scenario)).toEqual({
    world: "office",
    mode: "lockstep",
    duration: 60,
    seed: 7,
    record: true,
    robots: [
      { name: "pebble", model: "pebble", x: 1, y: -2, yaw: 0.5, behaviour: "wander" },
      { name: "second", model: "pebble", behaviour_constraint: "pid > 0", movement: "rigid", drive: "skid" },
    ],
    avatars: [{ name: "avatar", model: "avatar" }],
    pedestrians: [
      {
        name: "pedestrian",
        count: 5,
        route: [
          { x: -3, y: 0, radius: 1 },
          { x: 3, y: 0, radius: 1 },
        ],
      },
    ],
  });
});

test("a saved file is loaded unchanged", () => {
  const text = JSON.stringify(scenarioJson(scenario));
  expect(parseScenario(JSON.parse(text))).toEqual({ scenario, left: [] });
});

test("unknown keys are listed, and an invalid scenario is rejected with the place", () => {
  expect(parseScenario({ world: "maze", faults: [], expect: {} }).left).toEqual(["faults", "expect"]);
  expect(() => parseScenario([])).toThrow("the file: expected an object, found a list");
  expect(() => parseScenario({ robots: {} })).toThrow("robots: expected a list, found an object");
  expect(() => parseScenario({ robots: ["x"] })).toThrow("robots[0]: expected an object, found a string");
});

test("a robot is named after its model, with a number if the name is taken", () => {
  expect(freeName(EMPTY_SCENARIO, "models/burger.sdf")).toBe("burger");
  const two = withRobot(withRobot(EMPTY_SCENARIO, "robots", pebble), "avatars", { ...pebble, name: "pebble_2" });
  expect(freeName(two, "pebble")).toBe("pebble_3");
  expect(findRobot(two, "pebble_2")).toEqual({ list: "avatars", index: 0 });
  expect(findRobot(two, "nobody")).toBeNull();
});

test("functions on lists do not modify their arguments", () => {
  const before = withRobot(EMPTY_SCENARIO, "robots", pebble);
  const after = withChangedRobot(before, "robots", 0, { name: "other" });
  expect(after.robots[0]!.name).toBe("other");
  expect(before.robots[0]!.name).toBe("pebble");
  expect(withoutRobot(after, "robots", 0).robots).toEqual([]);
});

test("changes can be undone and redone until there is another change", () => {
  const step = (seed: number) => ({ ...EMPTY_SCENARIO, seed });
  let setUp = { scenario: step(0), past: [], future: [] } as unknown as SetUp;
  setUp = changed(changed(setUp, step(1)), step(2));
  setUp = undone(undone(setUp));
  expect(setUp.scenario.seed).toBe(0);
  expect(undone(setUp)).toBe(setUp);
  setUp = redone(setUp);
  expect(setUp.scenario.seed).toBe(1);
  setUp = changed(setUp, step(5));
  expect(redone(setUp)).toBe(setUp);
  expect(undone(setUp).scenario.seed).toBe(1);
});

test("a field that the server names is found in its robot's row", () => {
  expect(robotOfField("robots[12].model")).toEqual({ list: "robots", index: 12, input: "model" });
  expect(robotOfField("avatars[0]")).toEqual({ list: "avatars", index: 0, input: "" });
  expect(robotOfField("robots[0].wings")).toEqual({ list: "robots", index: 0, input: "" });
  expect(robotOfField("world")).toBeNull();
});
