import { expect, test, vi } from "vitest";
import { robotStatus, simulationStatus } from "../../page/testApp";
import { body, scene } from "../../scene/testScene";
import type { Curve, Source } from "../../state/plots";
import { NO_PLOTS, curveId } from "../../state/plots";
import type { State } from "../../state/State";
import { initialState } from "../../state/State";
import { Store } from "../../state/Store";
import { TestTopics } from "../contract/testPorts";
import { PlotFeed } from "./PlotFeed";

const SONAR = {
  name: "sonar",
  type: "sonar",
  overlay: "lines",
  link: "",
  topic: "/a/sonar",
  view: null,
} as const;
const SCENE = scene({
  bodies: [body("wall", { isRobot: false }), body("a", { sensors: [SONAR] })],
  poses: [{ body: 1, link: null }],
});
const A: Source = { kind: "robot", robot: "a" };

function curve(source: Source, key: string): Curve {
  return { id: curveId(source, key), source, key, unit: "", colour: "" };
}

function feeding(curves: Curve[], more: Partial<State> = {}) {
  const store = new Store<State>({
    ...initialState,
    simulation: "house",
    scene: SCENE,
    plots: { ...NO_PLOTS, curves },
    ...more,
  });
  const topics = new TestTopics();
  const onData = vi.fn();
  const feed = new PlotFeed(store, topics, onData);
  feed.start();
  onData.mockClear();
  const takePoses = (message: object) => topics.send("/gsv/poses", message);
  return { store, feed, topics, onData, takePoses };
}

function poses(time: number, x: number, yaw = 0) {
  const quarter = [0, 0, Math.sin(yaw / 2), Math.cos(yaw / 2)];
  return {
    stamp: { sec: Math.floor(time), nsec: Math.round((time % 1) * 1e9) },
    step: 0n,
    layout_version: 1,
    poses: new Float64Array([x, 2, 0, ...quarter]),
  };
}

function samples(feed: PlotFeed, source: Source, key: string): number[][] {
  const series = feed.seriesOf(curveId(source, key))!;
  return Array.from({ length: series.length }, (_, i) => [series.timeAt(i), series.valueAt(i)]);
}

test("a robot's pose and speed come from the poses by simulated time", () => {
  const { feed, onData, takePoses } = feeding([curve(A, "x"), curve(A, "speed"), curve(A, "turn_rate")]);
  takePoses(poses(1, 5, 3.1));
  takePoses(poses(1.5, 6, -3.1));
  expect(samples(feed, A, "x")).toEqual([
    [1, 5],
    [1.5, 6],
  ]);
  expect(samples(feed, A, "speed")).toEqual([[1.5, 2]]);
  expect(samples(feed, A, "turn_rate")[0]![1]).toBeCloseTo((2 * Math.PI - 6.2) / 0.5);
  expect(onData).toHaveBeenCalledTimes(2);
});

test("poses of another layout are ignored", () => {
  const { feed, takePoses } = feeding([curve(A, "x")]);
  takePoses({ ...poses(1, 5), layout_version: 2 });
  expect(samples(feed, A, "x")).toEqual([]);
});

test("a pause adds no values, and a reset clears the curves", () => {
  const { feed, takePoses } = feeding([curve(A, "x"), curve(A, "speed")]);
  for (const [time, x] of [
    [7, 1],
    [7, 1],
    [7.5, 1],
  ] as const)
    takePoses(poses(time, x));
  expect(samples(feed, A, "x")).toHaveLength(2);
  takePoses(poses(0, 9));
  expect(samples(feed, A, "x")).toEqual([[0, 9]]);
  expect(samples(feed, A, "speed")).toEqual([]);
});

test("in a recording, values are kept while time goes forwards or backwards", () => {
  const replay = { start: 0, end: 20, speed: 1, loop: false };
  const { feed, takePoses } = feeding([curve(A, "x"), curve(A, "speed")], { replay });
  for (const [time, x] of [
    [10, 1],
    [2, 5],
    [6, 3],
  ] as const)
    takePoses(poses(time, x));
  expect(samples(feed, A, "x")).toEqual([
    [2, 5],
    [6, 3],
    [10, 1],
  ]);
  expect(samples(feed, A, "speed")).toEqual([]);
});

test("a sensor is subscribed only while it is plotted", () => {
  const sonar: Source = { kind: "sensor", topic: "/a/sonar" };
  const { store, feed, topics } = feeding([curve(sonar, "range")]);
  topics.send("/a/sonar", { header: { stamp: { sec: 3, nsec: 0 } }, range: 1.25 });
  expect(samples(feed, sonar, "range")).toEqual([[3, 1.25]]);
  store.set({ plots: NO_PLOTS });
  expect(topics.read).toEqual([]);
  expect(feed.seriesOf(curveId(sonar, "range"))).toBeNull();
});

test("the status contains the real-time factor and the robots' distances", () => {
  const { store, feed } = feeding([curve({ kind: "simulation" }, "real_time_factor"), curve(A, "distance")]);
  const status = simulationStatus("running", {
    time: 4,
    realTimeFactor: 0.75,
    robots: [robotStatus("a", { distance: 3 })],
  });
  store.set({ status });
  expect(samples(feed, { kind: "simulation" }, "real_time_factor")).toEqual([[4, 0.75]]);
  expect(samples(feed, A, "distance")).toEqual([[4, 3]]);
});

test("the curves are cleared for another simulation", () => {
  const { store, feed, takePoses } = feeding([curve(A, "x")]);
  takePoses(poses(1, 5));
  store.set({ simulation: "yard" });
  expect(samples(feed, A, "x")).toEqual([]);
});

test("in a recording, the complete curve replaces the played values", () => {
  const replay = { start: 0, end: 20, speed: 1, loop: false };
  const { feed, onData, takePoses } = feeding([curve(A, "x")], { replay });
  takePoses(poses(10, 1));
  const id = curveId(A, "x");
  const whole = { isWhole: true, done: true, problem: "" };
  feed.takeWhole(id, { ...whole, times: Float64Array.of(0, 5, 20), values: Float64Array.of(7, NaN, 9) });
  expect(onData).toHaveBeenCalled();
  takePoses(poses(12, 3));
  expect(samples(feed, A, "x")).toEqual([
    [0, 7],
    [5, NaN],
    [20, 9],
  ]);
  expect(feed.isThinned(id)).toBe(false);
  feed.takeWhole(id, { ...whole, isWhole: false, times: Float64Array.of(1), values: Float64Array.of(2) });
  expect(samples(feed, A, "x")).toEqual([[1, 2]]);
  expect(feed.isThinned(id)).toBe(true);
});

test("an expression is computed whenever one of its fields gets a value, with the newest values of its other fields", () => {
  const text = "hypot({a x}, 3) + {/a/sonar range} * {simulation late_steps}";
  const { feed, topics, store, takePoses } = feeding([curve({ kind: "expression" }, text)]);
  expect(topics.read.sort()).toEqual(["/a/sonar", "/gsv/poses"]);
  const sonar = (sec: number, range: number) => topics.send("/a/sonar", { header: { stamp: { sec, nsec: 0 } }, range });
  takePoses(poses(1, 4));
  sonar(2, 10);
  expect(samples(feed, { kind: "expression" }, text)).toEqual([]); // one field of the expression has no value yet
  store.set({ status: simulationStatus("running", { time: 3, lateSteps: 2 }) });
  sonar(4, 20);
  expect(samples(feed, { kind: "expression" }, text)).toEqual([
    [3, 25],
    [4, 45],
  ]);
  store.set({ plots: NO_PLOTS });
  expect(topics.read).toEqual([]);
});

test("the history of a run precedes the values that were plotted live", () => {
  const { feed, takePoses } = feeding([curve(A, "x")]);
  takePoses(poses(10, 5));
  takePoses(poses(11, 6));
  const times = Float64Array.from([8, 9, 10, 10.5]);
  feed.takePast(curveId(A, "x"), { times, values: Float64Array.from([1, 2, 3, 4]), isWhole: true, done: true, problem: "" });
  expect(samples(feed, A, "x")).toEqual([[8, 1], [9, 2], [10, 5], [11, 6]]);
  takePoses(poses(12, 7)); // later values are added
  expect(samples(feed, A, "x").at(-1)).toEqual([12, 7]);
});

test("after a return from the past, the run is plotted again", () => {
  const replay = { start: 0, end: 20, speed: 1, loop: false };
  const { feed, store, takePoses } = feeding([curve(A, "x")]);
  store.set({ replay, inPast: true });
  feed.takeWhole(curveId(A, "x"), { times: Float64Array.from([1]), values: Float64Array.from([9]), isWhole: true, done: true, problem: "" });
  expect(samples(feed, A, "x")).toEqual([[1, 9]]);
  store.set({ replay: null, inPast: false });
  takePoses(poses(21, 3));
  expect(samples(feed, A, "x")).toEqual([[21, 3]]);
});

test("the curve of a second recording is separate, and is removed with that recording", () => {
  const comparison = { recording: "old.mcap", simulation: "x", scene: null, difference: null, problem: "" };
  const { feed, store } = feeding([curve(A, "x")], { comparison });
  feed.takeCompared(curveId(A, "x"), { times: Float64Array.from([1]), values: Float64Array.from([9]), isWhole: true, done: true, problem: "" });
  expect(feed.comparedOf(curveId(A, "x"))!.valueAt(0)).toBe(9);
  expect(samples(feed, A, "x")).toEqual([]);
  store.set({ comparison: null });
  expect(feed.comparedOf(curveId(A, "x"))).toBeNull();
});
