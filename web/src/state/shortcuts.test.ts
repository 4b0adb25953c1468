import { expect, test, vi } from "vitest";
import { keepSingleKeys, loadSingleKeys } from "./shortcuts";

function storage() {
  const kept = new Map<string, string>();
  return {
    getItem: (key: string) => kept.get(key) ?? null,
    setItem: (key: string, value: string) => void kept.set(key, value),
  };
}

test("single keys are on until they are turned off, and the choice is kept", () => {
  const kept = storage();
  expect(loadSingleKeys(kept)).toBe(true);
  keepSingleKeys(kept, false);
  expect(loadSingleKeys(kept)).toBe(false);
  keepSingleKeys(kept, true);
  expect(loadSingleKeys(kept)).toBe(true);
});

test("single keys are on in a browser without storage", () => {
  const setItem = vi.fn(() => {
    throw new Error("full");
  });
  keepSingleKeys({ setItem }, false);
  keepSingleKeys(null, false);
  expect(loadSingleKeys(null)).toBe(true);
});
