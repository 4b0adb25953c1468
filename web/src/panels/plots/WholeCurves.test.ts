import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { CurveOf, WholeCurve } from "../../api/curve";
import type { Curve, Source } from "../../state/plots";
import { NO_PLOTS, curveId } from "../../state/plots";
import { testPorts } from "../contract/testPorts";
import { WholeCurves } from "./WholeCurves";

const REPLAY = { start: 0, end: 20, speed: 1, loop: false };
const SONAR: Source = { kind: "sensor", topic: "/a/sonar" };

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function curve(source: Source, key: string): Curve {
  return { id: curveId(source, key), source, key, unit: "", colour: "" };
}

function told(length: number, done: boolean, problem = ""): WholeCurve {
  return { times: new Float64Array(length), values: new Float64Array(length), isWhole: true, done, problem };
}

function reading(answer: (of: CurveOf) => WholeCurve) {
  const asked: CurveOf[] = [];
  const curve = async (_: string, of: CurveOf) => {
    asked.push(of);
    return answer(of);
  };
  const { store, ports } = testPorts({}, { curve });
  const heard: [string, number][] = [];
  const hear = (id: string, { times }: WholeCurve) => void heard.push([id, times.length]);
  new WholeCurves(ports, { onWhole: hear, onPast: hear, onCompared: hear }).start();
  return { store, asked, heard, notify: ports.notices.notify };
}

test("a recording is requested until it is read completely, and shown meanwhile", async () => {
  let read = 0;
  const { store, asked, heard } = reading(() => told(++read, read >= 3));
  const plotted = curve(SONAR, "range");
  store.set({ replay: REPLAY, plots: { ...NO_PLOTS, curves: [plotted] } });
  await vi.runAllTimersAsync();
  expect(asked).toEqual(Array(3).fill({ topic: "/a/sonar", key: "range" }));
  expect(heard.map(([, length]) => length)).toEqual([1, 2, 3]);
  store.set({ plots: { ...NO_PLOTS, curves: [plotted, curve({ kind: "robot", robot: "a" }, "x")] } });
  await vi.runAllTimersAsync();
  expect(asked.slice(3)).toEqual([{ robot: "a", key: "x" }]);
});

test("for a live simulation it requests nothing, and plots keep their span", async () => {
  const { store, asked } = reading(() => told(1, true));
  store.set({ plots: { ...NO_PLOTS, curves: [curve({ kind: "simulation" }, "late_steps")] } });
  await vi.runAllTimersAsync();
  expect(asked).toEqual([]);
  expect(store.get().plots.span).toBe(NO_PLOTS.span);
  store.set({ replay: REPLAY });
  await vi.runAllTimersAsync();
  expect(asked).toEqual([{ key: "late_steps" }]);
  expect(store.get().plots.span).toBeNull();
});

test("it stops requesting curves that are no longer plotted", async () => {
  const { store, asked } = reading(() => told(1, false));
  store.set({ replay: REPLAY, plots: { ...NO_PLOTS, curves: [curve(SONAR, "range")] } });
  await vi.advanceTimersByTimeAsync(1000);
  const { length } = asked;
  expect(length).toBeGreaterThan(1);
  store.set({ plots: NO_PLOTS });
  await vi.runAllTimersAsync();
  expect(asked).toHaveLength(length);
});

test("missing data is reported", async () => {
  const { store, notify } = reading(({ key }) => {
    if (key === "gone") throw new Error("no such topic");
    return told(1, true, "a chunk is damaged");
  });
  store.set({ replay: REPLAY, plots: { ...NO_PLOTS, curves: [curve(SONAR, "range"), curve(SONAR, "gone")] } });
  await vi.advanceTimersByTimeAsync(0);
  const sentences = notify.mock.calls.map(([, sentence]) => sentence as string);
  expect(sentences.sort()).toEqual([
    "The plot does not cover the whole recording: a chunk is damaged",
    "The plot does not cover the whole recording: no such topic",
  ]);
});
