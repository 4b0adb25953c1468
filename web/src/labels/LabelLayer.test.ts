// @vitest-environment jsdom
import { PerspectiveCamera } from "three";
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { LabelHover } from "./LabelHover";
import { LabelLayer } from "./LabelLayer";
import type { TestCanvas } from "./testCanvas";
import { useTestCanvas } from "./testCanvas";

// The camera is at the origin and looks along -z. It has a vertical field of view of 90 degrees and
// an aspect ratio of 2.
const camera = new PerspectiveCamera(90, 2, 0.1, 100);
camera.updateMatrixWorld(true);
const clipFromWorld = camera.projectionMatrix.clone().multiply(camera.matrixWorldInverse).elements;

type Robot = [name: string, x: number, y: number, z: number, badness?: number];

let canvas: TestCanvas;

beforeEach(() => {
  vi.useFakeTimers();
  canvas = useTestCanvas();
});

afterEach(() => {
  canvas.restore();
  vi.unstubAllGlobals();
  vi.useRealTimers();
});

function place(layer: LabelLayer, robots: Robot[], selection: string | null = null) {
  const view = { clipFromWorld, eye: { x: 0, y: 0, z: 0 }, width: 800, height: 400 };
  layer.place(view, {
    names: robots.map(([name]) => name),
    tops: Float64Array.from(robots.flatMap(([, x, y, z]) => [x, y, z])),
    badness: (i) => robots[i]![4] ?? 0,
    isShown: () => true,
    selection,
    isMoving: false,
  });
}

test("a label is above its robot's place, on whole pixels of the screen", () => {
  vi.stubGlobal("devicePixelRatio", 1.5);
  const layer = new LabelLayer();
  place(layer, [["abc", 2.001, 1.001, -2]]);
  const [{ x, y, width, height }] = layer.shown as [(typeof layer.shown)[0]];
  expect(Math.abs(x + width / 2 - 600)).toBeLessThan(1);
  expect(Math.abs(y + height - 100)).toBeLessThan(1);
  const [[, , , , left, top]] = canvas.copies as [number[]];
  expect([left, top]).toEqual([1.5 * x, 1.5 * y]);
  expect([left! % 1, top! % 1]).toEqual([0, 0]);
  const drawn = layer.element.querySelector("canvas")!;
  expect([drawn.width, drawn.height, drawn.style.width, drawn.style.height]).toEqual([1200, 600, "800px", "400px"]);
});

test("labels have the look of their state and of the selection", () => {
  const layer = new LabelLayer();
  const robots: Robot[] = [
    ["good", -2, 0, -3],
    ["bad", 0, 0, -3, 2],
    ["chosen", 2, 0, -3],
  ];
  place(layer, robots, "chosen");
  expect(layer.shown.map(({ name, kind }) => [name, kind])).toEqual([
    ["chosen", "label selected"],
    ["bad", "label trouble"],
    ["good", "label"],
  ]);
});

test("a frame in which no label has changed draws nothing", () => {
  const layer = new LabelLayer();
  place(layer, [["a", 0, 0, -3]]);
  place(layer, [["a", 0, 0, -3]]);
  expect(canvas.copies.length).toBe(1);
  place(layer, [["a", 0.1, 0, -3]]);
  expect(canvas.copies.length).toBe(2);
  layer.renewLook();
  place(layer, [["a", 0.1, 0, -3]]);
  expect(canvas.copies.length).toBe(3);
  expect(canvas.texts.length).toBe(2);
});

test("a renamed robot, and a screen with other pixels, get new labels", () => {
  const layer = new LabelLayer();
  place(layer, [["a", 0, 0, -3]]);
  place(layer, [["b", 0, 0, -3]]);
  vi.stubGlobal("devicePixelRatio", 2);
  place(layer, [["b", 0, 0, -3]]);
  expect(canvas.texts.map(({ text, font }) => [text, /[\d.]+px/.exec(font)![0]])).toEqual([
    ["a", "11.5px"],
    ["b", "11.5px"],
    ["b", "23px"],
  ]);
  expect(layer.shown.map(({ name }) => name)).toEqual(["b"]);
});

test("a place in a label is its robot's, if labels are shown and can be picked", () => {
  const layer = new LabelLayer();
  place(layer, [
    ["<b>a</b>", -1, 0, -3],
    ["b", 1, 0, -3],
  ]);
  for (const { name, x, y, width, height } of layer.shown) {
    expect(layer.at(x + 1, y + 1)).toBe(name);
    expect(layer.at(x + width - 1, y + height - 1)).toBe(name);
    expect(layer.at(x - 1, y + 1)).toBeNull();
    expect(layer.at(x + 1, y + height + 1)).toBeNull();
  }
  const { x, y } = layer.shown[0]!;
  layer.isPickable = false;
  expect(layer.at(x + 1, y + 1)).toBeNull();
  layer.isPickable = true;
  layer.element.hidden = true;
  expect(layer.at(x + 1, y + 1)).toBeNull();
});

test("the pointer shows that a label can be clicked, also if the label moves", () => {
  const layer = new LabelLayer();
  const view = document.createElement("canvas");
  const hover = new LabelHover(view, layer);
  const move = (x: number, y: number) => view.dispatchEvent(Object.assign(new Event("pointermove"), { pointerType: "mouse", buttons: 0, offsetX: x, offsetY: y }));
  place(layer, [["a", 0, 0, -3]]);
  move(400, 195);
  expect(view.className).toBe("on-label");
  place(layer, [["a", 2, 0, -3]]);
  hover.update();
  expect(view.className).toBe("");
  place(layer, [["a", 0, 0, -3]]);
  hover.update();
  expect(view.className).toBe("on-label");
  view.dispatchEvent(new Event("pointerleave"));
  expect(view.className).toBe("");
});

test("screen readers get the most important names as a text", () => {
  const layer = new LabelLayer();
  const text = () => layer.element.querySelector("p")!.textContent;
  place(layer, [["far", 1, 0, -4], ["near", -1, 0, -3]]);
  expect(text()).toBe("");
  vi.advanceTimersByTime(1000);
  expect(text()).toBe("Names in the view: near, far");
  const row = Array.from({ length: 60 }, (_, i): Robot => [`${i}`, (i % 10) - 4.5, Math.floor(i / 10) - 2.5, -5]);
  place(layer, row);
  vi.advanceTimersByTime(1000);
  expect(text()).toMatch(/^Names in the view: (\d+, ){39}\d+ and 20 more$/);
  layer.clear();
  vi.advanceTimersByTime(1000);
  expect(text()).toBe("");
});

test("an image of the view gets the labels with the image's own number of pixels", () => {
  const layer = new LabelLayer();
  place(layer, [["a", 0, 0, -3]]);
  const image = document.createElement("canvas");
  image.width = 400;
  layer.paint(image.getContext("2d")!, 800);
  expect(canvas.texts.map(({ font }) => /[\d.]+px/.exec(font)![0])).toEqual(["11.5px", "5.75px"]);
});
