import { expect, test } from "vitest";
import type { Plots, Source } from "./plots";
import { MOST_CURVES, NO_PLOTS, curveName, withCurve, withoutCurve } from "./plots";

const ROBOT: Source = { kind: "robot", robot: "a" };

test("a curve is added once and can be removed", () => {
  const once = withCurve(NO_PLOTS, ROBOT, "x", "m");
  const twice = withCurve(once, ROBOT, "x", "m");
  expect(twice.curves).toEqual(once.curves);
  expect(withoutCurve(twice, once.curves[0]!.id).curves).toEqual([]);
});

test("each curve has its own colour, and their number is limited", () => {
  let plots: Plots = NO_PLOTS;
  for (let i = 0; i < MOST_CURVES + 3; i++) plots = withCurve(plots, ROBOT, `v${i}`, "");
  expect(plots.curves).toHaveLength(MOST_CURVES);
  expect(new Set(plots.curves.map(({ colour }) => colour)).size).toBe(MOST_CURVES);
  const freed = plots.curves[3]!.colour;
  const again = withCurve(withoutCurve(plots, plots.curves[3]!.id), ROBOT, "new", "");
  expect(again.curves.at(-1)!.colour).toBe(freed);
});

test("a curve's name contains the source of its value", () => {
  expect(curveName({ source: ROBOT, key: "yaw" })).toBe("a heading");
  expect(curveName({ source: { kind: "sensor", topic: "/a/sonar_03" }, key: "range" })).toBe(
    "a sonar_03 range",
  );
  expect(curveName({ source: { kind: "simulation" }, key: "real_time_factor" })).toBe("real-time factor");
});
