import { expect, test } from "vitest";
import type { Slot } from "./Shelves";
import { Shelves } from "./Shelves";

test("slots fill a row before the next one, until all rows are full", () => {
  const shelves = new Shelves(10, 2);
  expect(shelves.add(6)).toEqual({ row: 0, x: 0, width: 6 });
  expect(shelves.add(5)).toEqual({ row: 1, x: 0, width: 5 });
  expect(shelves.add(4)).toEqual({ row: 0, x: 6, width: 4 });
  expect(shelves.add(6)).toBeNull();
  shelves.addRows(1);
  expect(shelves.add(6)).toEqual({ row: 2, x: 0, width: 6 });
});

test("a slot that is wider than a row is rejected", () => {
  expect(new Shelves(10, 3).add(11)).toBeNull();
});

test("removed slots join with the gaps beside them", () => {
  const shelves = new Shelves(10, 1);
  const [a, b, c] = [3, 3, 4].map((width) => shelves.add(width)!) as [Slot, Slot, Slot];
  shelves.remove(a);
  shelves.remove(c);
  expect(shelves.add(5)).toBeNull();
  shelves.remove(b);
  expect(shelves.add(10)).toEqual({ row: 0, x: 0, width: 10 });
});

test("in any sequence of additions and removals, slots neither overlap nor get lost", () => {
  const length = 100;
  const shelves = new Shelves(length, 5);
  const used: Slot[] = [];
  let seed = 1;
  const random = (below: number) => (seed = (48271 * seed) % 2147483647) % below;
  for (let i = 0; i < 3000; i++) {
    const slot = random(3) > 0 ? shelves.add(1 + random(30)) : null;
    if (slot) {
      expect(slot.x >= 0 && slot.x + slot.width <= length).toBe(true);
      expect(used.some((other) => other.row === slot.row && other.x < slot.x + slot.width && slot.x < other.x + other.width)).toBe(false);
      used.push(slot);
    } else if (used.length > 0) {
      shelves.remove(used.splice(random(used.length), 1)[0]!);
    }
  }
  for (const slot of used) shelves.remove(slot);
  for (let row = 0; row < 5; row++) expect(shelves.add(length)).toEqual({ row, x: 0, width: length });
});
