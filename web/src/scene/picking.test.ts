import { PerspectiveCamera } from "three";
import { expect, test } from "vitest";
import { nearest, rayThrough } from "./picking";

const robots = [
  { name: "far", at: { x: 100, y: 100 } },
  { name: "near", at: { x: 110, y: 100 } },
  { name: "hidden", at: null },
];

test("a click beside small robots selects the nearest", () => {
  expect(nearest({ x: 112, y: 101 }, robots)).toBe("near");
  expect(nearest({ x: 101, y: 90 }, robots)).toBe("far");
});

test("a click far from all robots selects none", () => {
  expect(nearest({ x: 140, y: 100 }, robots)).toBeNull();
});

test("the ray through the image's right edge is at half the field of view", () => {
  const camera = new PerspectiveCamera(90, 2, 0.1, 10);
  camera.updateMatrixWorld(true);
  const frame = { left: 50, top: 20, width: 200, height: 100 } as DOMRect;
  const { direction } = rayThrough({ x: 250, y: 70 }, frame, camera).ray;
  expect(direction.x / -direction.z).toBeCloseTo(2, 9);
  expect(direction.y).toBeCloseTo(0, 9);
});
