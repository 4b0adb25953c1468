import type { InterleavedBufferAttribute, Points } from "three";
import { Vector3 } from "three";
import type { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import type { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { cloudOf } from "../live/clouds";
import { expect, test } from "vitest";
import type { SceneSensor } from "../api/scene";
import type { OverlayName, Shown } from "../state/overlays";
import { FIRST_SHOWN, OVERLAY_NAMES } from "../state/overlays";
import { BodyLayer } from "./BodyLayer";
import { OverlayLayers } from "./OverlayLayers";
import { body, scene } from "./testScene";

function sensor(name: string, type: string, more: Partial<SceneSensor> = {}): SceneSensor {
  return { name, type, overlay: "none", link: "arm", topic: `/a/${name}`, view: null, ...more };
}

const SENSORS = [
  sensor("scan", "lidar", { overlay: "points" }),
  sensor("bumper", "contact"),
  sensor("eye", "camera", { view: { horizontalFov: Math.PI / 2, aspect: 2 } }),
];
const SCENE = scene({
  bodies: [body("a", { links: ["base", "arm"], sensors: SENSORS })],
  poses: [
    { body: 0, link: null },
    { body: 0, link: "arm" },
  ],
});

// The robot is at (10, 0, 0), its arm at (10, 0, 1), rotated to the left.
const QUARTER = Math.SQRT1_2;
const POSES = new Float64Array([10, 0, 0, 0, 0, 0, 1, 10, 0, 1, 0, 0, QUARTER, QUARTER]);

function frame(parent: string, child: string) {
  const translation = { x: 1, y: 0, z: 0 };
  const stamp = { sec: 0, nsec: 0 };
  return {
    header: { stamp, frame_id: parent },
    child_frame_id: child,
    transform: { translation, rotation: { x: 0, y: 0, z: 0, w: 1 } },
  };
}

function only(...names: OverlayName[]): Shown {
  const shown = { ...FIRST_SHOWN };
  for (const name of OVERLAY_NAMES) shown[name] = names.includes(name);
  return shown;
}

function layers(shown: Shown) {
  const overlays = new OverlayLayers(10_000);
  const bodies = new BodyLayer(SCENE);
  overlays.setScene(bodies);
  bodies.setPoses(POSES);
  overlays.takeFrames({ transforms: ["scan", "bumper", "eye"].map((name) => frame("a/arm", `a/${name}`)) });
  overlays.show(shown);
  const [, points, lines, trails] = overlays.group.children as [
    unknown,
    Points,
    LineSegments2,
    LineSegments2,
  ];
  const segments = (of: LineSegments2) => (of.geometry as LineSegmentsGeometry).instanceCount;
  return { overlays, points, lines, trails, segments };
}

test("points are at their sensor's place, on a rotated link", () => {
  const { overlays, points } = layers(only("points"));
  const scan = {
    angle_min: 0,
    angle_increment: 1,
    range_min: 0,
    range_max: 9,
    ranges: new Float32Array([2]),
  };
  overlays.takePoints("/a/scan", cloudOf(scan));
  overlays.place(new Vector3());
  expect(points.geometry.drawRange.count).toBe(1);
  const place = Array.from(points.geometry.getAttribute("position").array.slice(0, 3));
  // The point is one metre along the arm (to the sensor) plus two metres. The arm points along y.
  [10, 3, 1].forEach((value, i) => expect(place[i]).toBeCloseTo(value, 5));
  overlays.keepReadings(new Set());
  overlays.place(new Vector3());
  expect(points.geometry.drawRange.count).toBe(0);
});

test("a camera's field of view is a pyramid with its angles", () => {
  const { overlays, lines, segments } = layers(only("cameras"));
  overlays.place(new Vector3());
  expect(segments(lines)).toBe(8);
  const ends = lines.geometry.getAttribute("instanceEnd") as InterleavedBufferAttribute;
  // The first edge ends at the upper left corner: a metre ahead, a metre to the left, half a metre
  // up.
  [9, 2, 1.5].forEach((value, i) => expect(ends.getComponent(0, i)).toBeCloseTo(value, 5));
});

test("a camera is recognised by its readings, not by its type's name", () => {
  const { overlays, lines, segments } = layers(only("cameras"));
  const view = { horizontalFov: 1, aspect: 1 };
  const sensors = [
    sensor("scan", "camera_like_lidar", { overlay: "points" }),
    sensor("bumper", "seer", { overlay: "picture", view }),
    sensor("eye", "frustum", { view }),
  ];
  overlays.setScene(new BodyLayer({ ...SCENE, bodies: [body("a", { links: ["base", "arm"], sensors })] }));
  overlays.place(new Vector3());
  expect(segments(lines)).toBe(2 * 8);
});

test("a station's sensors are placed by the station's own frame", () => {
  const { overlays, lines, segments } = layers(only("cameras"));
  const camera = sensor("eye", "camera", { view: { horizontalFov: 1, aspect: 1 }, topic: "/post/eye" });
  const post = body("post", { isRobot: false, isStatic: true, isStation: true, sensors: [camera] });
  overlays.setScene(new BodyLayer(scene({ bodies: [post], poses: [{ body: 0, link: null }] })));
  overlays.takeFrames({ transforms: [frame("post", "post/eye")] });
  overlays.place(new Vector3());
  expect(segments(lines)).toBe(8);
});

test("contacts are drawn while they exist", () => {
  const { overlays, lines, segments } = layers(only("contacts"));
  const contact = { other: "wall", point: { x: 0, y: 0, z: 0 }, normal: { x: 1, y: 0, z: 0 }, depth: 0 };
  overlays.takeReading("/a/bumper", { contacts: [contact] });
  overlays.place(new Vector3());
  expect(segments(lines)).toBe(4);
  overlays.takeReading("/a/bumper", { contacts: [] });
  overlays.place(new Vector3());
  expect(lines.visible).toBe(false);
});

test("an arrow has the direction of the force, and a length that grows with its square root", () => {
  const { overlays, lines } = layers(only("contacts"));
  const ends = () => {
    const tips = lines.geometry.getAttribute("instanceEnd") as InterleavedBufferAttribute;
    return [0, 1, 2].map((component) => tips.getComponent(0, component)); // the first segment is the shaft
  };
  const contact = (force: number[]) => {
    const [x, y, z] = force;
    overlays.takeReading("/a/bumper", { contacts: [{ point: { x: 0, y: 0, z: 0 }, normal: { x: 0, y: 0, z: 1 }, depth: 0, force: { x, y, z } }] });
    overlays.place(new Vector3());
    return ends();
  };
  // The bumper is at (10, 1, 1), and its x points along y of the world.
  const close = (found: number[], wanted: number[]) => wanted.forEach((value, i) => expect(found[i]).toBeCloseTo(value, 5));
  close(contact([10, 0, 0]), [10, 1.3, 1]);
  close(contact([0, 0, -10]), [10, 1, 0.7]);
  close(contact([0, 40, 0]), [9.4, 1, 1]);
  close(contact([0, 0, 1e6]), [10, 1, 2.2]); // the longest arrow
});

test("only the robots' frames are drawn, but all frames of the selected robot", () => {
  const { overlays, lines, segments } = layers(only("frames"));
  overlays.place(new Vector3());
  expect(segments(lines)).toBe(3);
  overlays.select("a");
  overlays.place(new Vector3());
  expect(segments(lines)).toBe(3 * (1 + 1 + SENSORS.length));
});

test("trails grow while hidden, survive a change of layout, and end with the scene", () => {
  const { overlays, trails, segments } = layers(only());
  const moved = POSES.slice();
  moved[0] = 11;
  overlays.takePoses({ step: 1, stamp: 1, poses: POSES });
  overlays.takePoses({ step: 2, stamp: 2, poses: moved });
  overlays.setScene(null);
  overlays.setScene(new BodyLayer(SCENE));
  overlays.place(new Vector3());
  expect(trails.visible).toBe(false);
  overlays.show(only("trails"));
  overlays.place(new Vector3());
  expect(segments(trails)).toBe(1);
  overlays.setScene(new BodyLayer({ ...SCENE, name: "other" }));
  overlays.place(new Vector3());
  expect(segments(trails)).toBe(0);
});

test("the masses of a link that moves and of one that does not are at their places", () => {
  const { overlays, lines, segments } = layers(only("masses"));
  const at = (x: number) => [x, 0, 0, 0, 0, 0, 1];
  const inertial = (link: string) => ({ link, mass: 6, pose: at(0.5), poseInModel: at(9), inertia: [1, 1, 1, 0, 0, 0] as const });
  const inertials = new Map([[SCENE.bodies[0]!.model, [inertial("base"), inertial("arm")]]]);
  const bodies = new BodyLayer({ ...SCENE, inertials });
  overlays.setScene(bodies);
  bodies.setPoses(POSES);
  overlays.place(new Vector3());
  expect(segments(lines)).toBe(2 * (3 + 12));
  const starts = lines.geometry.getAttribute("instanceStart") as InterleavedBufferAttribute;
  // The base is at its place in the model. The arm is at its own place, rotated to the left.
  [19.06, 0, 0].forEach((value, i) => expect(starts.getComponent(0, i)).toBeCloseTo(value, 5));
  [10, 0.56, 1].forEach((value, i) => expect(starts.getComponent(15, i)).toBeCloseTo(value, 5));
});

test("points have the colour of their distance, height or intensity", () => {
  const { overlays, points } = layers(only("points"));
  const ranges = new Float32Array([1, 2, 3]);
  overlays.takePoints("/a/scan", cloudOf({ angle_min: 0, angle_increment: 1, range_min: 0, range_max: 9, ranges, intensities: [30, 20, 10] }));
  const brightness = () => {
    overlays.place(new Vector3());
    const colours = points.geometry.getAttribute("color").array;
    return [0, 1, 2].map((i) => colours[3 * i]! + colours[3 * i + 1]! + colours[3 * i + 2]!);
  };
  const [near, middle, far] = brightness();
  expect(near! < middle! && middle! < far!).toBe(true);
  overlays.setColours({ points: "intensity", trails: "robot" });
  expect(brightness()).toEqual([far, middle, near]);
  overlays.setColours({ points: "height", trails: "robot" });
  expect(brightness()).toEqual([near, near, near]); // the lidar is level
});

test("trails by speed are dark where the robot was slow", () => {
  const { overlays, trails } = layers({ ...only("trails") });
  overlays.setColours({ points: "range", trails: "speed" });
  [10, 10.1, 10.2, 11.2].forEach((x, i) => {
    const moved = POSES.slice();
    moved[0] = x;
    overlays.takePoses({ step: i, stamp: i, poses: moved });
  });
  overlays.place(new Vector3());
  const colours = trails.geometry.getAttribute("instanceColorStart") as InterleavedBufferAttribute;
  const brightness = (i: number) => colours.getX(i) + colours.getY(i) + colours.getZ(i);
  expect(brightness(0)).toBeCloseTo(brightness(1), 5);
  expect(brightness(2)).toBeGreaterThan(brightness(1));
});
