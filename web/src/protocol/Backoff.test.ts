import { expect, test } from "vitest";
import { backoffMs } from "./Backoff";

const middle = () => 0.5;

test("each wait is twice the one before, up to eight seconds", () => {
  expect([1, 2, 3, 4, 5, 6, 60].map((attempt) => backoffMs(attempt, middle))).toEqual([
    500, 1000, 2000, 4000, 8000, 8000, 8000,
  ]);
});

test("the waiting times of viewers differ by up to a fifth", () => {
  expect(backoffMs(2, () => 0)).toBeCloseTo(800);
  expect(backoffMs(2, () => 1)).toBeCloseTo(1200);
});
