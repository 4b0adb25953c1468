import { expect, test, vi } from "vitest";
import type { SimulationApi } from "../api/SimulationApi";
import { ApiError } from "../api/SimulationApi";
import type { Phase, SimulationStatus } from "../api/status";
import type { State } from "../state/State";
import { initialState } from "../state/State";
import { Store } from "../state/Store";
import { App } from "./App";
import { NOTHING_WANTED, Session } from "./Session";

function status(phase: Phase): SimulationStatus {
  return {
    phase,
    mode: "real_time",
    step: 0,
    time: 0,
    targetFactor: 1,
    realTimeFactor: 1,
    lateSteps: 0,
    waitingFor: "",
    failure: "",
    robots: [
      {
        name: "robbie",
        model: "",
        behaviour: "",
        agentPhase: "none",
        detail: "",
        distance: 0,
        collisions: 0,
      },
    ],
    replay: null,
  };
}

function appIn(phase: Phase, act: SimulationApi["act"]) {
  const store = new Store<State>({
    ...initialState,
    connection: { phase: "open" },
    simulation: "house",
    status: status(phase),
  });
  const api = { act } as unknown as SimulationApi;
  const session = new Session(api, store, NOTHING_WANTED);
  return { store, app: new App(store, session, api, () => null) };
}

test("the main action fits the phase, and a late answer does not override the stream", async () => {
  const act = vi.fn(async () => status("paused"));
  const { store, app } = appIn("running", act);
  app.startPauseOrResume();
  expect(act).toHaveBeenCalledWith("house", "pause", 1);
  expect(store.get().pending).toBe("pause");
  await vi.waitFor(() => expect(store.get().pending).toBeNull());
  expect(store.get().status?.phase).toBe("running");
});

test("a refusal shows the server's sentence and changes nothing", async () => {
  const { store, app } = appIn("running", async () => {
    throw new ApiError(409, "to pause it must be running, and it is stopped");
  });
  await app.act("pause");
  expect(store.get().notices).toMatchObject([
    { kind: "error", sentence: "to pause it must be running, and it is stopped" },
  ]);
  expect(store.get().status?.phase).toBe("running");
  expect(store.get().pending).toBeNull();
});

test("a second click during a pending request is not sent", async () => {
  const act = vi.fn(() => new Promise<SimulationStatus>(() => {}));
  const { app } = appIn("running", act);
  void app.act("pause");
  void app.act("pause");
  expect(act).toHaveBeenCalledOnce();
});

test("actions that the phase does not allow are not requested", () => {
  const act = vi.fn(async () => status("stopped"));
  const { app } = appIn("stopped", act);
  app.startPauseOrResume();
  app.stepOnce();
  expect(act).not.toHaveBeenCalled();
});

test("a robot's view takes the first robot when none is selected, and ends with the selection", () => {
  const { store, app } = appIn("running", vi.fn());
  app.toggleViewMode("follow");
  expect(store.get()).toMatchObject({ selection: "robbie", viewMode: "follow" });
  app.toggleViewMode("chase");
  expect(store.get().viewMode).toBe("chase");
  app.toggleViewMode("chase");
  expect(store.get()).toMatchObject({ selection: "robbie", viewMode: "orbit" });
  app.toggleViewMode("eye");
  app.select(null);
  expect(store.get()).toMatchObject({ selection: null, viewMode: "orbit" });
});

test("a view from above ends a robot's view", () => {
  const { store, app } = appIn("running", vi.fn());
  app.toggleViewMode("eye");
  app.topView();
  expect(store.get().viewMode).toBe("orbit");
  app.toggleViewMode("follow");
  app.topView();
  expect(store.get().viewMode).toBe("follow");
});

test("without robots there is no robot's view", () => {
  const { store, app } = appIn("running", vi.fn());
  store.set({ status: { ...store.get().status!, robots: [] } });
  app.toggleViewMode("chase");
  expect(store.get()).toMatchObject({ selection: null, viewMode: "orbit" });
});

test("plotting a value opens the closed panel", () => {
  const { store, app } = appIn("running", vi.fn());
  app.panels.open("log");
  app.plot({ kind: "robot", robot: "robbie" }, "speed");
  app.plot({ kind: "robot", robot: "robbie" }, "x");
  expect(store.get().openPanels).toEqual(["log", "plots"]);
  expect(store.get().plots.curves.map(({ key, unit }) => [key, unit])).toEqual([
    ["speed", "m/s"],
    ["x", "m"],
  ]);
  app.panels.toggle("log");
  expect(store.get().openPanels).toEqual(["plots"]);
});
