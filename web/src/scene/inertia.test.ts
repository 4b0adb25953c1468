import { Vector3 } from "three";
import { expect, test } from "vitest";
import { equivalentBox } from "./inertia";

// The inertia of a box with sides 1, 2 and 3 m: m (b² + c²) / 12 and so on.
const MASS = 12;
const MOMENTS = [13, 10, 5] as const;

test("the equivalent box of a box's inertia is that box", () => {
  const { half } = equivalentBox({ mass: MASS, inertia: [...MOMENTS, 0, 0, 0] });
  half.forEach((value, i) => expect(value).toBeCloseTo((i + 1) / 2, 9));
});

test("the equivalent box of a rotated box has its sides along the principal axes", () => {
  // Turned by 30° about z: R I Rᵀ.
  const [c, s] = [Math.cos(Math.PI / 6), Math.sin(Math.PI / 6)];
  const [a, b, z] = MOMENTS;
  const inertia = [c * c * a + s * s * b, s * s * a + c * c * b, z, c * s * (a - b), 0, 0] as const;
  const { half, frameFromBox } = equivalentBox({ mass: MASS, inertia });
  const [x, y] = [0, 1].map((i) => new Vector3().setFromMatrixColumn(frameFromBox, i));
  const [alongShort, alongMiddle] = half[0] < half[1] ? [x!, y!] : [y!, x!];
  expect(Math.abs(alongShort.dot(new Vector3(c, s, 0)))).toBeCloseTo(1, 9);
  expect(Math.abs(alongMiddle.dot(new Vector3(-s, c, 0)))).toBeCloseTo(1, 9);
  expect([...half].sort((p, q) => p - q).map((value) => value.toFixed(6))).toEqual(["0.500000", "1.000000", "1.500000"]);
});

test("an inertia that no body can have gives a flat box", () => {
  expect(equivalentBox({ mass: 1, inertia: [1, 1, 9, 0, 0, 0] }).half[2]).toBe(0);
});
