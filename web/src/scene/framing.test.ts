import { Box3, PerspectiveCamera, Vector3 } from "three";
import { expect, test } from "vitest";
import { environmentOf, fittingDistance, focusOf, withoutFarAway } from "./framing";
import { body, scene } from "./testScene";

function camera(aspect: number): PerspectiveCamera {
  const made = new PerspectiveCamera(60, aspect, 0.1, 1000);
  made.up.set(0, 0, 1);
  return made;
}

test("another world of the same name resets the camera, but an added robot does not", () => {
  const wall = (model: string, x = 0) =>
    body("wall", { model, isStatic: true, isFixed: true, pose: [x, 0, 0, 0, 0, 0, 1] });
  const robot = body("a", { isRobot: true });
  const first = environmentOf(scene({ name: "preview", bodies: [wall("1")] }));
  expect(environmentOf(scene({ name: "preview", bodies: [wall("1"), robot] }))).toBe(first);
  expect(environmentOf(scene({ name: "preview", bodies: [wall("2")] }))).not.toBe(first);
  expect(environmentOf(scene({ name: "preview", bodies: [wall("1", 30)] }))).not.toBe(first);
  expect(environmentOf(scene({ name: "other", bodies: [wall("1")] }))).not.toBe(first);
});

test("along x, the distance to a flat square is half its height divided by the tangent", () => {
  const box = new Box3(new Vector3(0, -2, -2), new Vector3(0, 2, 2));
  const distance = fittingDistance(camera(1), box, new Vector3(1, 0, 0));
  expect(distance).toBeCloseTo(2 / Math.tan(Math.PI / 6), 9);
});

test("a tall image needs more distance for the width", () => {
  const box = new Box3(new Vector3(0, -2, -2), new Vector3(0, 2, 2));
  const distance = fittingDistance(camera(0.5), box, new Vector3(1, 0, 0));
  expect(distance).toBeCloseTo(4 / Math.tan(Math.PI / 6), 9);
});

test("at that distance every corner is in the image, and one is at its edge", () => {
  const box = new Box3(new Vector3(-3, 1, 0), new Vector3(6, 9, 2.5));
  const direction = new Vector3(0.3, 0.8, -0.9).normalize();
  const eye = camera(1.6);
  const centre = box.getCenter(new Vector3());
  eye.position.copy(centre).addScaledVector(direction, -fittingDistance(eye, box, direction));
  eye.lookAt(centre);
  eye.updateMatrixWorld(true);
  let outermost = 0;
  for (let i = 0; i < 8; i++) {
    const corner = new Vector3(
      i & 1 ? box.max.x : box.min.x,
      i & 2 ? box.max.y : box.min.y,
      i & 4 ? box.max.z : box.min.z,
    ).project(eye);
    outermost = Math.max(outermost, Math.abs(corner.x), Math.abs(corner.y));
  }
  expect(outermost).toBeCloseTo(1, 9);
});

test("a small world is shown completely, except for its height", () => {
  const focus = focusOf(scene({ bounds: { min: [-5, -4, 0], max: [5, 4, 12] } }));
  expect(focus.min.toArray()).toEqual([-5, -4, 0]);
  expect(focus.max.toArray()).toEqual([5, 4, 3]);
});

test("a large world is shown around its robots", () => {
  const robots = [body("a", { pose: [10, 0, 0, 0, 0, 0, 1] }), body("b", { pose: [12, 2, 0, 0, 0, 0, 1] })];
  const focus = focusOf(scene({ bounds: { min: [-500, -500, 0], max: [500, 500, 1] }, bodies: robots }));
  expect(focus.min.toArray()).toEqual([6, -4, 0]);
  expect(focus.max.toArray()).toEqual([16, 6, 1]);
});

test("a large world without robots is shown from its centre", () => {
  const focus = focusOf(scene({ bounds: { min: [-500, -500, 0], max: [500, 500, 1] } }));
  expect(focus.getSize(new Vector3()).toArray()).toEqual([26, 26, 1]);
});

test("a distant body does not move the camera away", () => {
  const at = (x: number) => body(`b${x}`, { pose: [x, 0, 0, 0, 0, 0, 1] });
  const bounds = { min: [-2, -2, 0], max: [5002, 2, 3] } as const;
  const near = [at(-1), at(0), at(1), at(2)];
  const focus = focusOf(scene({ bodies: [...near, at(5000)], bounds: { min: [...bounds.min], max: [...bounds.max] } }));
  expect(focus.max.x).toBeLessThan(10);
  expect(focus.min.x).toBe(-2);
  // A row of bodies has no gap, however long it is.
  const row = Array.from({ length: 50 }, (_, i) => new Vector3(i * 40, 0, 0));
  expect(withoutFarAway(row)).toHaveLength(50);
  expect(withoutFarAway([new Vector3(900, 0, 0)])).toHaveLength(1);
});
