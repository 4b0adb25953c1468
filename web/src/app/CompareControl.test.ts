import { expect, test, vi } from "vitest";
import type { SimulationApi } from "../api/SimulationApi";
import { simulationStatus } from "../page/testApp";
import type { State } from "../state/State";
import { initialState } from "../state/State";
import { Store } from "../state/Store";
import { CompareControl } from "./CompareControl";

const REPLAY = { start: 0, end: 40, speed: 2, loop: false };
const ABILITIES = { creates: false, records: false, recordings: true, recording: "today.mcap" };

function compare() {
  const store = new Store<State>({
    ...initialState,
    simulation: "house",
    replay: REPLAY,
    abilities: ABILITIES,
    status: simulationStatus("paused"),
    time: 12,
  });
  const other = {
    openRecording: vi.fn(async () => {}),
    simulations: vi.fn(async () => [{ name: "house" }]),
    scene: vi.fn(async () => null),
    socketUrl: () => "ws://other",
    changeReplay: vi.fn(async () => REPLAY),
    seek: vi.fn(async (_: string, time: number) => simulationStatus("paused", { time })),
    act: vi.fn(async () => simulationStatus("running")),
  };
  const difference = vi.fn(async () => ({ isEqual: false, time: 3, text: "differs" }));
  const api = { another: () => other, rootServer: {}, difference } as unknown as SimulationApi;
  const handlers: ((message: unknown) => void)[] = [];
  const client = { connect: vi.fn(), close: vi.fn(), subscribe: vi.fn((_, handler) => (handlers.push(handler), () => {})) };
  const control = new CompareControl(store, api, () => client as never);
  control.start();
  return { store, other, difference, client, control, send: (message: unknown) => handlers.forEach((handler) => handler(message)) };
}

test("the second recording is opened at the same time, and the first difference is shown", async () => {
  const { store, other, difference, client, control } = compare();
  await control.with("yesterday.mcap");
  expect(other.openRecording).toHaveBeenCalledWith("yesterday.mcap");
  expect(client.connect).toHaveBeenCalledOnce();
  expect(difference).toHaveBeenCalledWith("today.mcap", "yesterday.mcap");
  expect(store.get().comparison?.difference?.time).toBe(3);
  expect(store.get().notices.at(-1)?.sentence).toBe("First difference from yesterday.mcap at 0:03.00: differs");
  await vi.waitFor(() => expect(other.seek).toHaveBeenLastCalledWith("house", 12));
  store.set({ time: 20 });
  await vi.waitFor(() => expect(other.seek).toHaveBeenLastCalledWith("house", 20));
});

test("the second recording plays at the same speed, and seeks only if its time differs", async () => {
  const { store, other, control, send } = compare();
  await control.with("yesterday.mcap");
  await vi.waitFor(() => expect(other.seek).toHaveBeenCalled());
  store.set({ status: simulationStatus("running") });
  await vi.waitFor(() => expect(other.act).toHaveBeenCalledWith("house", "resume"));
  expect(other.changeReplay).toHaveBeenLastCalledWith("house", { speed: 2 });
  const seeks = other.seek.mock.calls.length;
  send({ stamp: { sec: 12, nsec: 100_000_000 }, layout_version: 1, poses: new Float64Array() });
  store.set({ time: 12.15 });
  await Promise.resolve();
  expect(other.seek).toHaveBeenCalledTimes(seeks);
});

test("the second recording seeks again after a pause, because it played on before the pause", async () => {
  const { store, other, control } = compare();
  await control.with("yesterday.mcap");
  await vi.waitFor(() => expect(other.seek).toHaveBeenCalled());
  let phase: "running" | "paused" = "running";
  const calls: string[] = [];
  other.seek.mockImplementation(async (_, time) => (calls.push(`seek ${time}`), simulationStatus(phase, { time })));
  other.act.mockImplementation(async (...[, action]: unknown[]) => {
    calls.push(String(action));
    phase = action === "pause" ? "paused" : "running";
    return simulationStatus(phase);
  });
  store.set({ time: 20 });
  await vi.waitFor(() => expect(calls).toEqual(["seek 20", "pause", "seek 20"]));
});

test("a change that comes while the second recording is moved is followed, also after a failed request", async () => {
  const { store, other, control } = compare();
  await control.with("yesterday.mcap");
  await vi.waitFor(() => expect(other.seek).toHaveBeenCalledOnce());
  let fail = (_: Error) => {};
  other.seek.mockImplementationOnce(() => new Promise((_, reject) => (fail = reject)));
  store.set({ time: 20 });
  await vi.waitFor(() => expect(other.seek).toHaveBeenLastCalledWith("house", 20));
  store.set({ time: 21 });
  fail(new Error("no answer"));
  await vi.waitFor(() => expect(other.seek).toHaveBeenLastCalledWith("house", 21));
});

test("the poses of the second recording are passed on until the comparison ends", async () => {
  const { store, control, client, send } = compare();
  const onPoses = vi.fn();
  control.onPoses = onPoses;
  await control.with("yesterday.mcap");
  send({ stamp: { sec: 1, nsec: 500_000_000 }, layout_version: 3, poses: new Float64Array(7) });
  expect(onPoses).toHaveBeenCalledWith({ stamp: 1.5, layoutVersion: 3, poses: new Float64Array(7) });
  control.end();
  expect(client.close).toHaveBeenCalledOnce();
  expect(store.get().comparison).toBeNull();
});

test("the reason is shown if a recording cannot be compared", async () => {
  const { store, other, control } = compare();
  other.openRecording.mockRejectedValueOnce(new Error("there is no recording 'gone'"));
  await control.with("gone");
  expect(store.get().comparison?.problem).toBe("there is no recording 'gone'");
});
