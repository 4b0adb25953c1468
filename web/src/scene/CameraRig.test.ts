// @vitest-environment jsdom
import { Matrix4, Vector3 } from "three";
import { beforeEach, expect, test, vi } from "vitest";
import { CameraRig } from "./CameraRig";

beforeEach(() => {
  vi.stubGlobal("matchMedia", () => ({ matches: true })); // flights arrive at once
});

function rigAt(position: Vector3, target: Vector3): CameraRig {
  const rig = new CameraRig(document.createElement("canvas"), () => {});
  rig.viewpoint = { position, target };
  return rig;
}

function expectNear(actual: Vector3, x: number, y: number, z: number): void {
  expect(actual.distanceTo(new Vector3(x, y, z))).toBeLessThan(1e-3);
}

const HERE = { position: new Vector3(1, 2, 0.5), middle: new Vector3(1, 2, 0.5), yaw: 0 };

test("following keeps the direction of the view while the robot moves and turns", () => {
  const rig = rigAt(new Vector3(0, -4, 12), new Vector3(0, 0, 0));
  rig.follow(HERE);
  rig.update(0);
  const offset = rig.camera.position.clone().sub(HERE.position);
  rig.moveTo({ ...HERE, position: new Vector3(3, 2, 0.5), yaw: 1 });
  rig.update(0);
  expectNear(rig.controls.target, 3, 2, 0.5);
  expectNear(rig.camera.position.clone().sub(rig.controls.target), offset.x, offset.y, offset.z);
});

// A link's view had risen by half the robot's height when its model arrived.
test("the view stays where it is when the shape of the robot becomes known", () => {
  const rig = rigAt(new Vector3(0, -4, 12), new Vector3(0, 0, 0));
  rig.follow({ ...HERE, middle: HERE.position });
  rig.viewpoint = { position: new Vector3(1, 2, 6), target: new Vector3(1, 2, 0.7) };
  rig.moveTo({ ...HERE, middle: new Vector3(1, 2, 0.9) });
  expectNear(rig.controls.target, 1, 2, 0.7);
});

test("a chase stays behind the robot, however it turns", () => {
  const rig = rigAt(new Vector3(0, -4, 12), new Vector3(0, 0, 0));
  rig.follow(HERE, true);
  rig.update(0);
  expect(rig.camera.position.x).toBeLessThan(HERE.position.x - 1);
  expect(rig.camera.position.y).toBeCloseTo(HERE.position.y, 3);
  rig.moveTo({ ...HERE, yaw: Math.PI / 2 });
  rig.update(0);
  expect(rig.camera.position.y).toBeLessThan(HERE.position.y - 1);
  expect(rig.camera.position.x).toBeCloseTo(HERE.position.x, 3);
});

test("from following to a chase it flies behind", () => {
  const rig = rigAt(new Vector3(0, -4, 12), new Vector3(0, 0, 0));
  rig.follow(HERE);
  rig.update(0);
  rig.follow(HERE, true);
  rig.update(0);
  expect(rig.camera.position.x).toBeLessThan(HERE.position.x - 1);
});

test("out of a robot's eye one sees what lies ahead of it, and afterwards all is as before", () => {
  const rig = rigAt(new Vector3(0, -4, 12), new Vector3(0, 0, 0));
  rig.lookFrom({ worldFromEye: new Matrix4().makeRotationZ(Math.PI / 2).setPosition(5, 6, 0.7), view: null });
  rig.update(0);
  expectNear(rig.camera.position, 5, 6, 0.7);
  expectNear(new Vector3(0, 0, -1).applyQuaternion(rig.camera.quaternion), 0, 1, 0);
  expect(rig.controls.enabled).toBe(false);
  expectNear(rig.viewpoint.position, 0, -4, 12);
  rig.lookFrom(null);
  rig.update(0);
  expectNear(rig.camera.position, 0, -4, 12);
  expect(rig.controls.enabled).toBe(true);
});

// Of a picture of 4 by 3 and 60° across: 2 atan(tan(30°) 3 / 4) = 46.826° from top to bottom.
test("a robot's eye sees as wide as its camera, whatever the shape of the window", () => {
  const rig = rigAt(new Vector3(0, -4, 12), new Vector3(0, 0, 0));
  const before = rig.camera.fov;
  rig.resize(1600, 900);
  rig.lookFrom({ worldFromEye: new Matrix4(), view: { horizontalFov: Math.PI / 3, aspect: 4 / 3 } });
  expect(rig.camera.fov).toBeCloseTo(46.826, 3);
  rig.resize(600, 600); // narrower than the picture: what it sees across fills the window
  expect(rig.camera.fov).toBeCloseTo(60, 9);
  rig.lookFrom({ worldFromEye: new Matrix4(), view: { horizontalFov: Math.PI, aspect: 1 } });
  expect(rig.camera.fov).toBeCloseTo(120, 9); // the most that a flat picture shows
  rig.lookFrom(null);
  expect(rig.camera.fov).toBe(before);
});
