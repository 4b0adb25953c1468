import { expect, test, vi } from "vitest";
import { Store, shallowEqual } from "./Store";

test("a watcher gets the present value at once, and then only changes", () => {
  const store = new Store({ count: 1, other: "a" });
  const listener = vi.fn();
  store.watch((state) => state.count, listener);
  store.set({ other: "b" });
  store.set({ count: 2 });
  store.set((state) => ({ count: state.count }));
  expect(listener.mock.calls).toEqual([
    [1, undefined],
    [2, 1],
  ]);
});

test("a removed watcher gets no more calls, even for the present change", () => {
  const store = new Store({ count: 0 });
  const second = vi.fn();
  let unwatchSecond = () => {};
  store.watch(
    (state) => state.count,
    (count) => {
      if (count === 1) unwatchSecond();
    },
  );
  unwatchSecond = store.watch((state) => state.count, second);
  store.set({ count: 1 });
  expect(second).toHaveBeenCalledTimes(1);
});

test("a new list with equal members is not a change", () => {
  const store = new Store({ robots: [{ name: "a" }, { name: "b" }], time: 0 });
  const listener = vi.fn();
  store.watch((state) => state.robots.map((robot) => robot.name), listener, shallowEqual);
  store.set({ time: 1 });
  store.set({ robots: [{ name: "a" }, { name: "b" }] });
  expect(listener).toHaveBeenCalledTimes(1);
  store.set({ robots: [{ name: "a" }] });
  expect(listener).toHaveBeenLastCalledWith(["a"], ["a", "b"]);
});

test("objects with different members are not equal", () => {
  expect(shallowEqual({ a: 1 }, { a: 1, b: undefined })).toBe(false);
  expect(shallowEqual({ a: 1 }, null)).toBe(false);
  expect(shallowEqual([1, 2], [1, 2])).toBe(true);
});
