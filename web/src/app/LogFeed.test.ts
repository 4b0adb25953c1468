import { expect, test, vi } from "vitest";
import { scene } from "../scene/testScene";
import type { LogLine } from "../state/log";
import { NO_LOG } from "../state/log";
import type { State } from "../state/State";
import { initialState } from "../state/State";
import { Store } from "../state/Store";
import { LogFeed } from "./LogFeed";
import type { Session } from "./Session";

const REPLAY = { start: 0, end: 20, speed: 1, loop: false };
const LINE: LogLine = { time: 3, level: 20, name: "gsv", text: "started" };

function feeding(recorded: () => Promise<LogLine[]> = async () => [LINE]) {
  const store = new Store<State>({ ...initialState, simulation: "house", scene: scene({ bodies: [], poses: [] }) });
  const heard = new Map<string, (message: unknown) => void>();
  const subscribe = (topic: string, handler: (message: unknown) => void) => {
    heard.set(topic, handler);
    return () => heard.delete(topic);
  };
  const log = vi.fn(recorded);
  new LogFeed(store, { subscribe } as unknown as Session, { log }).start();
  const open = (isOpen: boolean) => store.set({ log: { ...store.get().log, open: isOpen } });
  return { store, heard, log, open };
}

function message(sec: number, msg: string) {
  return { stamp: { sec, nsec: 0 }, level: 30, name: "a", msg };
}

test("what runs is heard from when the log is first opened, and goes on when it is closed", () => {
  const { store, heard, open } = feeding();
  expect(heard.size).toBe(0);
  open(true);
  heard.get("/rosout")!(message(1, "low battery"));
  open(false);
  heard.get("/rosout")!(message(2, "empty"));
  open(true);
  expect(store.get().log.lines).toEqual([
    { time: 1, level: 30, name: "a", text: "low battery" },
    { time: 2, level: 30, name: "a", text: "empty" },
  ]);
});

test("another simulation has a log of its own", () => {
  const { store, heard, open } = feeding();
  open(true);
  heard.get("/rosout")!(message(1, "x"));
  store.set({ simulation: "office", scene: null });
  expect(store.get().log.lines).toEqual([]);
  expect(heard.size).toBe(0);
  store.set({ scene: scene({ bodies: [], poses: [] }) });
  expect(heard.size).toBe(1);
});

test("of a recording all lines are fetched, once", async () => {
  const { store, heard, log, open } = feeding();
  store.set({ replay: REPLAY });
  open(true);
  open(false);
  open(true);
  await vi.waitFor(() => expect(store.get().log.lines).toEqual([LINE]));
  expect(log).toHaveBeenCalledTimes(1);
  expect(heard.size).toBe(0);
});

test("a log that cannot be read is told of", async () => {
  const { store, open } = feeding(() => Promise.reject(new Error("no such file")));
  store.set({ replay: REPLAY, log: NO_LOG });
  open(true);
  await vi.waitFor(() => expect(store.get().notices).toHaveLength(1));
  expect(store.get().notices[0]!.sentence).toBe("The log cannot be read: no such file");
});
