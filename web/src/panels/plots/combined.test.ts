import { expect, test } from "vitest";
import type { WholeCurve } from "../../api/curve";
import { combined } from "./combined";

function curve(samples: [number, number][], more: Partial<WholeCurve> = {}): WholeCurve {
  const column = (i: 0 | 1) => Float64Array.from(samples.map((each) => each[i]));
  return { times: column(0), values: column(1), isWhole: true, done: true, problem: "", ...more };
}

test("values at different instants are combined with the newest value of each other curve", () => {
  const slow = curve([
    [1, 10],
    [3, 30],
  ]);
  const fast = curve([
    [0, 1],
    [1, 2],
    [2, 3],
    [3, 4],
  ]);
  const { times, values, done } = combined([slow, fast], ([a, b]) => a! + b!);
  expect([...times]).toEqual([1, 2, 3]);
  expect([...values]).toEqual([12, 13, 34]);
  expect(done).toBe(true);
});

test("a combined curve is as complete as its least complete input, and has the input's problem", () => {
  const thinned = curve([[0, 1]], { isWhole: false });
  const unread = curve([[0, 1]], { done: false, problem: "the recording is damaged" });
  expect(combined([thinned, unread], ([a]) => a!)).toMatchObject({ isWhole: false, done: false, problem: "the recording is damaged" });
});
