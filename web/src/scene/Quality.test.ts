import { expect, test } from "vitest";
import { Quality } from "./Quality";

function frames(quality: Quality, count: number, milliseconds: number): void {
  for (let i = 0; i < count; i++) quality.frameTook(milliseconds);
}

test("a dense screen is drawn with at most two pixels per CSS pixel", () => {
  expect(new Quality(3, false).pixelRatio).toBe(2);
});

test("slow frames reduce the pixels, down to a limit", () => {
  const quality = new Quality(1, false);
  frames(quality, 11, 80);
  expect(quality.pixelRatio).toBe(1);
  frames(quality, 1, 80);
  expect(quality.pixelRatio).toBeCloseTo(0.8);
  frames(quality, 1000, 80);
  expect(quality.pixelRatio).toBeCloseTo(0.6);
});

test("very slow frames have an effect sooner", () => {
  const quality = new Quality(1, false);
  frames(quality, 3, 300);
  expect(quality.pixelRatio).toBeCloseTo(0.8);
});

test("the pixels increase again when there is time", () => {
  const quality = new Quality(1, false);
  frames(quality, 12, 80);
  frames(quality, 1000, 10);
  expect(quality.pixelRatio).toBe(1);
});

test("the quality does not change if the user has fixed it", () => {
  const quality = new Quality(1, true);
  frames(quality, 1000, 80);
  expect(quality.pixelRatio).toBe(1);
});

test("slow frames first end ambient occlusion, and it does not return", () => {
  const quality = new Quality(1, false, true);
  frames(quality, 12, 80);
  expect([quality.hasOcclusion, quality.pixelRatio]).toEqual([false, 1]);
  frames(quality, 500, 10);
  expect(quality.hasOcclusion).toBe(false);
  const fixed = new Quality(1, true, true);
  frames(fixed, 500, 300);
  expect(fixed.hasOcclusion).toBe(true);
});
