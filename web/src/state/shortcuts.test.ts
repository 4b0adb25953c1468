import { expect, test, vi } from "vitest";
import { keepChangedKeys, keepSingleKeys, keyOf, loadChangedKeys, loadSingleKeys, originalKey, withChangedKey } from "./shortcuts";

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

test("a changed key runs its command, the former key runs none, and two commands never share a key", () => {
  const changed = withChangedKey({}, "P", "z");
  expect(keyOf("p", changed)).toBe("z");
  // By default, no command has the key Z. So after the change, no command has the key P.
  expect([originalKey("Z", changed), originalKey("p", changed), originalKey("g", changed)]).toEqual(["p", "z", "g"]);
  const swapped = withChangedKey(changed, "g", "z");
  expect([keyOf("g", swapped), keyOf("p", swapped)]).toEqual(["z", "g"]);
  expect(withChangedKey(withChangedKey({}, "p", "z"), "p", "p")).toEqual({});
});

test("changed keys are stored, and invalid keys are omitted", () => {
  const kept = storage();
  keepChangedKeys(kept, { p: "z" });
  expect(loadChangedKeys(kept)).toEqual({ p: "z" });
  kept.setItem("gsv.keys", '{"p":"zz","g":1,"k":"b"}');
  expect(loadChangedKeys(kept)).toEqual({ k: "b" });
  kept.setItem("gsv.keys", "{");
  expect(loadChangedKeys(kept)).toEqual({});
});
