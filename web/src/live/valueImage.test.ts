import { expect, test } from "vitest";
import type { PointCloud } from "./clouds";
import { coloured, depthImageOf, spanOf } from "./valueImage";

function cloud(depths: number[], width: number, more: Partial<PointCloud> = {}): PointCloud {
  const data = new Uint8Array(16 * depths.length);
  depths.forEach((depth, i) => new DataView(data.buffer).setFloat32(16 * i + 4, depth, true));
  const fields = [
    { name: "y", offset: 0, datatype: 7, count: 1 },
    { name: "x", offset: 4, datatype: 7, count: 1 },
  ];
  return { width, height: depths.length / width, fields, is_bigendian: false, point_step: 16, row_step: 16 * width, data, ...more };
}

test("a depth camera's points are an image of depths", () => {
  const image = depthImageOf(cloud([1, 2, Infinity, 4.5], 2))!;
  expect([image.width, image.height, image.unit]).toEqual([2, 2, "m"]);
  expect([...image.values]).toEqual([1, 2, Infinity, 4.5]);
  expect(spanOf(image.values)).toEqual([1, 4.5]);
});

test("a lidar's row, and an incomplete cloud, are not images", () => {
  expect(depthImageOf(cloud([1, 2], 2))).toBeNull();
  expect(depthImageOf(cloud([1, 2, 3, 4], 2, { data: new Uint8Array(40) }))).toBeNull();
  expect(depthImageOf(cloud([1, 2, 3, 4], 2, { fields: [] }))).toBeNull();
  expect(depthImageOf(cloud([1, 2, 3, 4], 2, { width: 1e9 }))).toBeNull();
});

test("pixels without a measurement have a separate colour", () => {
  const { rgba } = coloured({ width: 3, height: 1, values: Float32Array.of(1, NaN, 3), unit: "m" });
  expect([...rgba.slice(0, 4)]).toEqual([0, 0, 4, 255]);
  expect([...rgba.slice(4, 8)]).toEqual([32, 38, 46, 255]);
  expect([...rgba.slice(8, 12)]).toEqual([252, 255, 164, 255]);
  expect(spanOf(Float32Array.of(NaN))).toEqual([0, 0]);
});
