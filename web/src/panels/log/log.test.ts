import { expect, test } from "vitest";
import type { LogLine } from "./log";
import { MOST_LINES, NO_LOG, countUntil, levelWord, shownLines, withLine } from "./log";

function line(time: number, text: string, more: Partial<LogLine> = {}): LogLine {
  return { time, level: 20, name: "gsv", text, ...more };
}

test("a line is added once, even if the stream repeats it", () => {
  let lines: readonly LogLine[] = [];
  for (const each of [line(0, "started"), line(1, "paused"), line(0, "started")]) lines = withLine(lines, each);
  expect(lines.map(({ text }) => text)).toEqual(["started", "paused"]);
  expect(withLine(lines, line(1, "paused", { name: "a" }))).toHaveLength(3);
});

test("the oldest are removed if there are too many", () => {
  let lines: readonly LogLine[] = [];
  for (let i = 0; i < MOST_LINES + 3; i++) lines = withLine(lines, line(i, "x"));
  expect(lines).toHaveLength(MOST_LINES);
  expect(lines[0]!.time).toBe(3);
});

test("lines are filtered by level and by text, in any field and case", () => {
  const lines = [line(0, "Started"), line(1, "dead", { level: 40, name: "pebble_1" }), line(2, "x", { level: 30 })];
  const shown = (more: object) => shownLines({ ...NO_LOG, lines, ...more }).map(({ time }) => time);
  expect(shown({})).toEqual([0, 1, 2]);
  expect(shown({ lowest: 30 })).toEqual([1, 2]);
  expect(shown({ lowest: 40 })).toEqual([1]);
  expect(shown({ filter: " start " })).toEqual([0]);
  expect(shown({ filter: "PEBBLE" })).toEqual([1]);
  expect(shown({ filter: "started", lowest: 30 })).toEqual([]);
});

test("lines before and after an instant are distinguished", () => {
  const lines = [line(0, "a"), line(1, "b"), line(1, "c"), line(2, "d")];
  expect([-1, 0, 0.5, 1, 3].map((time) => countUntil(lines, time))).toEqual([0, 1, 1, 3, 4]);
});

test("levels have names", () => {
  expect([10, 20, 30, 40, 50].map(levelWord)).toEqual(["debug", "info", "warning", "error", "error"]);
});
