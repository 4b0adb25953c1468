import { expect, test } from "vitest";
import { ShadowPace } from "./ShadowPace";

function due(pace: ShadowPace, frames: number): boolean[] {
  return Array.from({ length: frames }, () => {
    pace.moved();
    return pace.areDue(true);
  });
}

test("while frames are fast, shadows are redrawn after every motion", () => {
  const pace = new ShadowPace();
  expect(pace.areDue(true)).toBe(false);
  expect(due(pace, 3)).toEqual([true, true, true]);
  expect(pace.areDue(false)).toBe(false);
});

test("while frames are slow, every fourth has new shadows", () => {
  const pace = new ShadowPace();
  pace.frameTook(200);
  expect(due(pace, 9)).toEqual([false, false, false, true, false, false, false, true, false]);
  pace.frameTook(20);
  expect(due(pace, 2)).toEqual([true, true]);
});

test("shadows are redrawn at once when motion has stopped", () => {
  const pace = new ShadowPace();
  pace.frameTook(200);
  expect(due(pace, 2)).toEqual([false, false]);
  expect(pace.areDue(false)).toBe(true);
});
