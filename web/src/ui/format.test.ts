import { expect, test } from "vitest";
import { count, formatDate, formatDistance, formatFactor, formatNumber, formatSize, formatTime, formatValue, parseTime } from "./format";

test.each([
  [0, "0:00.00"],
  [0.07, "0:00.07"],
  [59.999, "0:59.99"],
  [75.25, "1:15.25"],
  [3675.25, "1:01:15.25"],
  [-1, "0:00.00"],
])("%f s reads %s", (seconds, text) => {
  expect(formatTime(seconds)).toBe(text);
});

test("a time that is not exact in binary is not shown a hundredth too early", () => {
  expect(formatTime(1.15)).toBe("0:01.15");
  expect(formatTime(0.29)).toBe("0:00.29");
});

test.each([
  [0.9871, "0.99×"],
  [1, "1.00×"],
  [12.34, "12.3×"],
  [250.2, "250×"],
])("a factor of %f reads %s", (factor, text) => {
  expect(formatFactor(factor)).toBe(text);
});

test.each([
  [0.123, "0.12 m"],
  [345.67, "345.7 m"],
  [1234.5, "1.23 km"],
])("%f m reads %s", (metres, text) => {
  expect(formatDistance(metres)).toBe(text);
});

test("a zero has no sign", () => {
  expect(formatNumber(-0.0001, 2)).toBe("0.00");
  expect(formatNumber(-0.1, 2)).toBe("-0.10");
});

test.each([
  [1.23456, "m", "1.235 m"],
  [-0.0001, "", "-1.000e-4"],
  [0, "m", "0.000 m"],
  [12, "", "12"],
  [4321.98, "m", "4322.0 m"],
  [47.1234567, "°", "47.1234567°"],
  [0.0000482, "T", "4.820e-5 T"],
  [Infinity, "m", "∞ m"],
  [NaN, "V", "–"],
])("%f %s reads %s", (value, unit, text) => {
  expect(formatValue(value, unit)).toBe(text);
});

test("a single item is singular, and thousands are separated", () => {
  expect([count(1, "robot"), count(0, "robot"), count(12_345, "robot")]).toEqual([
    "1 robot",
    "0 robots",
    "12,345 robots",
  ]);
});

test("sizes and dates are formatted for people", () => {
  expect([900, 999_499, 1_500_000, 2e9].map(formatSize)).toEqual(["1 kB", "999 kB", "1.5 MB", "2.00 GB"]);
  expect(formatDate("2026-01-31T12:00:00Z")).toContain("2026");
  expect(formatDate("yesterday")).toBe("");
});

test.each([
  ["75.25", 75.25],
  [" 1:15.25 ", 75.25],
  ["1:01:15", 3675],
  ["", null],
  ["-1", null],
  ["1:2:3:4", null],
  ["1e9", null],
  ["soon", null],
])("the typed time %j is %s", (text, time) => expect(parseTime(text)).toBe(time));
