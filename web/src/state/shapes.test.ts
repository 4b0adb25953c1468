import { expect, test } from "vitest";
import { FIRST_SHAPE, faultOf, footprintOf, modelOf, wallBetween } from "./shapes";

test("a shape is a model that the server knows by its name", () => {
  const box = { ...FIRST_SHAPE, mass: 8, colour: "ff8800" };
  expect(modelOf(box)).toBe("shape:box?size=0.4,0.4,0.4&mass=8&static=false&colour=ff8800");
  expect(modelOf({ ...box, kind: "sphere", isStatic: true })).toBe("shape:sphere?radius=0.2&static=true&colour=ff8800");
  expect(modelOf({ ...box, kind: "cylinder", height: 1 })).toContain("shape:cylinder?radius=0.2&length=1&mass=8");
});

test("impossible lengths and masses are refused with a sentence", () => {
  expect(faultOf(FIRST_SHAPE)).toBe("");
  expect(faultOf({ ...FIRST_SHAPE, width: 0 })).toMatch(/width must be/);
  expect(faultOf({ ...FIRST_SHAPE, height: NaN })).toMatch(/height must be/);
  expect(faultOf({ ...FIRST_SHAPE, mass: 0 })).toMatch(/mass must be/);
  expect(faultOf({ ...FIRST_SHAPE, mass: 0, isStatic: true })).toBe("");
  expect(faultOf({ ...FIRST_SHAPE, kind: "sphere", width: 0 })).toBe(""); // a sphere has no width
});

test("a wall reaches from one point to another", () => {
  const { shape, place } = wallBetween({ x: 1, y: 1 }, { x: 1, y: 4 }, { thickness: 0.1, height: 2, colour: "b4b4b4" });
  expect([shape.length, shape.width, shape.height, shape.isStatic]).toEqual([3, 0.1, 2, true]);
  expect([place.x, place.y]).toEqual([1, 2.5]);
  expect(place.yaw).toBeCloseTo(Math.PI / 2);
  expect(footprintOf({ ...FIRST_SHAPE, length: 3, width: 4 })).toBe(2.5);
});
