// @vitest-environment jsdom
import { PerspectiveCamera, Vector3 } from "three";
import { expect, test } from "vitest";
import { serverCameraOf } from "./DrawnView";
import { queryOf } from "./ImageFeed";

function camera(position: Vector3, target: Vector3, fieldOfViewDeg: number): PerspectiveCamera {
  const made = new PerspectiveCamera(fieldOfViewDeg, 1.5);
  made.up.set(0, 0, 1);
  made.position.copy(position);
  made.lookAt(target);
  made.updateMatrixWorld();
  return made;
}

test("the server's image has the size of the view in device pixels, and at most 4K", () => {
  const eye = camera(new Vector3(3, -4, 2), new Vector3(), 50);
  const at = (width: number, height: number, ratio: number) => serverCameraOf(eye, width, height, ratio);
  expect(at(1000, 600, 1)).toMatchObject({ width: 1000, height: 600, fieldOfViewDeg: 50, depthSpacing: 8 });
  expect(at(1000, 600, 2)).toMatchObject({ width: 2000, height: 1200 });
  expect(at(1000, 600, 2).depthSpacing).toBeGreaterThan(8);
  const large = at(3000, 2000, 3);
  expect(large.width * large.height).toBeLessThanOrEqual(3840 * 2160);
  expect(large.width / large.height).toBeCloseTo(1.5, 2);
  expect(at(5, 5, 1)).toMatchObject({ width: 16, height: 16 });
});

test("a map keeps its direction and its place in the rounded request", () => {
  const [eye, target] = [new Vector3(12.34567, 7.65432 - 50, 50_000), new Vector3(12.34567, 7.65432, 0)];
  const query = queryOf(serverCameraOf(camera(eye, target, 1), 1000, 600, 1));
  const [from, to] = ["eye", "target"].map((name) => new Vector3(...new URLSearchParams(query).get(name)!.split(",").map(Number)));
  const direction = to!.clone().sub(from!);
  expect(Math.abs(Math.atan2(direction.x, direction.y))).toBeLessThan(3e-4); // north is up
  const onFloor = from!.clone().addScaledVector(direction, -from!.z / direction.z);
  expect(onFloor.distanceTo(target)).toBeLessThan(0.02);
});
