// @vitest-environment jsdom
import { PerspectiveCamera } from "three";
import { expect, test } from "vitest";
import type { ShownState } from "../state/health";
import { SHOWN_STATES } from "../state/health";
import { StateMarks } from "./StateMarks";

const HEIGHT = 800;
const camera = new PerspectiveCamera(50, 1.6, 0.1, 1000);

// Returns marks for robots of 0.4 m at these distances along x.
function marks(robots: [distance: number, state: ShownState][], isChosen: ((robot: number) => boolean) | null = null) {
  const layer = new StateMarks();
  const tops = Float64Array.from(robots.flatMap(([distance]) => [distance, 0, 0]));
  const states = robots.map(([, state]) => SHOWN_STATES.indexOf(state));
  layer.place(tops, { states, radii: robots.map(() => 0.2), isChosen }, camera, HEIGHT, 1);
  const shown = layer.points.geometry.getAttribute("state").array.slice(0, layer.count);
  return { layer, shown: [...shown].map((state) => SHOWN_STATES[state]) };
}

test("a healthy robot has a mark only at a distance", () => {
  expect(marks([[5, "moving"]]).shown).toEqual([]);
  expect(marks([[100, "moving"], [5, "standing"]]).shown).toEqual(["moving"]);
});

test("a robot in trouble has a mark at any distance", () => {
  expect(marks([[5, "stuck"], [5, "moving"], [5, "dead"]]).shown).toEqual(["stuck", "dead"]);
});

test("a filter marks only the robots that it selects", () => {
  expect(marks([[5, "moving"], [100, "stuck"], [5, "standing"]], (robot) => robot !== 1).shown).toEqual(["moving", "standing"]);
});

test("the buffers grow when robots are added", () => {
  const { layer } = marks([[100, "moving"]]);
  const many = Array.from({ length: 300 }, (): [number, ShownState] => [100, "late"]);
  const tops = Float64Array.from(many.flatMap(([x]) => [x, 0, 0]));
  layer.place(tops, { states: many.map(() => 3), radii: many.map(() => 0.2), isChosen: null }, camera, HEIGHT, 1);
  expect(layer.count).toBe(300);
});

test("a view without robots has no marks", () => {
  const layer = new StateMarks();
  layer.place(new Float64Array(0), { states: [], radii: [], isChosen: null }, camera, HEIGHT, 1);
  expect(layer.count).toBe(0);
});
