import { expect, test } from "vitest";
import { posesOf } from "./packedPoses";

const HEAD = { stamp: { sec: 1, nsec: 0 }, step: 10n, layout_version: 3 };
const packed = (component: number) => Math.round((component * Math.SQRT2 + 1) * 16383.5);

function rotation(positions: number[], rotations: number[]): number[] {
  const message = { ...HEAD, positions: Int32Array.from(positions), rotations: Uint16Array.from(rotations) };
  return [...posesOf(message).poses];
}

test("unpacked poses are not changed", () => {
  const message = { ...HEAD, poses: Float64Array.from([1, 2, 3, 0, 0, 0, 1]) };
  expect(posesOf(message)).toBe(message);
});

test("positions are in tenths of a millimetre", () => {
  const pose = rotation([12_345, -20_000, 1, 0, 0, 70_000], [...Array(6)].map(() => packed(0) | 0));
  [1.2345, -2, 1e-4, 0, 0, 7].forEach((metres, k) => expect(pose[k < 3 ? k : k + 4]).toBeCloseTo(metres, 12));
});

test("the omitted component of a rotation follows from the others", () => {
  const others = [0.1, -0.3, 0.2];
  const largest = Math.sqrt(1 - 0.01 - 0.09 - 0.04);
  for (let missing = 0; missing < 4; missing++) {
    const numbers = others.map(packed);
    if (missing >= 2) numbers[0]! |= 0x8000;
    if (missing % 2 === 1) numbers[1]! |= 0x8000;
    const expected = [...others];
    expected.splice(missing, 0, largest);
    const found = rotation([0, 0, 0], numbers).slice(3);
    found.forEach((value, k) => expect(value).toBeCloseTo(expected[k]!, 3));
  }
});
