import { afterEach, expect, test, vi } from "vitest";
import type { Action, SimulationApi } from "../api/SimulationApi";
import { ApiError } from "../api/SimulationApi";
import { simulationStatus } from "../page/testApp";
import type { State } from "../state/State";
import { initialState } from "../state/State";
import { Store } from "../state/Store";
import { ReplayControl } from "./ReplayControl";

const REPLAY = { start: 0, end: 10, speed: 1, loop: false };

// A server that answers when the test requests it.
class Fixture {
  readonly store: Store<State>;
  readonly calls: string[] = [];
  readonly actions: Action[] = [];
  readonly control: ReplayControl;
  private answers: ((time: number) => void)[] = [];

  constructor(state: Partial<State> = {}) {
    this.store = new Store<State>({
      ...initialState,
      simulation: "run",
      replay: REPLAY,
      status: simulationStatus("paused"),
      ...state,
    });
    const api = {
      seek: (_: string, time: number) => this.call(`seek ${time}`),
      stepPoses: (_: string, poses: number) => this.call(`step ${poses}`),
      changeReplay: async (_: string, change: object) => ({ ...REPLAY, ...change }),
    } as unknown as SimulationApi;
    this.control = new ReplayControl(this.store, api, async (action) => void this.actions.push(action));
  }

  // Answers the pending call, and waits for its effects.
  async answer(time: number): Promise<void> {
    this.answers.shift()!(time);
    await vi.waitFor(() => expect(this.store.get().time).toBe(time));
  }

  private call(text: string): Promise<object> {
    this.calls.push(text);
    return new Promise((resolve) =>
      this.answers.push((time) => resolve(simulationStatus("paused", { time }))),
    );
  }
}

afterEach(() => void vi.useRealTimers());

test("during a seek only the last request is kept and shown", async () => {
  const { control, store, calls, answer } = bound(new Fixture());
  const done = control.seek(1);
  for (const time of [2, 3, 4]) void control.seek(time);
  expect(calls).toEqual(["seek 1"]);
  expect(store.get().wishedTime).toBe(4);
  await answer(1);
  await vi.waitFor(() => expect(calls).toEqual(["seek 1", "seek 4"]));
  expect(store.get().wishedTime).toBe(4);
  await answer(4);
  await done;
  expect(store.get()).toMatchObject({ wishedTime: null, time: 4 });
});

test("a seek stays within the recording", async () => {
  const { control, calls, answer } = bound(new Fixture());
  void control.seek(99);
  await answer(10);
  void control.seek(-1);
  expect(calls).toEqual(["seek 10", "seek 0"]);
});

test("steps during a request add up, and opposite steps cancel out", async () => {
  const { control, calls, answer } = bound(new Fixture());
  control.step(1);
  control.step(1);
  control.step(10);
  await answer(0.02);
  await vi.waitFor(() => expect(calls).toEqual(["step 1", "step 11"]));
  control.step(1);
  control.step(-1);
  await answer(0.24);
  expect(calls).toEqual(["step 1", "step 11"]);
});

test("a step after a seek starts from the requested instant", async () => {
  const { control, calls, answer } = bound(new Fixture());
  void control.seek(1);
  void control.seek(5);
  control.step(-1);
  await answer(1);
  await vi.waitFor(() => expect(calls).toHaveLength(2));
  await answer(5);
  await vi.waitFor(() => expect(calls).toEqual(["seek 1", "seek 5", "step -1"]));
});

test.each([
  ["created", "start"],
  ["running", "pause"],
  ["paused", "resume"],
] as const)("while it is %s, play or pause means %s", async (phase, action) => {
  const { control, actions, calls } = new Fixture({ status: simulationStatus(phase), time: 1 });
  await control.playOrPause();
  expect(actions).toEqual([action]);
  expect(calls).toEqual([]);
});

test("play at the end starts again from the beginning", async () => {
  const { control, actions, calls, answer } = bound(
    new Fixture({ status: simulationStatus("finished"), time: 10 }),
  );
  const done = control.playOrPause();
  expect(calls).toEqual(["seek 0"]);
  await answer(0);
  await done;
  expect(actions).toEqual(["resume"]);
});

test("a refusal is shown, and the request is dropped", async () => {
  const { store } = new Fixture();
  const api = {
    seek: async () => {
      throw new ApiError(503, "the server is busy; try again in a moment");
    },
  } as unknown as SimulationApi;
  await new ReplayControl(store, api, async () => {}).seek(3);
  expect(store.get().wishedTime).toBeNull();
  expect(store.get().notices[0]?.sentence).toBe("the server is busy; try again in a moment");
});

test("speed and loop show the server's answer", async () => {
  const { control, store } = new Fixture();
  await control.setSpeed(0.25);
  expect(store.get().replay?.speed).toBe(0.25);
  await control.toggleLoop();
  expect(store.get().replay?.loop).toBe(true);
});

test("it finds the events before and after the present instant", () => {
  const events = [2, 6].map((time) => ({ time, event: "paused", robot: "", detail: "" }));
  const { control, calls, store } = new Fixture({ events, time: 4 });
  control.toEvent(1);
  expect(calls).toEqual(["seek 6"]);
  control.toEvent(-1); // finds the event before the requested time 6, not before the shown time 4
  expect(store.get().wishedTime).toBe(2);
});

test("a live simulation cannot be seeked", () => {
  const { control, calls } = new Fixture({ replay: null });
  void control.seek(1);
  control.step(1);
  control.toEnd();
  control.toEvent(1);
  expect(calls).toEqual([]);
});

function bound(fixture: Fixture) {
  const { control, store, calls, actions } = fixture;
  return { control, store, calls, actions, answer: (time: number) => fixture.answer(time) };
}
