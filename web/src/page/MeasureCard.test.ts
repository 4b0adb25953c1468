import { expect, test } from "vitest";
import { barLength, measure } from "./MeasureCard";

test("the ruler gives the distance, its parts and its angle", () => {
  const { distance, dx, dy, dz, angleDeg } = measure({ x: 1, y: 1, z: 0 }, { x: 3, y: 3, z: 1 });
  expect([dx, dy, dz]).toEqual([2, 2, 1]);
  expect(distance).toBe(3); // √(4 + 4 + 1)
  expect(angleDeg).toBeCloseTo(45);
});

test("the scale bar is a round length of at most 120 pixels", () => {
  expect(barLength(0.01)).toBe(1);
  expect(barLength(0.02)).toBe(2);
  expect(barLength(0.05)).toBe(5);
  expect(barLength(0.0999)).toBe(10);
  expect(barLength(0.001)).toBeCloseTo(0.1);
});
