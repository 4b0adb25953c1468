import { expect, test } from "vitest";
import { MOST_POINTS, contactsOf, pointsOf, worldContactsOf } from "./clouds";

const SCAN = { angle_min: -Math.PI / 2, angle_increment: Math.PI / 2, range_min: 0.1, range_max: 5 };

test("a scan has a point at the end of each beam, and none for beams without an echo", () => {
  const points = pointsOf({ ...SCAN, ranges: new Float32Array([1, 2, Infinity, 0.05, NaN]) });
  const expected = [0, -1, 0, 2, 0, 0];
  expect(points).toHaveLength(expected.length);
  points.forEach((value, i) => expect(value).toBeCloseTo(expected[i]!, 6));
});

test("a scan with several rows has points above each other", () => {
  const rows = {
    ...SCAN,
    beams: 2,
    rows: 2,
    angle_min: 0,
    vertical_angle_min: 0,
    vertical_angle_increment: Math.PI / 6,
    ranges: new Float32Array([1, 2, 4, Infinity]),
  };
  const points = pointsOf(rows);
  const expected = [1, 0, 0, 0, 2, 0, 4 * Math.cos(Math.PI / 6), 0, 2];
  expect(points).toHaveLength(expected.length);
  points.forEach((value, i) => expect(value).toBeCloseTo(expected[i]!, 5));
});

function cloud(points: number[][], more: object = {}) {
  const data = new Uint8Array(16 * points.length);
  const view = new DataView(data.buffer);
  points.forEach((point, i) => point.forEach((value, k) => view.setFloat32(16 * i + 4 * k, value, true)));
  const field = (name: string, offset: number) => ({ name, offset, datatype: 7, count: 1 });
  return {
    height: 1,
    width: points.length,
    fields: [field("x", 0), field("y", 4), field("z", 8)],
    is_bigendian: false,
    point_step: 16,
    row_step: data.length,
    data,
    ...more,
  };
}

test("a cloud's points are copied without the invalid ones", () => {
  const message = cloud([
    [1, 2, 3],
    [NaN, 0, 0],
    [4, 5, 6],
  ]);
  expect([...pointsOf(message)]).toEqual([1, 2, 3, 4, 5, 6]);
});

test("every nth point of a large cloud is used", () => {
  const many = cloud(Array.from({ length: 3 * MOST_POINTS }, (_, i) => [i, 0, 0]));
  const points = pointsOf(many);
  expect(points).toHaveLength(3 * MOST_POINTS);
  expect(points[3]).toBe(3);
});

test("a cloud with a wrong size or without positions gives the readable points", () => {
  expect([...pointsOf(cloud([[1, 2, 3]], { width: 1000, height: 1000 }))]).toEqual([1, 2, 3]);
  expect(pointsOf(cloud([[1, 2, 3]], { fields: [] }))).toHaveLength(0);
  expect(pointsOf(cloud([[1, 2, 3]], { point_step: 0 }))).toHaveLength(0);
  expect(pointsOf({ range: 1 })).toHaveLength(0);
  expect(pointsOf(null)).toHaveLength(0);
});

test("only a bumper's messages contain contacts", () => {
  const contact = { other: "wall", point: { x: 1, y: 2, z: 3 }, normal: { x: 1, y: 0, z: 0 }, depth: 0 };
  expect(
    contactsOf({ contacts: [contact, { point: { x: NaN, y: 0, z: 0 }, normal: contact.normal }] }),
  ).toEqual([{ point: [1, 2, 3], normal: [1, 0, 0], force: null }]);
  expect(contactsOf({ contacts: [{ ...contact, force: { x: -4, y: 0, z: 3 } }] })[0]!.force).toEqual([-4, 0, 3]);
  expect(contactsOf({ contacts: [{ ...contact, force: { x: 0, y: 0, z: 0 } }] })[0]!.force).toBeNull();
  expect(contactsOf({ range: 1 })).toEqual([]);
  expect(contactsOf(null)).toEqual([]);
});

test("contacts of the world have the force on the first body at each of their points", () => {
  const up = { x: 0, y: 0, z: 1 };
  const contact = {
    first: "box",
    second: "ground",
    normal: { x: 0, y: 0, z: -1 },
    points: [{ x: 1, y: 2, z: 0 }, { x: 3, y: 2, z: 0 }],
    forces: [{ x: 0, y: 0.5, z: -10 }, { x: 0, y: 0, z: 0 }],
  };
  expect(worldContactsOf({ contacts: [contact, { ...contact, points: null }], left_out: 0 })).toEqual([
    { point: [1, 2, 0], normal: [0, 0, -1], force: [-0, -0.5, 10] },
    { point: [3, 2, 0], normal: [0, 0, -1], force: null },
  ]);
  expect(worldContactsOf({ contacts: [{ points: [up] }] })).toEqual([]);
  expect(worldContactsOf(null)).toEqual([]);
});
