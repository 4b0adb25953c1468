import type { InterleavedBufferAttribute } from "three";
import { Matrix4 } from "three";
import { expect, test } from "vitest";
import type { RobotBeams } from "../protocol/beams";
import type { Point } from "../protocol/messages";
import { BeamLayer } from "./BeamLayer";

const BLUE = [0, 0, 1];
const YELLOW = [1, 1, 0];

function beamsFrom(robot: string, points: Point[], colour = BLUE): RobotBeams {
  return {
    robot,
    stamp: 0,
    points: Float64Array.from(points.flatMap(({ x, y, z }) => [x, y, z])),
    colours: Float32Array.from(points.flatMap(() => colour)),
  };
}

function drawn(layer: BeamLayer): number[] {
  const starts = layer.lines.geometry.getAttribute("instanceStart") as InterleavedBufferAttribute;
  return Array.from(starts.data.array.slice(0, 6 * layer.segments));
}

const beam = [
  { x: 3, y: 0, z: 0.2 },
  { x: 5, y: 0, z: 0.2 },
];

test("a beam moves and rotates with its robot", () => {
  const layer = new BeamLayer(10_000);
  layer.setRobot(beamsFrom("a", beam), new Matrix4().makeTranslation(2, 0, 0));
  const shown = new Matrix4().makeRotationZ(Math.PI / 2).setPosition(0, 10, 0);
  layer.place(() => shown, () => 0);
  const expected = [0, 11, 0.2, 0, 13, 0.2];
  drawn(layer).forEach((value, i) => expect(value).toBeCloseTo(expected[i]!, 6));
});

test("beams without a robot are not drawn", () => {
  const layer = new BeamLayer(10_000);
  layer.setRobot(beamsFrom("a", beam), new Matrix4());
  layer.place(() => null, () => 0);
  expect(layer.segments).toBe(0);
});

test("each end has its own colour", () => {
  const layer = new BeamLayer(10_000);
  layer.setRobot(beamsFrom("a", beam, YELLOW), new Matrix4());
  layer.setRobot(beamsFrom("b", beam), new Matrix4());
  layer.place(() => new Matrix4(), () => 0);
  const colours = layer.lines.geometry.getAttribute("instanceColorStart");
  expect([colours.getX(0), colours.getY(0), colours.getZ(0)]).toEqual([1, 1, 0]);
  expect([colours.getX(1), colours.getY(1), colours.getZ(1)]).toEqual(BLUE);
});

test("the buffers grow for the beams of many robots", () => {
  const layer = new BeamLayer(10_000);
  const many = Array.from({ length: 48 }, (_, i) => ({ x: i, y: 0, z: 0 }));
  for (let robot = 0; robot < 100; robot++) layer.setRobot(beamsFrom(`r${robot}`, many), new Matrix4());
  layer.place(() => new Matrix4(), () => 0);
  expect(layer.segments).toBe(2400);
  expect(drawn(layer).at(-3)).toBe(47);
});

test("if there are too many beams, those of the first robots are drawn completely", () => {
  const layer = new BeamLayer(5);
  const two = [...beam, ...beam];
  for (const robot of ["c", "a", "b"]) layer.setRobot(beamsFrom(robot, two), new Matrix4());
  const at = (robot: string) => new Matrix4().makeTranslation(0, "abc".indexOf(robot), 0);
  layer.place(at, (_robot, frame) => frame.elements[13]!);
  expect(layer.segments).toBe(4);
  expect(drawn(layer).filter((_, i) => i % 3 === 1)).toEqual([0, 0, 0, 0, 1, 1, 1, 1]);
});

test("the lines of a robot that has no more beams are removed", () => {
  const layer = new BeamLayer(10_000);
  layer.setRobot(beamsFrom("a", beam), new Matrix4());
  layer.setRobot(beamsFrom("b", beam), new Matrix4());
  layer.setRobot(beamsFrom("a", []), new Matrix4());
  layer.keepOnly(new Set(["a"]));
  layer.place(() => new Matrix4(), () => 0);
  expect(layer.segments).toBe(0);
});

test("thin lines have the same ends and colours, and their number is set", () => {
  const layer = new BeamLayer(10_000, true);
  layer.setRobot(beamsFrom("a", beam, YELLOW), new Matrix4().makeTranslation(1, 0, 0));
  layer.place(() => new Matrix4(), () => 0);
  const { geometry } = layer.lines;
  const numbers = (name: string) => Array.from(geometry.getAttribute(name).array.slice(0, 6));
  [2, 0, 0.2, 4, 0, 0.2].forEach((value, i) => expect(numbers("position")[i]).toBeCloseTo(value, 6));
  expect(numbers("color")).toEqual([1, 1, 0, 1, 1, 0]);
  expect(geometry.drawRange).toMatchObject({ start: 0, count: 2 });
});
