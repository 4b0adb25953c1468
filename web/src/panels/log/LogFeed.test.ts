import { expect, test, vi } from "vitest";
import { scene } from "../../scene/testScene";
import type { State } from "../../state/State";
import { Store } from "../../state/Store";
import { testPorts } from "../contract/testPorts";
import { LogFeed } from "./LogFeed";
import type { Log, LogLine } from "./log";
import { NO_LOG } from "./log";

const REPLAY = { start: 0, end: 20, speed: 1, loop: false };
const LINE: LogLine = { time: 3, level: 20, name: "gsv", text: "started" };
const SCENE = scene({ bodies: [], poses: [] });

function feeding(state: Partial<State> = {}, recorded: () => Promise<LogLine[]> = async () => [LINE]) {
  const { store, topics, ports } = testPorts({ scene: SCENE, ...state }, { log: vi.fn(recorded) });
  const log = new Store<Log>(NO_LOG);
  new LogFeed(log, ports).start();
  return { store, topics, ports, lines: () => log.get().lines };
}

function message(sec: number, msg: string) {
  return { stamp: { sec, nsec: 0 }, level: 30, name: "a", msg };
}

test("the log of a live simulation is subscribed", () => {
  const { topics, lines } = feeding();
  topics.send("/rosout", message(1, "low battery"));
  topics.send("/rosout", message(2, "empty"));
  expect(lines()).toEqual([
    { time: 1, level: 30, name: "a", text: "low battery" },
    { time: 2, level: 30, name: "a", text: "empty" },
  ]);
});

test("another simulation has its own log", () => {
  const { store, topics, lines } = feeding();
  topics.send("/rosout", message(1, "x"));
  store.set({ simulation: "office", scene: null });
  expect(lines()).toEqual([]);
  expect(topics.read).toEqual([]);
  store.set({ scene: SCENE });
  expect(topics.read).toEqual(["/rosout"]);
});

test("all lines of a recording are fetched once", async () => {
  const { store, topics, ports, lines } = feeding({ replay: REPLAY });
  await vi.waitFor(() => expect(lines()).toEqual([LINE]));
  store.set({ time: 4 });
  expect(ports.server.log).toHaveBeenCalledTimes(1);
  expect(topics.read).toEqual([]);
});

test("a log that cannot be read is reported", async () => {
  const { ports } = feeding({ replay: REPLAY }, () => Promise.reject(new Error("no such file")));
  await vi.waitFor(() =>
    expect(ports.notices.notify).toHaveBeenCalledWith("error", "Cannot read the log: no such file"),
  );
});

test("a reset removes the lines of the earlier run, so that equal lines of the new run are shown", () => {
  const { topics, lines } = feeding();
  for (let run = 0; run < 2; run++) {
    topics.send("/rosout", message(3, "agent dead"));
    topics.send("/rosout", { ...message(0, "reset"), name: "gsv" });
  }
  topics.send("/rosout", message(3, "agent dead"));
  expect(lines().map(({ text }) => text)).toEqual(["reset", "agent dead"]);
});
