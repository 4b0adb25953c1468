import { expect, test } from "vitest";
import { rangesOf } from "./PathChart";

const path = { colour: "red", points: [[0, 10], [0, 1]] as [number[], number[]] };

test("a metre has the same length along both axes", () => {
  const [x, y] = rangesOf([path], true, 400, 200);
  expect((x.max - x.min) / 400).toBeCloseTo((y.max - y.min) / 200, 12);
  expect(x.min).toBeLessThan(0);
  expect(y.max).toBeGreaterThan(1);
  expect((y.min + y.max) / 2).toBeCloseTo(0.5, 12);
});

test("values of different units fill the chart", () => {
  const [x, y] = rangesOf([path], false, 400, 200);
  expect(x.max - x.min).toBeCloseTo(11.2, 12);
  expect(y.max - y.min).toBeCloseTo(1.12, 12);
});
