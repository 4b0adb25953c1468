import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { SimulationApi } from "../api/SimulationApi";
import { simulationStatus } from "../page/testApp";
import { initialState } from "../state/State";
import type { State } from "../state/State";
import { Store } from "../state/Store";
import { PastControl } from "./PastControl";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

const EVENT = { time: 3, event: "collision", robot: "a", detail: "a touches b" };
const REPLAY = { start: 0, end: 40, speed: 1, loop: false };

function past(api: Partial<SimulationApi>) {
  const store = new Store<State>({
    ...initialState,
    connection: { phase: "open" },
    simulation: "house",
    status: simulationStatus("running"),
    isLive: true,
    time: 40,
  });
  const enterPast = vi.fn(async () => {
    await Promise.resolve();
    store.set({ replay: REPLAY, isLive: false, inPast: true });
  });
  const session = { enterPast, goLive: vi.fn() };
  const replay = { seek: vi.fn(async () => {}) };
  const control = new PastControl(store, api as SimulationApi, session, replay);
  control.start();
  return { store, session, replay, control };
}

test("the span of the history and the new events are requested repeatedly", async () => {
  const kept = vi.fn(async () => ({ start: 0, end: 40 }));
  const eventsFrom = vi.fn(async (): Promise<(typeof EVENT)[]> => [EVENT]);
  const { store } = past({ kept, eventsFrom });
  await vi.advanceTimersByTimeAsync(0);
  expect(store.get().kept).toEqual({ start: 0, end: 40 });
  expect(store.get().events).toEqual([EVENT]);
  await vi.advanceTimersByTimeAsync(2000);
  expect(eventsFrom.mock.calls).toEqual([["house", 0], ["house", 39]]);
  expect(store.get().events).toEqual([EVENT]);
});

test("a server without a stored history is queried only once", async () => {
  const kept = vi.fn(async () => null);
  const { store } = past({ kept });
  await vi.advanceTimersByTimeAsync(10_000);
  expect(kept).toHaveBeenCalledOnce();
  expect(store.get().kept).toBeNull();
});

test("while the slider is dragged, the past is opened once, and the last requested time applies", async () => {
  const { store, control, session, replay } = past({ kept: async () => ({ start: 10, end: 40 }), eventsFrom: async () => [] });
  await vi.advanceTimersByTimeAsync(0);
  const first = control.lookAt(30);
  void control.lookAt(5);
  expect(store.get().wishedTime).toBe(10); // nothing earlier is stored
  await first;
  expect(session.enterPast).toHaveBeenCalledOnce();
  expect(replay.seek.mock.calls).toEqual([[10]]);
  void control.lookAt(20);
  expect(replay.seek).toHaveBeenLastCalledWith(20);
});

test("if the past cannot be opened, the page stays with the run and shows the reason", async () => {
  const { store, control, session } = past({ kept: async () => ({ start: 0, end: 40 }), eventsFrom: async () => [] });
  await vi.advanceTimersByTimeAsync(0);
  session.enterPast.mockRejectedValueOnce(new Error("too many recordings are open"));
  await control.lookAt(30);
  expect(store.get().wishedTime).toBeNull();
  expect(store.get().notices[0]!.sentence).toContain("too many recordings are open");
});

test("after a reset, the events of the earlier run are removed", async () => {
  let end = 40;
  const eventsFrom = vi.fn(async () => (end === 40 ? [EVENT] : []));
  const { store } = past({ kept: async () => ({ start: 0, end }), eventsFrom });
  await vi.advanceTimersByTimeAsync(0);
  end = 1;
  store.set({ time: 1 });
  await vi.advanceTimersByTimeAsync(2000);
  expect(store.get().events).toEqual([]);
  expect(eventsFrom).toHaveBeenLastCalledWith("house", 0);
});
