import { deflateSync } from "node:zlib";
import { expect, test } from "vitest";
import { valuesOfGreyPng } from "./greyPng";
import { coloured } from "./valueImage";

function chunk(type: string, content: Uint8Array): Uint8Array {
  const bytes = new Uint8Array(12 + content.length);
  new DataView(bytes.buffer).setUint32(0, content.length);
  bytes.set(new TextEncoder().encode(type), 4);
  bytes.set(content, 8); // the checksum stays 0, because it is not checked
  return bytes;
}

function png(values: number[], width: number, { depth = 16, filter = 0 } = {}): Uint8Array {
  const height = values.length / width;
  const head = new Uint8Array(13);
  new DataView(head.buffer).setUint32(0, width);
  new DataView(head.buffer).setUint32(4, height);
  head.set([depth, 0, 0, 0, 0], 8);
  const rows = new Uint8Array((1 + 2 * width) * height);
  values.forEach((value, i) => {
    const row = (1 + 2 * width) * Math.floor(i / width);
    rows[row] = filter;
    new DataView(rows.buffer).setUint16(row + 1 + 2 * (i % width), value);
  });
  const packed = deflateSync(rows);
  const parts = [
    new Uint8Array([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]),
    chunk("IHDR", head),
    chunk("IDAT", packed.subarray(0, 5)), // the data is divided into two chunks
    chunk("IDAT", packed.subarray(5)),
    chunk("IEND", new Uint8Array()),
  ];
  return new Uint8Array(parts.flatMap((part) => [...part]));
}

test("the smallest value is dark and the largest bright", async () => {
  const values = (await valuesOfGreyPng(png([28815, 28815, 35000, 31908], 2)))!;
  expect([...values.values]).toEqual([28815, 28815, 35000, 31908]);
  const image = coloured(values);
  expect([image.width, image.height]).toEqual([2, 2]);
  expect([...image.rgba.slice(0, 4)]).toEqual([0, 0, 4, 255]);
  expect([...image.rgba.slice(8, 12)]).toEqual([252, 255, 164, 255]);
});

test("an image of equal values has one colour", async () => {
  const { rgba } = coloured((await valuesOfGreyPng(png([7, 7], 2)))!);
  expect([...rgba]).toEqual([0, 0, 4, 255, 0, 0, 4, 255]);
});

test("other images and incomplete images are left to other decoders", async () => {
  const whole = png([1, 2, 3, 4], 2);
  expect(await valuesOfGreyPng(png([1, 2], 2, { depth: 8 }))).toBeNull();
  expect(await valuesOfGreyPng(png([1, 2], 2, { filter: 1 }))).toBeNull();
  expect(await valuesOfGreyPng(whole.subarray(0, 40))).toBeNull();
  expect(await valuesOfGreyPng(new Uint8Array(50))).toBeNull();
});
