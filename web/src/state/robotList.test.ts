import { expect, test } from "vitest";
import type { ShownState } from "./health";
import type { Entry, ListedRobot, RobotFilter } from "./robotList";
import { NO_FILTER, entriesOf, isTitle, namespaceOf, queryOf } from "./robotList";

function robot(name: string, state: ShownState = "moving", more: Partial<ListedRobot["status"]> = {}): ListedRobot {
  const status = { name, model: "pebble", behaviour: "wander", agentPhase: "running", detail: "", distance: 0, collisions: 0, ...more };
  return { status, kind: "robot", state, health: null };
}

function texts(entries: Entry[]): string[] {
  return entries.map((entry) => (isTitle(entry) ? `${entry.title} (${entry.count})` : entry.status.name));
}

const listed = (robots: ListedRobot[], change: Partial<RobotFilter> = {}) => texts(entriesOf(robots, { ...NO_FILTER, ...change }));

test("the worst come first, and equal ones in natural order of names", () => {
  const robots = [robot("a10"), robot("a2"), robot("c", "stuck"), robot("d", "dead"), robot("e", "contact"), robot("b", "stuck")];
  expect(listed(robots)).toEqual(["d", "b", "c", "e", "a2", "a10"]);
  expect(listed(robots, { sorting: "name" })).toEqual(["a2", "a10", "b", "c", "d", "e"]);
});

test("a station is not worse than a moving robot", () => {
  const post: ListedRobot = { ...robot("a", "unknown"), kind: "station" };
  expect(listed([post, robot("b")])).toEqual(["b", "a"]);
});

test("robots with the largest distance, or the most collisions, come first", () => {
  const robots = [robot("a", "moving", { distance: 1, collisions: 9 }), robot("b", "moving", { distance: 2 })];
  expect(listed(robots, { sorting: "distance" })).toEqual(["b", "a"]);
  expect(listed(robots, { sorting: "collisions" })).toEqual(["a", "b"]);
});

test("a search supports words, fields and regular expressions", () => {
  const robots = [robot("yard/a1"), robot("yard/b2", "stuck"), robot("hall/a3", "moving", { model: "scout", behaviour: "dock" })];
  const found = (text: string) => listed(robots, { text, sorting: "name" });
  expect(found("")).toHaveLength(3);
  expect(found(" A ")).toEqual(["hall/a3", "yard/a1", "yard/b2"]);
  expect(found("yard a1")).toEqual(["yard/a1"]);
  expect(found("model:scout")).toEqual(["hall/a3"]);
  expect(found("ns:yard state:stuck")).toEqual(["yard/b2"]);
  expect(found("behaviour:dock")).toEqual(["hall/a3"]);
  expect(found("/a\\d$/")).toEqual(["hall/a3", "yard/a1"]);
  expect(found("model:/^peb/")).toEqual(["yard/a1", "yard/b2"]);
  expect(found("nobody")).toEqual([]);
});

test("invalid parts of a search are reported, and the rest applies", () => {
  expect(queryOf("a model:b").problem).toBe("");
  expect(queryOf("colour:red").problem).toContain("Unknown field colour");
  expect(queryOf("/[/").problem).toBe("/[/ is not a regular expression.");
  expect(queryOf("colour:red a").test(robot("b"))).toBe(false);
});

test("one state can be shown only", () => {
  expect(listed([robot("a"), robot("b", "stuck")], { state: "stuck" })).toEqual(["b"]);
});

test("groups have titles, and the one with the first robot comes first", () => {
  const robots = [robot("yard_1"), robot("yard_2", "stuck"), robot("hall_1")];
  expect(listed(robots, { grouping: "namespace" })).toEqual(["yard (2)", "yard_2", "yard_1", "hall (1)", "hall_1"]);
  expect(listed(robots, { grouping: "state" })).toEqual(["stuck (1)", "yard_2", "moving (2)", "hall_1", "yard_1"]);
  expect(listed(robots, { grouping: "model" })).toEqual(["pebble (3)", "yard_2", "hall_1", "yard_1"]);
});

test("a namespace ends before the last slash, or before a number", () => {
  expect(["a/b/c1", "pebble_12", "pebble", "r2d2", "7"].map(namespaceOf)).toEqual(["a/b", "pebble", "pebble", "r2d", ""]);
});
