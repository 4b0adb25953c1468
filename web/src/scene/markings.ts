// Draws figures made of lines: axes, fields of view, contacts.
import type { Matrix4 } from "three";
import { Vector3 } from "three";
import type { CameraView, SceneJoint } from "../api/scene";
import type { TouchPoint } from "../live/clouds";
import type { EquivalentBox } from "./inertia";
import type { LineLayer } from "./LineLayer";
import { rgb } from "./LineLayer";

const RED = rgb(0xe02b2b);
const GREEN = rgb(0x1f9d3a);
const BLUE = rgb(0x2f6df6);
const VIEW_COLOUR = rgb(0xf2b90f);
const CONTACT_COLOUR = rgb(0xff1fd0);
const VIEW_DEPTH = 1; // m
// m: length of the line along the normal of a contact whose force is unknown.
const NORMAL_LENGTH = 0.3;
const FORCE_LENGTH = 0.3; // m: length of the arrow for a force of FORCE_UNIT
const FORCE_UNIT = 10; // N
const LONGEST_FORCE = 1.2; // m
const ARROW_HEAD = 0.25; // fraction of the arrow's length
const CROSS = 0.06; // m
const JOINT_COLOUR = rgb(0x00b8d4);
const JOINT_LENGTH = 0.12; // m: length of the drawn axis on each side of the joint's origin
const CIRCLE_SEGMENTS = 12;
const MASS_COLOUR = rgb(0xd946c0);
const BOX_COLOUR = rgb(0x8b5cf6);
const ORIGIN = [0, 0, 0] as const;

// Draws the axes of a frame: x red, y green, z blue.
export function drawAxes(lines: LineLayer, worldFromFrame: Matrix4, length: number): void {
  lines.add(worldFromFrame, ORIGIN, [length, 0, 0], RED);
  lines.add(worldFromFrame, ORIGIN, [0, length, 0], GREEN);
  lines.add(worldFromFrame, ORIGIN, [0, 0, length], BLUE);
}

// Draws a revolute joint as its axis with a circle, and a prismatic joint as its axis with a bar at
// each end.
export function drawJoint(
  lines: LineLayer,
  worldFromJoint: Matrix4,
  { kind, axis: [x, y, z] }: Pick<SceneJoint, "kind" | "axis">,
): void {
  const axis = new Vector3(x, y, z).normalize();
  const across = (Math.abs(axis.x) < 0.9 ? new Vector3(1, 0, 0) : new Vector3(0, 1, 0)).cross(axis).normalize();
  const third = axis.clone().cross(across);
  const at = (along: number, angle: number, radius: number) =>
    axis
      .clone()
      .multiplyScalar(along)
      .addScaledVector(across, radius * Math.cos(angle))
      .addScaledVector(third, radius * Math.sin(angle))
      .toArray();
  const add = (from: number[], to: number[]) => lines.add(worldFromJoint, from, to, JOINT_COLOUR);
  add(at(-JOINT_LENGTH, 0, 0), at(JOINT_LENGTH, 0, 0));
  if (kind === "prismatic") {
    for (const end of [-JOINT_LENGTH, JOINT_LENGTH]) add(at(end, 0, CROSS / 2), at(end, Math.PI, CROSS / 2));
    return;
  }
  for (let i = 0; i < CIRCLE_SEGMENTS; ++i) {
    const angle = (k: number) => (2 * Math.PI * k) / CIRCLE_SEGMENTS;
    add(at(0, angle(i), CROSS), at(0, angle(i + 1), CROSS));
  }
}

// Draws a cross at the centre of mass of a link, and the box that has the link's inertia.
export function drawMass(lines: LineLayer, worldFromInertia: Matrix4, { frameFromBox, half }: EquivalentBox): void {
  const [x, y, z] = half;
  const size = Math.min(CROSS, Math.max(...half) || CROSS);
  for (const k of [0, 1, 2]) {
    const end = [0, 1, 2].map((axis) => (axis === k ? size : 0));
    lines.add(worldFromInertia, end, end.map((value) => -value), MASS_COLOUR);
  }
  const worldFromBox = worldFromInertia.clone().multiply(frameFromBox);
  const sides = [-1, 1];
  for (const a of sides) {
    for (const b of sides) {
      lines.add(worldFromBox, [-x, a * y, b * z], [x, a * y, b * z], BOX_COLOUR);
      lines.add(worldFromBox, [a * x, -y, b * z], [a * x, y, b * z], BOX_COLOUR);
      lines.add(worldFromBox, [a * x, b * y, -z], [a * x, b * y, z], BOX_COLOUR);
    }
  }
}

// Draws the pyramid of a camera's field of view, one metre deep. If the angles of the field of view
// are unknown, draws only the camera's direction.
export function drawView(lines: LineLayer, worldFromCamera: Matrix4, view: CameraView | null): void {
  if (!view) {
    lines.add(worldFromCamera, ORIGIN, [VIEW_DEPTH, 0, 0], VIEW_COLOUR);
    return;
  }
  const y = VIEW_DEPTH * Math.tan(view.horizontalFov / 2);
  const z = y / view.aspect;
  const corners = [
    [VIEW_DEPTH, y, z],
    [VIEW_DEPTH, -y, z],
    [VIEW_DEPTH, -y, -z],
    [VIEW_DEPTH, y, -z],
  ];
  corners.forEach((corner, i) => {
    lines.add(worldFromCamera, ORIGIN, corner, VIEW_COLOUR);
    lines.add(worldFromCamera, corner, corners[(i + 1) % 4]!, VIEW_COLOUR);
  });
}

// The length of an arrow for a force. It grows with the square root of the force, so that arrows
// for a crate of 1 kg and for a car are both visible.
export function forceLength(newtons: number): number {
  return Math.min(LONGEST_FORCE, FORCE_LENGTH * Math.sqrt(newtons / FORCE_UNIT));
}

// Draws a cross at the point, and an arrow along the force on the robot. If the force is unknown,
// draws a line along the normal towards the touched body.
export function drawContact(lines: LineLayer, worldFromSensor: Matrix4, { point, normal, force }: TouchPoint): void {
  const [x, y, z] = point;
  if (force) {
    drawForce(lines, worldFromSensor, point, force);
  } else {
    const tip = point.map((value, i) => value + NORMAL_LENGTH * normal[i]!);
    lines.add(worldFromSensor, point, tip, CONTACT_COLOUR);
  }
  lines.add(worldFromSensor, [x - CROSS, y, z], [x + CROSS, y, z], CONTACT_COLOUR);
  lines.add(worldFromSensor, [x, y - CROSS, z], [x, y + CROSS, z], CONTACT_COLOUR);
  lines.add(worldFromSensor, [x, y, z - CROSS], [x, y, z + CROSS], CONTACT_COLOUR);
}

function drawForce(lines: LineLayer, worldFromSensor: Matrix4, point: readonly number[], force: readonly number[]): void {
  const newtons = Math.hypot(...force);
  const length = forceLength(newtons);
  const along = force.map((component) => component / newtons);
  const tip = point.map((value, i) => value + length * along[i]!);
  lines.add(worldFromSensor, point, tip, CONTACT_COLOUR);
  // A direction perpendicular to the arrow. It is computed from the axis that is least parallel to
  // the arrow.
  const least = along.reduce((best, value, i) => (Math.abs(value) < Math.abs(along[best]!) ? i : best), 0);
  const aside = along.map((value, i) => (i === least ? 1 : 0) - value * along[least]!);
  for (const side of [-1, 1]) {
    const barb = tip.map(
      (value, i) => value - ARROW_HEAD * length * (along[i]! + (side * aside[i]!) / 2),
    );
    lines.add(worldFromSensor, tip, barb, CONTACT_COLOUR);
  }
}
