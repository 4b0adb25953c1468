import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { State } from "../state/State";
import { initialState } from "../state/State";
import { Store } from "../state/Store";
import { notify } from "./notices";

beforeEach(() => vi.useFakeTimers());
afterEach(() => vi.useRealTimers());

test("a long note stays until it can be read, and a short one for six seconds", () => {
  const store = new Store<State>(initialState);
  const sentences = () => store.get().notices.map(({ sentence }) => sentence);
  const long = "x".repeat(300);
  notify(store, "note", "short");
  notify(store, "note", long);
  vi.advanceTimersByTime(5_999);
  expect(sentences()).toEqual(["short", long]);
  vi.advanceTimersByTime(1);
  expect(sentences()).toEqual([long]);
  vi.advanceTimersByTime(11_999);
  expect(sentences()).toEqual([long]);
  vi.advanceTimersByTime(1);
  expect(sentences()).toEqual([]);
});
