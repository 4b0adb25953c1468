import { expect, test } from "vitest";
import { curveQuery, parseCurve } from "./curve";

test("a curve is read, with gaps where a value was not finite", () => {
  const curve = parseCurve({ time_s: [0, 1.5], values: [null, 3], is_whole: true, done: false, problem: "" });
  expect([...curve.times]).toEqual([0, 1.5]);
  expect([...curve.values]).toEqual([NaN, 3]);
  expect(curve).toMatchObject({ isWhole: true, done: false, problem: "" });
});

test("an invalid curve is rejected with its place", () => {
  expect(() => parseCurve([])).toThrow("curve: expected an object");
  expect(() => parseCurve({ time_s: ["x"], values: [1] })).toThrow("curve.time_s[0]: expected a number");
  expect(() => parseCurve({ time_s: [1, 2], values: [1] })).toThrow("curve.values: expected 2 values, found 1");
});

test("names are escaped in requests", () => {
  expect(curveQuery({ topic: "/a b/sonar", key: "x&y" }, 10)).toBe("topic=%2Fa%20b%2Fsonar&key=x%26y&most=10");
  expect(curveQuery({ robot: "ä", key: "x" }, 10)).toBe("robot=%C3%A4&key=x&most=10");
  expect(curveQuery({ key: "late_steps" }, 10)).toBe("key=late_steps&most=10");
});
