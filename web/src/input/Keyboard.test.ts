// @vitest-environment jsdom
import { expect, test, vi } from "vitest";
import type { App } from "../app/App";
import type { ReplayControl } from "../app/ReplayControl";
import { initialState } from "../state/State";
import { commandOf, isSingleKey, isTyping, listenForKeys, replayCommandOf } from "./Keyboard";

const plain = { ctrlKey: false, altKey: false, metaKey: false };

function pressed(key: string) {
  const app = {
    startPauseOrResume: vi.fn(),
    topView: vi.fn(),
    escape: vi.fn(),
    toggleViewMode: vi.fn(),
    toggle: vi.fn(),
  };
  commandOf({ ...plain, key })?.(app as unknown as App);
  return Object.entries(app).flatMap(([name, { mock }]) => mock.calls.map((call) => [name, ...call]));
}

test("keys work in upper and lower case", () => {
  expect(pressed("t")).toEqual([["topView"]]);
  expect(pressed("T")).toEqual([["topView"]]);
  expect(pressed(" ")).toEqual([["startPauseOrResume"]]);
  expect(pressed("Escape")).toEqual([["escape"]]);
  expect(pressed("c")).toEqual([["toggleViewMode", "chase"]]);
  expect(pressed("5")).toEqual([["toggle", "trails"]]);
  expect(pressed("B")).toEqual([["toggle", "masses"]]);
});

test("other keys have no command", () => {
  for (const key of ["z", "'", "toString", "constructor"]) expect(commandOf({ ...plain, key })).toBeNull();
});

test("the browser's shortcuts still work", () => {
  expect(commandOf({ ...plain, key: "r", ctrlKey: true })).toBeNull();
  expect(commandOf({ ...plain, key: "t", metaKey: true })).toBeNull();
});

test("a recording's keys step, jump and find events", () => {
  const replay = { step: vi.fn(), toStart: vi.fn(), toEnd: vi.fn(), toEvent: vi.fn() };
  const press = (key: string, shiftKey = false) =>
    replayCommandOf({ ...plain, key, shiftKey })?.(replay as unknown as ReplayControl);
  press("ArrowLeft");
  press("ArrowRight");
  press("ArrowLeft", true);
  expect(replay.step.mock.calls).toEqual([[-1], [1], [-10]]);
  press("Home");
  expect(replay.toStart).toHaveBeenCalledOnce();
  press("End");
  expect(replay.toEnd).toHaveBeenCalledOnce();
  press(",");
  press(".");
  expect(replay.toEvent.mock.calls).toEqual([[-1], [1]]);
  expect(replayCommandOf({ ...plain, key: "ArrowLeft", altKey: true })).toBeNull();
});

test("Space runs and pauses after a click on a button, but presses a button that was focused by keyboard", () => {
  const startPauseOrResume = vi.fn();
  const state = { replay: null, setUp: null, editing: null, singleKeys: true, changedKeys: {} };
  listenForKeys({ startPauseOrResume, store: { get: () => state } } as unknown as App);
  document.body.innerHTML = "<button>Top view</button>";
  const button = document.querySelector("button")!;
  const space = () =>
    document.activeElement!.dispatchEvent(new KeyboardEvent("keydown", { key: " ", bubbles: true }));
  button.focus();
  space();
  button.dispatchEvent(new MouseEvent("click", { detail: 0, bubbles: true })); // as if Enter was pressed
  space();
  expect(startPauseOrResume).not.toHaveBeenCalled();
  button.dispatchEvent(new MouseEvent("click", { detail: 1, bubbles: true }));
  space();
  expect(startPauseOrResume).toHaveBeenCalledOnce();
});

test("the timeline's slider leaves keys to the page", () => {
  document.body.innerHTML = '<input type="range">';
  expect(isTyping(document.querySelector("input"))).toBe(false);
});

test("keys have no effect while somebody types or chooses", () => {
  document.body.innerHTML = "<input><select></select><dialog open><button></button></dialog><dialog class=closed><input></dialog><p></p>";
  expect(isTyping(document.querySelector("input"))).toBe(true);
  expect(isTyping(document.querySelector("select"))).toBe(true);
  expect(isTyping(document.querySelector("dialog button"))).toBe(true);
  expect(isTyping(document.querySelector(".closed input"))).toBe(false);
  expect(isTyping(document.querySelector("p"))).toBe(false);
  expect(isTyping(window)).toBe(false);
});

test("a panel's key opens and closes it", () => {
  const toggle = vi.fn();
  const app = { panels: { toggle }, store: { get: () => initialState } } as unknown as App;
  commandOf({ ...plain, key: "i" })?.(app);
  commandOf({ ...plain, key: "G" })?.(app);
  expect(toggle.mock.calls).toEqual([["status"], ["log"]]);
});

test("characters are single keys, but named keys and keys with Ctrl are not", () => {
  for (const key of ["a", "A", "?", " ", "5", "é"]) expect(isSingleKey({ ...plain, key })).toBe(true);
  for (const key of ["Escape", "ArrowLeft", "Delete", "F1"]) expect(isSingleKey({ ...plain, key })).toBe(false);
  expect(isSingleKey({ ...plain, key: "z", ctrlKey: true })).toBe(false);
});

test("with single keys turned off, letters have no effect, but Esc has", () => {
  const app = {
    topView: vi.fn(),
    escape: vi.fn(),
    store: { get: () => ({ ...initialState, singleKeys: false }) },
  };
  const page = document.createElement("div");
  listenForKeys(app as unknown as App, page as unknown as Window);
  for (const key of ["t", "Escape"]) page.dispatchEvent(new KeyboardEvent("keydown", { key }));
  expect(app.topView).not.toHaveBeenCalled();
  expect(app.escape).toHaveBeenCalled();
});

test("a button that was clicked loses the focus, except in a dialog", () => {
  const app = { store: { get: () => initialState } } as unknown as App;
  const page = document.createElement("div");
  page.innerHTML = "<button>Pause</button><dialog open><button>I</button></dialog>";
  document.body.replaceChildren(page);
  listenForKeys(app, page as unknown as Window);
  const keepsFocus = [...page.querySelectorAll("button")].map((button) => {
    button.focus();
    button.dispatchEvent(new MouseEvent("click", { detail: 1, bubbles: true }));
    return document.activeElement === button;
  });
  expect(keepsFocus).toEqual([false, true]);
});
