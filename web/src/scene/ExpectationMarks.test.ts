import { expect, test } from "vitest";
import type { Expectation } from "../state/expectations";
import { ExpectationMarks } from "./ExpectationMarks";

const NONE: Expectation = {
  name: "a",
  yaml: "",
  where: "",
  verdict: "pending",
  margin: null,
  time: 0,
  detail: "",
  bodies: [],
  places: [],
  boxes: [],
};

test("a goal is a circle and a zone a box on the floor", () => {
  const marks = new ExpectationMarks(true);
  marks.set([NONE]);
  expect(marks.lines.visible).toBe(false);
  marks.set([{ ...NONE, boxes: [[0, 2, -1, 1]] }]);
  expect(marks.segments).toBe(4);
  marks.set([{ ...NONE, boxes: [[-3, 0.15, -Infinity, Infinity]] }]);
  const lines = marks.lines.geometry.getAttribute("position").array.slice(0, 24);
  expect(lines.every(Number.isFinite)).toBe(true);
  marks.set([{ ...NONE, places: [[1, 2, 0.5]] }]);
  expect(marks.segments).toBe(48);
  expect(marks.lines.visible).toBe(true);
  const points = marks.lines.geometry.getAttribute("position").array;
  for (let i = 0; i < marks.segments * 6; i += 3) {
    expect(Math.hypot(points[i]! - 1, points[i + 1]! - 2)).toBeCloseTo(0.5, 5);
  }
  marks.set([]);
  expect(marks.lines.visible).toBe(false);
});
