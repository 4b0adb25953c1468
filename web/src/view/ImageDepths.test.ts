import { expect, test } from "vitest";
import { ImageDepths, depthSpacing, depthsOf } from "./ImageDepths";

const IDENTIFIER = [..."GSV-depth\0"].map((letter) => letter.charCodeAt(0));

function float(value: number): number[] {
  const view = new DataView(new ArrayBuffer(4));
  view.setFloat32(0, value, true);
  return [0, 1, 2, 3].map((i) => view.getUint8(i));
}

// A JPEG's segments with these codes of depths, for an image of 9 × 9 pixels with 2 × 2 depths.
function jpegOf(codes: number[]): Uint8Array {
  const content = [...IDENTIFIER, 9, 0, 9, 0, 8, 0, ...float(100), ...codes];
  return new Uint8Array([0xff, 0xd8, 0xff, 0xe0, 0, 4, 1, 2, 0xff, 0xe9, 0, content.length + 2, ...content, 0xff, 0xda, 0, 0]);
}

test("reads depths from the segment of a JPEG", () => {
  // The numbers 100, 50, 0, 50. The differences from the predictions are 100, -50, -100, 100; as
  // zigzag numbers 200 = 3·64 + 1·8 + 0, 99 = 1·64 + 4·8 + 3, 199 = 3·64 + 0·8 + 7, 200.
  const groups = [8, 9, 3, 11, 12, 1, 15, 8, 3, 8, 9, 3];
  const codes = groups.flatMap((group, i) => (i % 2 === 0 ? [group | (groups[i + 1]! << 4)] : []));
  const depths = depthsOf(jpegOf(codes))!;
  expect([depths.width, depths.height, depths.spacing]).toEqual([9, 9, 8]);
  const corner = (u: number, v: number) => [0.95, 1.5, 2.5, 1e9].map((depth) => depths.hides(u, v, depth));
  expect(corner(0, 0)).toEqual([false, true, true, true]); // 100 / 100 = 1 m
  expect(corner(1, 0)).toEqual([false, false, true, true]); // 100 / 50 = 2 m
  expect(corner(0, 1)).toEqual([false, false, false, false]); // the sky
  expect(corner(1, 1)).toEqual([false, false, true, true]);
});

test("an image without depths, with cut depths or with too many depths has none", () => {
  expect(depthsOf(new Uint8Array([0xff, 0xd8, 0xff, 0xda, 0, 0]))).toBeNull();
  expect(depthsOf(new Uint8Array(0))).toBeNull();
  expect(depthsOf(new Uint8Array([0xff, 0xd8, 0xff, 0xe9, 0]))).toBeNull();
  expect(depthsOf(jpegOf([0xff, 0xff]))).toBeNull();
  const huge = jpegOf([0, 0]);
  huge.set([0xff, 0xff, 0xff, 0xff, 1, 0], 12 + IDENTIFIER.length);
  expect(depthsOf(huge)).toBeNull();
});

test("points on a plane are visible, and points behind it are hidden", () => {
  // The inverse depth falls from 0.5/m at the left to 0.1/m at the right border.
  const numbers = Uint16Array.from([0, 1, 2, 3, 0, 1, 2, 3], (i) => Math.round(60_000 * (1 - (0.8 * Math.min(8 * i, 20)) / 20)));
  const depths = new ImageDepths(21, 5, 8, 120_000, numbers);
  for (const pixel of [0, 3, 4, 7.5, 12, 18, 20]) {
    const depth = 1 / (0.5 - (0.4 * pixel) / 20);
    expect(depths.hides((pixel + 0.5) / 21, 0.5, 0.999 * depth)).toBe(false);
    expect(depths.hides((pixel + 0.5) / 21, 0.5, 1.001 * depth)).toBe(false); // on the plane
    const isAtSample = pixel % 8 === 0 || pixel === 20;
    expect(depths.hides((pixel + 0.5) / 21, 0.5, (isAtSample ? 1.02 : 1.5) * depth)).toBe(true);
  }
});

test("an object hides points up to the middle between its last sample and the next one", () => {
  const depths = new ImageDepths(17, 1, 8, 1000, new Uint16Array([1000, 1000, 100])); // 1 m, and the wall behind it at 10 m
  const at = (pixel: number) => depths.hides((pixel + 0.5) / 17, 0.5, 9.9);
  expect([0, 4, 8, 11].map(at)).toEqual([true, true, true, true]);
  expect([13, 16].map(at)).toEqual([false, false]);
});

test("the distance between depths grows with the image, so that the server accepts it", () => {
  expect(depthSpacing(1366, 768)).toBe(8);
  for (const [width, height] of [[3840, 2160], [4096, 300], [1600, 1000]] as const) {
    const spacing = depthSpacing(width, height);
    const samples = (Math.ceil((width - 1) / spacing) + 1) * (Math.ceil((height - 1) / spacing) + 1);
    expect(samples).toBeLessThanOrEqual(20_000);
    expect(samples).toBeGreaterThan(8000);
  }
});
