import { DirectionalLight, Sphere, Vector3 } from "three";
import { expect, test } from "vitest";
import { FittedShadow } from "./FittedShadow";

const DOWN = new Vector3(0, 0, -1);

function shadowOf(radius: number) {
  const sun = new DirectionalLight();
  const shadow = new FittedShadow(sun, DOWN, new Sphere(new Vector3(), radius));
  return { sun, fit: (eye: number[], target: number[]) => shadow.fit(new Vector3(...eye), new Vector3(...target)) };
}

test("from afar, the shadows cover the world", () => {
  const { sun, fit } = shadowOf(20);
  expect(sun.shadow.camera.right).toBe(20);
  expect(fit([0, 0, 30], [4, 0, 0])).toBe(false);
  expect(sun.target.position.toArray()).toEqual([0, 0, 0]);
});

test("near a robot, the shadows cover its surroundings with smaller texels, and every point that is seen at four times its distance", () => {
  const { sun, fit } = shadowOf(20);
  expect(fit([5, 0, 1], [5, 0, 0])).toBe(true);
  expect(sun.shadow.camera.right).toBeGreaterThanOrEqual(4);
  expect(sun.shadow.camera.right).toBeLessThan(4 * Math.SQRT2);
  expect(sun.target.position.toArray()).toEqual([5, 0, 0]);
  const { position } = sun;
  expect([position.x, position.y]).toEqual([5, 0]);
  expect(position.z).toBe(40); // higher than all bodies that cast shadows
});

test("small motions of the camera leave the shadows as they are", () => {
  const { fit } = shadowOf(20);
  fit([5, 0, 1], [5, 0, 0]);
  expect(fit([5.5, 0, 1], [5.5, 0, 0])).toBe(false);
  expect(fit([5, 0, 1.05], [5, 0, 0])).toBe(false);
  expect(fit([7, 0, 1], [7, 0, 0])).toBe(true);
});
