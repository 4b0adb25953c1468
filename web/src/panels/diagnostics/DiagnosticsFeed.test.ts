import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { ServerFigures } from "../../api/MetricsApi";
import { Store } from "../../state/Store";
import { testPorts } from "../contract/testPorts";
import { DiagnosticsFeed } from "./DiagnosticsFeed";
import type { Diagnostics } from "./diagnostics";
import { NO_DIAGNOSTICS } from "./diagnostics";

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function feeding(answer: () => Promise<ServerFigures> = async () => new Map([["gsv_viewers", 1]]), dropped: number | null = 4) {
  const figures = vi.fn(answer);
  const { topics, ports } = testPorts({}, { figures, parameter: async () => dropped });
  const store = new Store<Diagnostics>(NO_DIAGNOSTICS);
  return { store, topics, figures, feed: new DiagnosticsFeed(store, topics, ports.server) };
}

test("requests and subscriptions exist only between start and end", async () => {
  const { topics, figures, feed } = feeding();
  expect(topics.read).toEqual([]);
  const end = feed.start();
  expect(topics.read).toEqual(["/diagnostics"]);
  await vi.advanceTimersByTimeAsync(5000);
  expect(figures).toHaveBeenCalledTimes(3);
  end();
  expect(topics.read).toEqual([]);
  await vi.advanceTimersByTimeAsync(60_000);
  expect(figures).toHaveBeenCalledTimes(3);
});

test("the first diagnostic status is that of the simulation, the others are those of robots", async () => {
  const { store, topics, feed } = feeding();
  feed.start();
  const status = (level: number, name: string) => ({ level, name, message: "m", values: [{ key: "k", value: "v" }] });
  topics.send("/diagnostics", { status: [status(1, "simulation"), status(2, "a"), status(3, "b")] });
  await vi.advanceTimersByTimeAsync(0);
  const { simulation, robots, server, dropped } = store.get();
  expect(simulation).toEqual({ name: "simulation", health: "warning", message: "m", values: [["k", "v"]] });
  expect(robots.map(({ health }) => health)).toEqual(["error", "error"]);
  expect(server?.get("gsv_viewers")).toBe(1);
  expect(dropped).toBe(4);
});

test("a server without metrics is not an error", async () => {
  const { store, feed } = feeding(() => Promise.reject(new Error("404")), null);
  feed.start();
  await vi.advanceTimersByTimeAsync(0);
  expect(store.get()).toEqual(NO_DIAGNOSTICS);
});
