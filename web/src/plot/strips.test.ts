import { expect, test } from "vitest";
import { Series } from "../live/Series";
import type { DrawnCurve, PlotView } from "./strips";
import { LEFT_PX, drawPlot, gapOf, timeAt, timeRange } from "./strips";

function curve(unit: string, ...samples: [number, number][]): DrawnCurve {
  const series = new Series();
  for (const [time, value] of samples) series.push(time, value);
  return { unit, colour: "red", series };
}

const LOOK = { ink: "black", dim: "grey", line: "silver", font: "12px sans-serif" };

// A canvas' context that writes down what it is told.
function context() {
  const calls: [string, ...unknown[]][] = [];
  const told = new Proxy({} as Record<string, unknown>, {
    get: (target, name: string) =>
      name in target ? target[name] : (...args: unknown[]) => void calls.push([name, ...args]),
    set: (target, name: string, value) => {
      target[name] = value;
      return true;
    },
  });
  return { calls, context: told as unknown as CanvasRenderingContext2D };
}

function drawn(curves: DrawnCurve[], more: Partial<PlotView> = {}) {
  const { calls, context: told } = context();
  const view = { width: 500, height: 200, time: { min: 0, max: 10 }, cursor: null, ...more };
  drawPlot(told, curves, view, LOOK);
  const of = (name: string) => calls.filter(([each]) => each === name);
  return { of, texts: of("fillText").map(([, text]) => text) };
}

test("values of one unit share a strip, others have their own", () => {
  const { of, texts } = drawn([
    curve("m", [0, 1], [10, 2]),
    curve("m", [0, 3], [10, 4]),
    curve("m/s", [0, 0]),
  ]);
  expect(of("strokeRect")).toHaveLength(2);
  expect(texts).toContain("m");
  expect(texts).toContain("m/s");
});

test("a curve is drawn from its first value in time to its last", () => {
  const { of } = drawn([curve("m", [0, 0], [10, 10])]);
  const clip = of("rect")[0]!;
  const inside = of("lineTo").filter(([, x, y]) => x === 490 && (y as number) < 100);
  expect(clip.slice(1, 2)).toEqual([LEFT_PX]);
  expect(inside.length).toBeGreaterThan(0);
});

test("where values are missing the curve is broken", () => {
  const steady = Array.from({ length: 20 }, (_, i) => [i / 10, 1] as [number, number]);
  const pens = (more: [number, number][]) => drawn([curve("m", ...steady, ...more)]).of("moveTo").length;
  const whole = pens([[2, 1]]);
  expect(pens([[9, 1]])).toBe(whole + 1);
  expect(
    pens([
      [2, NaN],
      [2.1, 1],
    ]),
  ).toBe(whole + 1);
});

test("a gap is long against the pace of the values", () => {
  const slow = curve("", [0, 1], [5, 1], [10, 1]).series;
  expect(gapOf(slow, { min: 0, max: 11 })).toBe(40);
  expect(gapOf(curve("", [0, 1]).series, { min: 0, max: 1 })).toBe(Infinity);
});

test("the axis ends now, or with the last value there is", () => {
  const curves = [curve("", [2, 0], [8, 0]), curve("")];
  expect(timeRange(curves, 5, 20)).toEqual({ min: 15, max: 20 });
  expect(timeRange(curves, 30, 4)).toEqual({ min: 0, max: 30 });
  expect(timeRange(curves, null, 4)).toEqual({ min: 2, max: 8 });
  expect(timeRange([], null, 4)).toEqual({ min: 4, max: 5 });
});

test("the instant under the pointer is that of the axis", () => {
  const view = { width: 500, time: { min: 10, max: 20 } };
  expect(timeAt(LEFT_PX, view)).toBe(10);
  expect(timeAt(490, view)).toBe(20);
});

test("an empty plot is drawn, with a cursor too", () => {
  expect(drawn([], { cursor: 5 }).of("strokeRect")).toHaveLength(1);
});
