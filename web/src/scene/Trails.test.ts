import { expect, test } from "vitest";
import { LineLayer } from "./LineLayer";
import { Trails } from "./Trails";

function drawn(trails: Trails): number {
  const lines = new LineLayer({});
  lines.begin();
  trails.draw(lines);
  lines.finish();
  return lines.segments;
}

const at = (x: number, name = "a") => [{ name, x, y: 0, z: 0 }];

test("a trail connects the places of a moving robot", () => {
  const trails = new Trails();
  [0, 0.1, 0.1, 0.11, 0.2].forEach((x, i) => trails.push(i, at(x)));
  expect(drawn(trails)).toBe(2);
});

test("a trail has a limited number of places", () => {
  const trails = new Trails();
  for (let i = 0; i < 5000; i++) trails.push(i, at(0.1 * i));
  expect(drawn(trails)).toBe(399);
  const crowd = Array.from({ length: 1000 }, (_, i) => ({ name: `r${i}`, x: 0, y: i, z: 0 }));
  trails.push(5001, crowd);
  trails.push(
    5002,
    crowd.map((robot) => ({ ...robot, x: 1 })),
  );
  expect(drawn(trails)).toBe(399 + 199);
});

test("a reset starts again, and a jump leaves no line across the world", () => {
  const trails = new Trails();
  trails.push(1, at(0));
  trails.push(2, at(0.1));
  trails.push(0, at(0));
  expect(drawn(trails)).toBe(0);
  trails.push(1, at(0.1));
  trails.push(2, at(9));
  trails.push(3, at(9.1));
  expect(drawn(trails)).toBe(1);
});

test("removed robots have no trail", () => {
  const trails = new Trails();
  for (const name of ["a", "b"]) {
    trails.push(1, at(0, name));
    trails.push(2, at(1, name));
  }
  trails.keepOnly(new Set(["b"]));
  expect(drawn(trails)).toBe(1);
});
