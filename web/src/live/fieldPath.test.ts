import { expect, test } from "vitest";
import { fieldAt, numberAt, parsePath, pathOf } from "./fieldPath";

test("a path selects its field", () => {
  const message = { status: { robots: [{ x: 1 }, { x: 2.5, on: true }] }, stamp: { sec: 3, nsec: 500_000_000 }, big: 7n };
  const number = (path: string) => numberAt(message, parsePath(path)!);
  expect(parsePath("status.robots[1].x")).toEqual(["status", "robots", 1, "x"]);
  expect(number("status.robots[1].x")).toBe(2.5);
  expect(number("status.robots[1].on")).toBe(1);
  expect(number("stamp")).toBe(3.5);
  expect(number("big")).toBe(7);
  expect(number("status.robots[2].x")).toBeNull();
  expect(number("status.robots")).toBeNull();
  expect(fieldAt({ list: new Float32Array([1, 2]) }, ["list", 1])).toBe(2);
});

test("properties of every object are not fields", () => {
  expect(fieldAt({ a: 1 }, ["constructor"])).toBeUndefined();
  expect(fieldAt({ a: [] }, ["a", "map"])).toBeUndefined();
});

test.each(["", "[0]", "a..b", "a[", "a[x]", "a b", "a[0", ".a", "1a", "a".repeat(301)])("%j is no path", (path) => {
  expect(parsePath(path)).toBeNull();
});

test("paths are written in the form in which they are read", () => {
  expect(pathOf(pathOf(pathOf("", "a"), 3), "b")).toBe("a[3].b");
});
