import { expect, test } from "vitest";
import { place, rangeOf, tickLabel, ticksOf } from "./scale";

test("a range has room around its values, and is never empty", () => {
  const { min, max } = rangeOf(0, 10);
  expect(min).toBeLessThan(0);
  expect(max).toBeGreaterThan(10);
  for (const [low, high] of [
    [3, 3],
    [0, 0],
    [Infinity, -Infinity],
    [NaN, NaN],
  ] as const) {
    const range = rangeOf(low, high);
    expect(range.max).toBeGreaterThan(range.min);
  }
});

test.each([
  [{ min: 0, max: 10 }, 5, [0, 2, 4, 6, 8, 10]],
  [{ min: -0.3, max: 0.3 }, 3, [-0.2, 0, 0.2]],
  [{ min: 97.2, max: 99.9 }, 3, [98, 99]],
])("the ticks of %o, about %i, are %j", (range, most, expected) => {
  const ticks = ticksOf(range, most);
  expect(ticks).toHaveLength(expected.length);
  ticks.forEach((tick, i) => expect(tick).toBeCloseTo(expected[i]!, 9));
});

test("no range, no ticks", () => {
  expect(ticksOf({ min: 1, max: 1 }, 5)).toEqual([]);
  expect(ticksOf({ min: NaN, max: 1 }, 5)).toEqual([]);
  expect(ticksOf({ min: 0, max: Infinity }, 5)).toEqual([]);
});

test.each([
  [0.30000000000000004, 0.1, "0.3"],
  [-1e-17, 0.2, "0"],
  [20, 5, "20"],
  [2_000_000, 1_000_000, "2.0e+6"],
  [0.00002, 0.000005, "2.0e-5"],
])("%f, with ticks %f apart, reads %s", (tick, step, text) => {
  expect(tickLabel(tick, step)).toBe(text);
});

test("a value has its place between the edges", () => {
  expect(place(5, { min: 0, max: 10 }, 100, 200)).toBe(150);
  expect(place(0, { min: 0, max: 10 }, 80, 20)).toBe(80);
});
