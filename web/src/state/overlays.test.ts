import { expect, test, vi } from "vitest";
import { FIRST_COLOURS, FIRST_SHOWN, OVERLAYS, OVERLAY_NAMES, keepColours, keepShown, loadColours, loadShown } from "./overlays";

const holding = (text: string | null) => ({ getItem: () => text });

test("the stored choice is restored", () => {
  const kept = new Map<string, string>();
  keepShown({ setItem: (key, value) => void kept.set(key, value) }, { ...FIRST_SHOWN, trails: true });
  const shown = loadShown({ getItem: (key) => kept.get(key) ?? null });
  expect(shown).toEqual({ ...FIRST_SHOWN, trails: true });
});

test.each([null, "", "[1]", "{", '"text"', '{"beams":"no","wings":true}'])(
  "with %j in its place it is as at first",
  (text) => {
    expect(loadShown(holding(text))).toEqual(FIRST_SHOWN);
  },
);

test("a missing or full storage causes no error", () => {
  expect(loadShown(null)).toEqual(FIRST_SHOWN);
  const setItem = vi.fn(() => {
    throw new DOMException("full", "QuotaExceededError");
  });
  keepShown({ setItem }, FIRST_SHOWN);
  expect(setItem).toHaveBeenCalledOnce();
});

test("each overlay has its own key", () => {
  expect(OVERLAYS.map(({ name }) => name)).toEqual([...OVERLAY_NAMES]);
  expect(new Set(OVERLAYS.map(({ key }) => key)).size).toBe(OVERLAYS.length);
});

test("the colours of points and trails are kept, and unknown ones are ignored", () => {
  const kept = new Map<string, string>();
  keepColours({ setItem: (key, value) => void kept.set(key, value) }, { points: "height", trails: "speed" });
  expect(loadColours({ getItem: (key) => kept.get(key) ?? null })).toEqual({ points: "height", trails: "speed" });
  for (const text of ["{", "null", '{"points":"toString","trails":7}']) {
    expect(loadColours(holding(text))).toEqual(FIRST_COLOURS);
  }
});
