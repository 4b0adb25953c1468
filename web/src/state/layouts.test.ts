import { expect, test } from "vitest";
import { fileOf, fromFile, keepLayouts, loadLayouts } from "./layouts";

function storage(kept: string | null = null) {
  const items = new Map(kept === null ? [] : [["gsv.layouts", kept]]);
  return {
    getItem: (key: string) => items.get(key) ?? null,
    setItem: (key: string, value: string) => void items.set(key, value),
  };
}

test("saved layouts are loaded again", () => {
  const own = storage();
  const saved = [{ name: "Mine", text: "r(view~500)" }];
  expect(keepLayouts(own, saved)).toBe(true);
  expect(loadLayouts(own)).toEqual(saved);
});

test.each(["{", "null", "7", '[{"name":1}]', '[{"name":"","text":"view"}]', '[null]'])("an invalid stored text (%s) is ignored", (kept) => {
  expect(loadLayouts(storage(kept))).toEqual([]);
});

test("a browser without storage reports it", () => {
  expect(keepLayouts(null, [])).toBe(false);
  const full = { setItem: () => { throw new Error("full"); } };
  expect(keepLayouts(full, [])).toBe(false);
});

test("a layout is unchanged after saving and loading a file", () => {
  const saved = { name: "Night shift", text: "r(view~700,log~300)" };
  expect(fromFile(fileOf(saved))).toEqual(saved);
});

test.each([
  ["view", "it is not JSON"],
  ["null", 'it has no "gsv_layout"'],
  ['{"gsv_layout": 2, "layout": "view"}', "it has version 2; this page reads version 1"],
  ['{"gsv_layout": 1}', 'it has no text "layout"'],
])("the file %s is refused: %s", (content, problem) => {
  expect(fromFile(content)).toEqual({ problem });
});
