// @vitest-environment jsdom
import { expect, test } from "vitest";
import { scene } from "../../scene/testScene";
import type { State } from "../../state/State";
import { Store } from "../../state/Store";
import { element } from "../../ui/element";
import { testPorts } from "../contract/testPorts";
import type { Log, LogLine } from "./log";
import { NO_LOG } from "./log";
import { mount, panelOf } from "./LogPanel";

const LINES: LogLine[] = [
  { time: 0, level: 20, name: "gsv", text: "started" },
  { time: 2, level: 40, name: "pebble", text: "agent dead: <b>it ended</b>" },
  { time: 4, level: 20, name: "gsv", text: "finished" },
];

function panelIn(state: Partial<State> = {}, lines: LogLine[] = LINES) {
  const { ports, store } = testPorts({ time: 4, ...state });
  const { body, tools = [], whileOpen } = panelOf(new Store<Log>({ ...NO_LOG, lines }), ports);
  const panel = element("section", {}, ...tools, body);
  whileOpen?.();
  const texts = () => [...panel.querySelectorAll(".log-text")].map(({ textContent }) => textContent);
  return { ports, store, panel, texts };
}

test("lines show time, level, name and text, and markup in them is text", () => {
  const { panel } = panelIn();
  const row = panel.querySelectorAll(".log-line")[1]!;
  expect([...row.children].map(({ textContent }) => textContent)).toEqual([
    "0:02.00",
    "error",
    "pebble",
    "agent dead: <b>it ended</b>",
  ]);
  expect(row.classList.contains("error")).toBe(true);
  expect(panel.querySelector("b")).toBeNull();
});

test("level and text filter the lines", () => {
  const { panel, texts } = panelIn();
  const level = panel.querySelector("select")!;
  level.value = "40";
  level.dispatchEvent(new Event("change"));
  expect(texts()).toEqual(["agent dead: <b>it ended</b>"]);
  level.value = "0";
  level.dispatchEvent(new Event("change"));
  const field = panel.querySelector("input")!;
  field.value = "FIN";
  field.dispatchEvent(new Event("input"));
  expect(texts()).toEqual(["finished"]);
  field.value = "nowhere";
  field.dispatchEvent(new Event("input"));
  expect(panel.querySelector<HTMLElement>(".log-empty")!.hidden).toBe(false);
  expect(panel.querySelector(".log-empty")!.textContent).toContain("No message matches");
});

test("an empty log explains its content", () => {
  const { panel } = panelIn({}, []);
  expect(panel.querySelector(".log-empty")!.textContent).toContain("No messages yet");
});

test("in a recording, later lines are marked as future, and a click goes to a line", () => {
  const replay = { start: 0, end: 4, speed: 1, loop: false };
  const { ports, store, panel } = panelIn({ replay, time: 2 });
  const toCome = () => [...panel.querySelectorAll(".log-line")].map((row) => row.classList.contains("to-come"));
  expect(toCome()).toEqual([false, false, true]);
  store.set({ time: 1 });
  expect(toCome()).toEqual([false, true, true]);
  panel.querySelectorAll<HTMLButtonElement>("button.log-time")[2]!.click();
  expect(ports.replay.seek).toHaveBeenCalledWith(4);
});

test("of very many lines, only those near the present instant have rows", () => {
  const lines = Array.from({ length: 3000 }, (_, i) => ({ ...LINES[0]!, time: i, text: `line ${i}` }));
  const replay = { start: 0, end: 3000, speed: 1, loop: false };
  const { store, texts } = panelIn({ replay, time: 0 }, lines);
  expect(texts()).toHaveLength(500);
  expect(texts()[0]).toBe("line 0");
  store.set({ time: 2000 });
  expect(texts()).toHaveLength(500);
  expect(texts()).toContain("line 2000");
});

test("lines that arrive while it is closed are shown when it is opened again", () => {
  const { ports, topics } = testPorts({ scene: scene({ bodies: [], poses: [] }) });
  const { body, whileOpen } = mount(ports);
  const say = (msg: string) => topics.send("/rosout", { stamp: { sec: 1, nsec: 0 }, level: 30, name: "a", msg });
  const texts = () => [...body.querySelectorAll(".log-text")].map(({ textContent }) => textContent);
  const close = whileOpen!();
  say("low battery");
  close();
  say("empty");
  expect(texts()).toEqual(["low battery"]);
  whileOpen!();
  expect(texts()).toEqual(["low battery", "empty"]);
});
