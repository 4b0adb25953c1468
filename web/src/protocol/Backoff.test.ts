import { expect, test } from "vitest";
import { backoffMs } from "./Backoff";

const middle = () => 0.5;

test("each wait is twice the one before, up to eight seconds", () => {
  expect([1, 2, 3, 4, 5, 6, 60].map((attempt) => backoffMs(attempt, middle))).toEqual([
    500, 1000, 2000, 4000, 8000, 8000, 8000,
  ]);
});

test("viewers spread by a fifth either way", () => {
  expect(backoffMs(2, () => 0)).toBeCloseTo(800);
  expect(backoffMs(2, () => 1)).toBeCloseTo(1200);
});
