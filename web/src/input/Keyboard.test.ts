// @vitest-environment jsdom
import { expect, test, vi } from "vitest";
import type { ReplayControl } from "../app/ReplayControl";
import { commandOf, isTyping, replayCommandOf } from "./Keyboard";

const plain = { ctrlKey: false, altKey: false, metaKey: false };

test("keys have their commands in either case", () => {
  expect(commandOf({ ...plain, key: "t" })).toBe("top-view");
  expect(commandOf({ ...plain, key: "T" })).toBe("top-view");
  expect(commandOf({ ...plain, key: " " })).toBe("start-pause-resume");
  expect(commandOf({ ...plain, key: "Escape" })).toBe("deselect");
  expect(commandOf({ ...plain, key: "x" })).toBeNull();
});

test("the browser keeps its own shortcuts", () => {
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

test("the timeline's slider leaves keys to the page", () => {
  document.body.innerHTML = '<input type="range">';
  expect(isTyping(document.querySelector("input"))).toBe(false);
});

test("keys are left alone where somebody types or chooses", () => {
  document.body.innerHTML = "<input><select></select><dialog><button></button></dialog><p></p>";
  expect(isTyping(document.querySelector("input"))).toBe(true);
  expect(isTyping(document.querySelector("select"))).toBe(true);
  expect(isTyping(document.querySelector("dialog button"))).toBe(true);
  expect(isTyping(document.querySelector("p"))).toBe(false);
  expect(isTyping(window)).toBe(false);
});
