import { expect, test } from "vitest";
import { anglesOf, stampOf, unitOf, valuesOf } from "./values";

const header = { stamp: { sec: 2, nsec: 500_000_000 }, frame_id: "a/sonar" };

function asText(message: unknown, units = {}): string[] {
  return valuesOf(message, units).map(({ key, unit, value }) => `${key} = ${value} ${unit}`.trim());
}

test("a sonar's message gives its range in metres, but not its construction", () => {
  const range = { header, radiation_type: 0, field_of_view: 0.25, min_range: 0, max_range: 5, range: 1.5 };
  expect(asText(range, { range: "m" })).toEqual(["range = 1.5 m"]);
});

test("a long list is summarised by its finite values", () => {
  const ranges = new Float32Array([2, Infinity, 1, 4, 1, 2, 2, 2, NaN]);
  expect(asText({ header, ranges }, { ranges: "m" })).toEqual([
    "ranges.min = 1 m",
    "ranges.max = 4 m",
    "ranges.mean = 2 m",
  ]);
  expect(valuesOf({ ranges: new Float32Array(9).fill(Infinity) }).map(({ value }) => value)).toEqual([
    NaN,
    NaN,
    NaN,
  ]);
});

test("values of joints are named after the joints", () => {
  const joints = {
    header,
    name: ["left", "right"],
    position: new Float64Array([0.5, -0.5]),
    effort: new Float64Array(0),
  };
  expect(asText(joints)).toEqual(["position[left] = 0.5", "position[right] = -0.5"]);
});

test("an orientation is shown as angles, and covariances are omitted", () => {
  const half = Math.SQRT1_2;
  const imu = {
    header,
    orientation: { x: 0, y: 0, z: half, w: half },
    orientation_covariance: new Float64Array(9),
    angular_velocity: { x: 0, y: 0, z: 0.25 },
  };
  const values = valuesOf(imu, { angular_velocity: "rad/s" });
  expect(values.map(({ key }) => key)).toEqual([
    "orientation.roll",
    "orientation.pitch",
    "orientation.yaw",
    "angular_velocity.x",
    "angular_velocity.y",
    "angular_velocity.z",
  ]);
  expect(values[2]!.value).toBeCloseTo(Math.PI / 2, 12);
  expect(values.map(({ unit }) => unit)).toEqual(["rad", "rad", "rad", "rad/s", "rad/s", "rad/s"]);
});

test("a list of objects gives their number and the first one", () => {
  const contact = { other: "wall", point: { x: 0.25, y: 0, z: 0 }, depth: 0.001 };
  const units = { "contacts.point": "m", "contacts.depth": "m" };
  expect(asText({ header, contacts: [contact, contact] }, units)).toEqual([
    "contacts.count = 2",
    "contacts[0].point.x = 0.25 m",
    "contacts[0].point.y = 0 m",
    "contacts[0].point.z = 0 m",
    "contacts[0].depth = 0.001 m",
  ]);
  expect(asText({ contacts: [] })).toEqual(["contacts.count = 0"]);
});

test("images and clouds have no values, and the number of values is limited", () => {
  expect(valuesOf({ header, format: "jpeg", data: new Uint8Array(20) })).toEqual([]);
  expect(valuesOf("text")).toEqual([]);
  expect(valuesOf(null)).toEqual([]);
  const wide = Object.fromEntries(Array.from({ length: 500 }, (_, i) => [`f${i}`, i]));
  expect(valuesOf(wide)).toHaveLength(64);
  const deep: Record<string, unknown> = {};
  deep.deeper = deep;
  expect(valuesOf(deep)).toEqual([]);
});

test("large integers and flags are numbers too", () => {
  expect(asText({ step: 12n, present: true })).toEqual(["step = 12", "present = 1"]);
});

test("a field has the unit of the nearest path above it", () => {
  const units = { "pose.pose.position": "m", "twist.twist.linear": "m/s", ranges: "m", twist: "none" };
  expect(unitOf("pose.pose.position.x", units)).toBe("m");
  expect(unitOf("twist.twist.linear.x", units)).toBe("m/s");
  expect(unitOf("twist.twist.angular.z", units)).toBe("none");
  expect(unitOf("ranges[3]", units)).toBe("m");
  expect(unitOf("ranges.min", units)).toBe("m");
  expect(unitOf("position[a.b]", { position: "rad" })).toBe("rad");
  expect(unitOf("percentage", units)).toBe("");
  expect(unitOf("constructor", {})).toBe("");
});

test("angles are in the order roll, pitch, yaw", () => {
  // The quaternion of Rz(0.3) Ry(0.2) Rx(0.1), computed from half angles.
  const [cr, sr] = [Math.cos(0.05), Math.sin(0.05)];
  const [cp, sp] = [Math.cos(0.1), Math.sin(0.1)];
  const [cy, sy] = [Math.cos(0.15), Math.sin(0.15)];
  const angles = anglesOf({
    w: cr * cp * cy + sr * sp * sy,
    x: sr * cp * cy - cr * sp * sy,
    y: cr * sp * cy + sr * cp * sy,
    z: cr * cp * sy - sr * sp * cy,
  });
  expect(angles.roll).toBeCloseTo(0.1, 12);
  expect(angles.pitch).toBeCloseTo(0.2, 12);
  expect(angles.yaw).toBeCloseTo(0.3, 12);
});

test("the time of a message is its own or that of its header", () => {
  expect(stampOf({ header })).toBe(2.5);
  expect(stampOf({ stamp: { sec: 1, nsec: 0 } })).toBe(1);
  expect(stampOf({ clock: 1 })).toBeNull();
  expect(stampOf(null)).toBeNull();
});
