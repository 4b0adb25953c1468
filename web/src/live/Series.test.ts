import { expect, test } from "vitest";
import { MOST_SAMPLES, Series } from "./Series";

function samples(series: Series): [number, number][] {
  return Array.from({ length: series.length }, (_, i) => [series.timeAt(i), series.valueAt(i)]);
}

test("values are ordered by time, in whatever order they arrive", () => {
  const series = new Series();
  for (const time of [1, 3, 5, 2, 0, 4]) series.push(time, 10 * time);
  expect(samples(series)).toEqual([0, 1, 2, 3, 4, 5].map((time) => [time, 10 * time]));
});

test("while it is paused, a value of the same instant replaces the former one", () => {
  const series = new Series();
  series.push(1, 1);
  series.push(2, 2);
  series.push(2, 3);
  series.push(1, 4);
  expect(samples(series)).toEqual([
    [1, 4],
    [2, 3],
  ]);
});

test("it stores a limited number of the newest values", () => {
  const series = new Series();
  for (let i = 0; i < 5 * MOST_SAMPLES; i++) series.push(i, -i);
  expect(series.length).toBe(MOST_SAMPLES);
  expect(series.timeAt(0)).toBe(4 * MOST_SAMPLES);
  expect(series.valueAt(MOST_SAMPLES - 1)).toBe(-(5 * MOST_SAMPLES - 1));
});

test("the value at an instant is the newest one at or before it", () => {
  const series = new Series();
  series.push(1, 10);
  series.push(2, 20);
  expect([0.5, 1, 1.5, 2, 9].map((time) => series.newestAt(time))).toEqual([null, 10, 10, 20, 20]);
  expect(series.firstFrom(1.5)).toBe(1);
  expect(series.firstFrom(9)).toBe(2);
  series.clear();
  expect(series.newestAt(9)).toBeNull();
});
