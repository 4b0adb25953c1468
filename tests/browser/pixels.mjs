// Checks images by their pixels. An image is the result of pngjs: {width, height, data: RGBA}.
import { requireFromWeb } from "./browser.mjs";

const { PNG } = requireFromWeb("pngjs");

// A difference above this value (of 255) counts as another colour.
const SAME_COLOUR = 24;
const BLANK_SHARE = 0.985;

// Returns the part of the page inside `clip` (in CSS pixels, which equal device pixels in the
// tests).
export async function picture(page, clip) {
  return PNG.sync.read(await page.screenshot({ clip, animations: "disabled", caret: "hide" }));
}

// Returns the part of an image inside `rectangle`, in the image's coordinates.
export function cut(image, { x, y, width, height }) {
  const part = new PNG({ width, height });
  PNG.bitblt(image, part, x, y, width, height, 0, 0);
  return part;
}

// Returns whether nearly all pixels have one colour: nothing was drawn, or only a background.
export function isBlank(image) {
  const counts = new Map();
  let most = 0;
  for (let i = 0; i < image.data.length; i += 4) {
    const key = (image.data[i] >> 3) * 1024 + (image.data[i + 1] >> 3) * 32 + (image.data[i + 2] >> 3);
    const count = (counts.get(key) ?? 0) + 1;
    counts.set(key, count);
    most = Math.max(most, count);
  }
  return most / (image.data.length / 4) > BLANK_SHARE;
}

// Returns the number of pixels of `after` that differ from `before` and whose colour satisfies the
// test.
export function changedPixels(before, after, isWanted = () => true) {
  let changed = 0;
  for (let i = 0; i < after.data.length; i += 4) {
    const [r, g, b] = after.data.subarray(i, i + 3);
    const difference = Math.max(
      Math.abs(r - before.data[i]),
      Math.abs(g - before.data[i + 1]),
      Math.abs(b - before.data[i + 2]),
    );
    if (difference > SAME_COLOUR && isWanted(r, g, b)) changed += 1;
  }
  return changed;
}

export const isRed = (r, g, b) => r > 120 && r > 1.6 * g && r > 1.6 * b;
export const isOrange = (r, g, b) => r > 180 && g > 90 && g < 200 && b < 90;
export const isBlue = (r, g, b) => b > 150 && b > 1.3 * r && b > 1.1 * g;
export const isGreen = (r, g, b) => g > 110 && g > 1.5 * r && g > 1.5 * b;
export const isYellow = (r, g, b) => r > 120 && g > 100 && r > 1.5 * b && g > 1.4 * b;

// Returns whether an image shows the label of a robot: light text on a dark ground.
export function showsLabel(image) {
  let [dark, light] = [0, 0];
  for (let i = 0; i < image.data.length; i += 4) {
    const channels = image.data.subarray(i, i + 3);
    if (Math.max(...channels) < 120) dark += 1;
    if (Math.min(...channels) > 200) light += 1;
  }
  const pixels = image.data.length / 4;
  return dark > 0.5 * pixels && light > 0.02 * pixels;
}

// Returns a square of `size` pixels around a place on the page.
export function around({ x, y }, size) {
  return { x: Math.round(x - size / 2), y: Math.round(y - size / 2), width: size, height: size };
}
