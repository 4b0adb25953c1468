import { expect, test } from "vitest";
import { parseExpression } from "./expression";

const valueOf = (text: string, ...values: number[]) => parseExpression(text).evaluate(values);

test.each([
  ["1 + 2 * 3", 7],
  ["(1 + 2) * 3", 9],
  ["2 ^ 3 ^ 2", 512],
  ["-2 ^ 2", -4],
  ["2 ^ -1", 0.5],
  ["8 / 4 / 2", 1],
  ["10 - 4 - 3", 3],
  ["1.5e2 + .5", 150.5],
  ["hypot(3, 4)", 5],
  ["max(1, 2, -3)", 2],
  ["atan2(1, 0) - pi / 2", 0],
  ["deg(pi)", 180],
  ["sqrt(abs(-16))", 4],
])("%s is %s", (text, value) => {
  expect(valueOf(text)).toBeCloseTo(value, 12);
});

test("fields are named by topic, robot or simulation, and listed once", () => {
  const text = "{/a/odom twist.twist.linear.x} - {my robot speed} + {/a/odom twist.twist.linear.x} * {simulation late_steps}";
  const { references, evaluate } = parseExpression(text);
  expect(references).toEqual([
    { of: "/a/odom", key: "twist.twist.linear.x" },
    { of: "my robot", key: "speed" },
    { of: "simulation", key: "late_steps" },
  ]);
  expect(evaluate([2, 5, 10])).toBe(2 - 5 + 20);
});

test.each([
  ["", "The expression is empty. Type for example {pebble speed} * 3.6."],
  ["1 +", "The expression is not complete."],
  ["1 2", '"2" at character 3 is not expected there.'],
  ["(1", "A bracket is not closed."],
  ["{a b", "The brace at character 1 is not closed."],
  ["{speed}", "{speed} at character 1 must name a topic or a robot, and a field: {pebble speed}."],
  ["2 * speed", '"speed" at character 5 is not known. Put fields into braces: {pebble speed}.'],
  ["1 ; 2", 'The expression cannot have ";" at character 3.'],
  ["atan2(1)", "atan2 takes 2 values, not 1."],
  ["constructor", '"constructor" at character 1 is not known. Put fields into braces: {pebble speed}.'],
])("%s is refused", (text, sentence) => {
  expect(() => parseExpression(text)).toThrow(sentence);
});

test("the parser terminates for hostile texts", () => {
  expect(() => parseExpression("(".repeat(300))).toThrow();
  expect(() => parseExpression("-".repeat(300))).toThrow("The expression is nested too deeply.");
  expect(() => parseExpression("1+".repeat(400))).toThrow("longer than 300 characters");
  expect(() => parseExpression(Array.from({ length: 9 }, (_, i) => `{a ${i}}`).join("+"))).toThrow("at most 8");
  expect(() => parseExpression("alert(1)")).toThrow("There is no function alert");
});
