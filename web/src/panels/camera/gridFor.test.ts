import { expect, test } from "vitest";
import { gridFor } from "./gridFor";

test("four images in a window that is as wide as a screen are in two columns and two rows", () => {
  const { columns, cellWidth } = gridFor(4, 1000, 560);
  expect(columns).toBe(2);
  expect(2 * (cellWidth! / (4 / 3.4) + 6)).toBeLessThanOrEqual(560);
});

test("few images in a wide place are in one row, and in a tall place in one column", () => {
  expect(gridFor(3, 1200, 300).columns).toBe(3);
  expect(gridFor(2, 280, 700).columns).toBe(1);
  expect(gridFor(1, 280, 700).columns).toBe(1);
});

test("if the cells would be too small, the columns share the width, and the grid scrolls", () => {
  expect(gridFor(60, 400, 200)).toEqual({ columns: 2, cellWidth: null });
  expect(gridFor(3, 120, 100)).toEqual({ columns: 1, cellWidth: null });
  expect(gridFor(0, 0, 0)).toEqual({ columns: 1, cellWidth: null });
});
