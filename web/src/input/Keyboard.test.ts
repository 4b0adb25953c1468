// @vitest-environment jsdom
import { expect, test } from "vitest";
import { commandOf, isTyping } from "./Keyboard";

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

test("keys are left alone where somebody types or chooses", () => {
  document.body.innerHTML = "<input><select></select><dialog><button></button></dialog><p></p>";
  expect(isTyping(document.querySelector("input"))).toBe(true);
  expect(isTyping(document.querySelector("select"))).toBe(true);
  expect(isTyping(document.querySelector("dialog button"))).toBe(true);
  expect(isTyping(document.querySelector("p"))).toBe(false);
  expect(isTyping(window)).toBe(false);
});
