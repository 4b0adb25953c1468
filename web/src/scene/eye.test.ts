import { Box3, Matrix4, Vector3 } from "three";
import { expect, test } from "vitest";
import { cameraRotation, eyeAt } from "./eye";

test("a robot's view is along its x axis, with its z axis up", () => {
  const eye = new Matrix4().makeRotationZ(Math.PI / 2).setPosition(1, 2, 3);
  const rotation = cameraRotation(eye);
  const ahead = new Vector3(0, 0, -1).applyQuaternion(rotation);
  const up = new Vector3(0, 1, 0).applyQuaternion(rotation);
  expect(ahead.distanceTo(new Vector3(0, 1, 0))).toBeCloseTo(0, 12);
  expect(up.distanceTo(new Vector3(0, 0, 1))).toBeCloseTo(0, 12);
});

test("for a robot without a camera, the view is from the front of its top", () => {
  const bounds = new Box3(new Vector3(-0.2, -0.3, 0), new Vector3(0.25, 0.3, 1.1));
  const robot = new Matrix4().makeRotationZ(Math.PI).setPosition(5, 0, 0);
  const eye = new Vector3().setFromMatrixPosition(eyeAt(robot, bounds));
  expect(eye.distanceTo(new Vector3(4.75, 0, 1.1))).toBeCloseTo(0, 12);
  const unknown = new Vector3().setFromMatrixPosition(eyeAt(robot, new Box3()));
  expect(unknown.z).toBeGreaterThan(0);
});
