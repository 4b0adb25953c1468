import { expect, test } from "vitest";
import { Series } from "../live/Series";
import type { DrawnCurve } from "./columns";
import { columnsOf, gapOf, pathOf, rangeOf, timeRange } from "./columns";

function seriesOf(...samples: [number, number][]): Series {
  const series = new Series();
  for (const [time, value] of samples) series.push(time, value);
  return series;
}

const curve = (...samples: [number, number][]): DrawnCurve => ({ unit: "", colour: "red", series: seriesOf(...samples) });

test("a curve is drawn to the edges of the time that is shown", () => {
  const series = seriesOf([0, 1], [1, 2], [2, 3], [3, 4], [4, 5]);
  expect(columnsOf(series, { min: 1.5, max: 2.5 })).toEqual([
    [1, 2, 3],
    [2, 3, 4],
  ]);
});

test("a curve has a gap where values are missing", () => {
  const steady = Array.from({ length: 20 }, (_, i) => [i / 10, 1] as [number, number]);
  const breaks = (...more: [number, number][]) =>
    columnsOf(seriesOf(...steady, ...more), { min: 0, max: 10 })[1].filter((value) => value === null).length;
  expect(breaks([2, 1])).toBe(0);
  expect(breaks([9, 1])).toBe(1);
  expect(breaks([2, NaN], [2.1, 1])).toBe(1);
});

test("a gap in a curve is several times as long as the interval of its values", () => {
  const slow = seriesOf([0, 1], [5, 1], [10, 1]);
  expect(gapOf(slow, { min: 0, max: 11 })).toBe(40);
  expect(gapOf(seriesOf([0, 1]), { min: 0, max: 1 })).toBe(Infinity);
});

test("a path has a point for each value of y, with the newest x", () => {
  const x = seriesOf([1, 10], [3, 30]);
  const y = seriesOf([0, 1], [1, 2], [2, NaN], [3, 4], [9, 5]);
  expect(pathOf(x, y, { min: 0, max: 5 })).toEqual([
    [10, 30],
    [2, 4],
  ]);
});

test("a range of values has a margin, and is never empty", () => {
  expect(rangeOf([[0, 10, null]])).toEqual({ min: -0.6, max: 10.6 });
  expect(rangeOf([[]])).toEqual({ min: 0, max: 1 });
  const { min, max } = rangeOf([[3, 3]]);
  expect(min).toBeLessThan(3);
  expect(max).toBeGreaterThan(3);
});

test("the time axis ends at the present time or at the last value", () => {
  const curves = [curve([2, 0], [8, 0]), curve()];
  expect(timeRange(curves, 5, 20)).toEqual({ min: 15, max: 20 });
  expect(timeRange(curves, 30, 4)).toEqual({ min: 0, max: 30 });
  expect(timeRange(curves, null, 4)).toEqual({ min: 2, max: 8 });
  expect(timeRange([], null, 4)).toEqual({ min: 4, max: 5 });
  expect(timeRange(curves, null, 4, { min: 0, max: 60 })).toEqual({ min: 0, max: 60 });
});
