// Tests the functions of pixels.mjs with generated images.
import assert from "node:assert/strict";
import { test } from "node:test";
import { changedPixels, isBlank, isRed, isYellow } from "./pixels.mjs";

function image(colourAt, width = 40, height = 30) {
  const data = new Uint8Array(4 * width * height);
  for (let i = 0; i < width * height; i++) {
    data.set([...colourAt(i % width, Math.floor(i / width)), 255], 4 * i);
  }
  return { width, height, data };
}

const GREY = [120, 120, 120];

test("an image of one colour is blank, even with a few other pixels", () => {
  assert.equal(isBlank(image(() => GREY)), true);
  assert.equal(isBlank(image((x, y) => (x === 3 && y < 5 ? [255, 0, 0] : GREY))), true);
});

test("an image with content is not blank", () => {
  assert.equal(isBlank(image((x) => (x < 4 ? [200, 30, 30] : GREY))), false);
});

test("changed pixels are counted by their new colour", () => {
  const before = image(() => GREY);
  const after = image((x, y) => (y === 0 ? [250, 10, 10] : y === 1 ? [250, 230, 10] : GREY));
  assert.equal(changedPixels(before, after), 80);
  assert.equal(changedPixels(before, after, isRed), 40);
  assert.equal(changedPixels(before, after, isYellow), 40);
  assert.equal(changedPixels(before, before), 0);
});
