import { expect, test } from "vitest";
import { fileName } from "./files";

test("a file is named after its simulation and time", () => {
  expect(fileName("office", 12.345, "view", "png")).toBe("office view 12.35s.png");
  expect(fileName(null, 0, "plot", "csv")).toBe("gsv plot 0.00s.csv");
});

test("files can be written for simulations with any name", () => {
  expect(fileName('a/b\\c:"<x>', 1, "view", "png")).toBe("a_b_c_x_ view 1.00s.png");
  expect(fileName("n".repeat(500), 1, "view", "png").length).toBeLessThan(110);
});
