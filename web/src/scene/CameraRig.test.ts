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

// A rig whose walls are `free` metres from the target. It checks for walls at each update.
function rigBeforeWalls(free: { m: number }): CameraRig {
  const rig = new CameraRig(document.createElement("canvas"), () => {}, () => free.m);
  rig.viewpoint = { position: new Vector3(0, -4, 12), target: new Vector3(0, 0, 0) };
  return rig;
}

const drawnFrom = (rig: CameraRig) => rig.camera.position.distanceTo(rig.controls.target);

test("a chase is drawn from in front of a wall, and from the camera's place if there is no wall", () => {
  const free = { m: Infinity };
  const rig = rigBeforeWalls(free);
  rig.follow(HERE, true);
  rig.update(1000);
  const stand = rig.viewpoint.position;
  const far = drawnFrom(rig);
  free.m = 1;
  rig.update(2000);
  expect(drawnFrom(rig)).toBeCloseTo(0.85);
  expectNear(rig.viewpoint.position, stand.x, stand.y, stand.z);
  const direction = (from: Vector3) => from.clone().sub(HERE.middle).normalize();
  expectNear(direction(rig.camera.position), ...direction(stand).toArray());
  rig.follow(null); // from now on, the camera does not move
  rig.update(2500);
  expect(drawnFrom(rig)).toBeCloseTo(0.85);
  rig.follow(HERE, true);
  free.m = 0.1; // the robot is close to the wall
  rig.update(3000);
  expect(drawnFrom(rig)).toBeCloseTo(0.4);
  free.m = Infinity;
  rig.update(4000);
  expect(drawnFrom(rig)).toBeCloseTo(far);
});

test("a chase moves back gradually and requests frames until it is done", () => {
  vi.stubGlobal("matchMedia", () => ({ matches: false }));
  const free = { m: 1 };
  const rig = rigBeforeWalls(free);
  rig.follow(HERE, true);
  rig.update(performance.now() + 1000); // the flight has ended
  let now = performance.now() + 2000;
  rig.update(now);
  expect(drawnFrom(rig)).toBeCloseTo(0.85);
  free.m = Infinity;
  rig.update(now + 20); // the rig has not checked for walls yet
  expect(drawnFrom(rig)).toBeCloseTo(0.85);
  now += 110;
  expect(rig.update(now)).toBe(true);
  const first = drawnFrom(rig);
  expect(first).toBeGreaterThan(0.86);
  expect(first).toBeLessThan(2.5);
  for (let i = 0; i < 100; i++) rig.update((now += 50));
  expect(rig.update(now)).toBe(false);
  expect(drawnFrom(rig)).toBeCloseTo(rig.viewpoint.position.distanceTo(rig.viewpoint.target), 1);
});

test("walls move the camera only while it follows a robot", () => {
  const rig = rigBeforeWalls({ m: 1 });
  rig.update(1000);
  expect(drawnFrom(rig)).toBeCloseTo(Math.hypot(4, 12));
  rig.follow(HERE);
  rig.update(2000);
  expect(drawnFrom(rig)).toBeCloseTo(5);
});

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

// Regression: when the robot's model arrived, the view from a shared link moved up by half the
// robot's height.
test("the view does not move when the robot's shape is loaded", () => {
  const rig = rigAt(new Vector3(0, -4, 12), new Vector3(0, 0, 0));
  rig.follow({ ...HERE, middle: HERE.position });
  rig.viewpoint = { position: new Vector3(1, 2, 6), target: new Vector3(1, 2, 0.7) };
  rig.moveTo({ ...HERE, middle: new Vector3(1, 2, 0.9) });
  expectNear(rig.controls.target, 1, 2, 0.7);
});

test("a chase stays behind a robot that rotates", () => {
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

test("when following changes to a chase, the camera flies behind the robot", () => {
  const rig = rigAt(new Vector3(0, -4, 12), new Vector3(0, 0, 0));
  rig.follow(HERE);
  rig.update(0);
  rig.follow(HERE, true);
  rig.update(0);
  expect(rig.camera.position.x).toBeLessThan(HERE.position.x - 1);
});

test("a robot's view shows what is ahead, and afterwards the former view returns", () => {
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

// An image with the aspect 4:3 that is 60° wide: its height is 2 atan(tan(30°) 3 / 4) = 46.826°.
test("a robot's view has the width of its camera in windows of any shape", () => {
  const rig = rigAt(new Vector3(0, -4, 12), new Vector3(0, 0, 0));
  const before = rig.camera.fov;
  rig.resize(1600, 900);
  rig.lookFrom({ worldFromEye: new Matrix4(), view: { horizontalFov: Math.PI / 3, aspect: 4 / 3 } });
  expect(rig.camera.fov).toBeCloseTo(46.826, 3);
  // The window is narrower than the camera's image, whose width fills the window.
  rig.resize(600, 600);
  expect(rig.camera.fov).toBeCloseTo(60, 9);
  rig.lookFrom({ worldFromEye: new Matrix4(), view: { horizontalFov: Math.PI, aspect: 1 } });
  expect(rig.camera.fov).toBeCloseTo(120, 9); // the maximum of a perspective camera
  rig.lookFrom(null);
  expect(rig.camera.fov).toBe(before);
});

test("a map looks straight down, north up and without perspective, and shows as much as before", () => {
  const rig = rigAt(new Vector3(0, -8, 6), new Vector3(0, 0, 0));
  rig.resize(800, 400);
  const before = rig.metresPerPixel;
  rig.setMap(true);
  rig.update(1000);
  expect(rig.metresPerPixel).toBeCloseTo(before, 6);
  const at = (x: number, y: number, z: number) => new Vector3(x, y, z).project(rig.camera);
  expect(at(1, 0, 0).x).toBeGreaterThan(0); // east is to the right
  expect(at(0, 1, 0).y).toBeGreaterThan(0); // north is up
  // The height of a point hardly changes its place on the map.
  expect(Math.abs(at(3, 2, 1).x - at(3, 2, 0).x)).toBeLessThan(0.005);
  expect(Math.abs(at(3, 2, 1).y - at(3, 2, 0).y)).toBeLessThan(0.005);
  expect(at(3, 2, 0).z).toBeLessThan(1);
  expect(rig.controls.enableRotate).toBe(false);
  // The numbers in a link.
  expect(rig.viewNumbers.map((value) => Math.round(value))).toEqual([0, -8, 6, 0, 0, 0]);
  rig.setMap(false);
  expectNear(rig.viewpoint.position, 0, -8, 6);
  expect(rig.controls.enableRotate).toBe(true);
  expect(rig.camera.fov).toBe(50);
});
