// @vitest-environment jsdom
import { afterEach, beforeEach, expect, test } from "vitest";
import type { LabelImage } from "./LabelAtlas";
import { LabelAtlas } from "./LabelAtlas";
import { LabelPainter } from "./LabelPainter";
import type { TestCanvas } from "./testCanvas";
import { useTestCanvas } from "./testCanvas";

let canvas: TestCanvas;

beforeEach(() => {
  canvas = useTestCanvas();
});

afterEach(() => canvas.restore());

const makeAtlas = (ratio = 1) => new LabelAtlas(new LabelPainter(document.createElement("div")), ratio);

function isInside(atlas: LabelAtlas, { x, y, width, height }: LabelImage): boolean {
  return x >= 0 && y >= 0 && x + width <= atlas.canvas.width && y + height <= atlas.canvas.height;
}

function overlapOf(images: readonly LabelImage[]): number {
  const isOver = (a: LabelImage, b: LabelImage) => a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
  return images.flatMap((a, i) => images.slice(i + 1).filter((b) => isOver(a, b))).length;
}

test("each name is drawn once, and once more with another look", () => {
  const atlas = makeAtlas();
  for (let frame = 0; frame < 3; frame++) {
    atlas.beginFrame();
    atlas.imageOf("a", "label");
    atlas.imageOf("b", "label");
  }
  expect(canvas.texts.map(({ text }) => text)).toEqual(["a", "b"]);
  atlas.beginFrame();
  atlas.imageOf("a", "label selected");
  expect(canvas.texts.map(({ text }) => text)).toEqual(["a", "b", "a"]);
});

test("labels have the size of the screen's pixels", () => {
  const one = makeAtlas().imageOf("robot", "label")!;
  const two = makeAtlas(2).imageOf("robot", "label")!;
  expect(one.height).toBe(18);
  expect(two.height).toBe(36);
  expect(two.width).toBeGreaterThanOrEqual(2 * one.width - 2);
  expect(canvas.texts.map(({ font }) => /[\d.]+px/.exec(font)![0])).toEqual(["11.5px", "23px"]);
});

test("the canvas grows for hundreds of labels, which do not overlap", () => {
  const atlas = makeAtlas();
  const height = atlas.canvas.height;
  atlas.beginFrame();
  const images = Array.from({ length: 500 }, (_, i) => atlas.imageOf(`robot_${i}`, "label")!);
  expect(atlas.canvas.height).toBeGreaterThan(height);
  expect(images.every((image) => isInside(atlas, image))).toBe(true);
  expect(overlapOf(images)).toBe(0);
  expect(canvas.texts.length).toBe(500);
});

test("if the canvas is full, the labels that were not used for the longest time are removed", () => {
  const atlas = makeAtlas();
  const name = (i: number) => `${i}`.padEnd(40, "_");
  let i = 0;
  for (let size = -1; atlas.size > size; i++) {
    size = atlas.size;
    atlas.beginFrame();
    expect(atlas.imageOf(name(0), "label")).not.toBeNull(); // used in every frame
    atlas.imageOf(name(i), "label");
    if (i === 0) size = -1;
  }
  expect(i).toBeGreaterThan(500);
  expect(atlas.canvas.height).toBeLessThanOrEqual(2048);
  const drawn = canvas.texts.length;
  atlas.beginFrame();
  atlas.imageOf(name(0), "label");
  atlas.imageOf(name(i - 2), "label");
  expect(canvas.texts.length).toBe(drawn);
  atlas.imageOf(name(1), "label"); // one of the oldest
  expect(canvas.texts.length).toBe(drawn + 1);
});

test("the labels of one frame stay, even if no more fit", () => {
  const atlas = makeAtlas();
  atlas.beginFrame();
  const images: LabelImage[] = [];
  for (let i = 0; ; i++) {
    const image = atlas.imageOf(`${i}`.padEnd(100, "_"), "label");
    if (!image) break;
    images.push(image);
  }
  expect(overlapOf(images)).toBe(0);
  expect(atlas.size).toBe(images.length);
  atlas.beginFrame();
  expect(atlas.imageOf("another", "label")).not.toBeNull();
});

test("the middle of a very long name is left out", () => {
  const atlas = makeAtlas();
  const image = atlas.imageOf(`first${"x".repeat(100)}last`, "label")!;
  expect(image.width).toBeLessThanOrEqual(320 + 2 * 6);
  expect(canvas.texts[0]!.text).toMatch(/^firstx+…x+last$/);
});
