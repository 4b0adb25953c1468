import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { scene } from "../scene/testScene";
import { NO_DIAGNOSTICS } from "../state/diagnostics";
import type { State } from "../state/State";
import { initialState } from "../state/State";
import { Store } from "../state/Store";
import { DiagnosticsFeed } from "./DiagnosticsFeed";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function feed() {
  const store = new Store<State>({ ...initialState, simulation: "house", scene: scene() });
  const topics = new Map<string, (message: never) => void>();
  const session = {
    subscribe: (topic: string, handler: (message: never) => void) => {
      topics.set(topic, handler);
      return () => topics.delete(topic);
    },
    parameter: vi.fn(async () => 4),
  };
  const figures = vi.fn(async () => new Map([["gsv_viewers", 1]]));
  new DiagnosticsFeed(store, session, { figures }).start();
  const open = (isOpen: boolean) => store.set({ diagnostics: { ...store.get().diagnostics, open: isOpen } });
  return { store, topics, session, figures, open };
}

test("nothing is asked or listened to while the panel is closed", async () => {
  const { topics, figures, open } = feed();
  expect(topics.size).toBe(0);
  open(true);
  expect([...topics.keys()]).toEqual(["/diagnostics"]);
  await vi.advanceTimersByTimeAsync(5000);
  expect(figures).toHaveBeenCalledTimes(3);
  open(false);
  expect(topics.size).toBe(0);
  await vi.advanceTimersByTimeAsync(60_000);
  expect(figures).toHaveBeenCalledTimes(3);
});

test("the first status is the simulation's, the others are robots'", async () => {
  const { store, topics, open } = feed();
  open(true);
  const status = (level: number, name: string) => ({ level, name, message: "m", values: [{ key: "k", value: "v" }] });
  topics.get("/diagnostics")!({ status: [status(1, "simulation"), status(2, "a"), status(3, "b")] } as never);
  await vi.advanceTimersByTimeAsync(0);
  const { simulation, robots, server, dropped } = store.get().diagnostics;
  expect(simulation).toEqual({ name: "simulation", health: "warning", message: "m", values: [["k", "v"]] });
  expect(robots.map(({ health }) => health)).toEqual(["error", "error"]);
  expect(server?.get("gsv_viewers")).toBe(1);
  expect(dropped).toBe(4);
});

test("a server without figures is no error", async () => {
  const { store, figures, session, open } = feed();
  figures.mockRejectedValue(new Error("404"));
  session.parameter.mockResolvedValue(null as never);
  open(true);
  await vi.advanceTimersByTimeAsync(0);
  expect(store.get().diagnostics).toEqual({ ...NO_DIAGNOSTICS, open: true });
});
