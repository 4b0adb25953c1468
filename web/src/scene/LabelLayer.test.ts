// @vitest-environment jsdom
import { PerspectiveCamera } from "three";
import { expect, test, vi } from "vitest";
import { LabelLayer } from "./LabelLayer";

// The camera is at the origin and looks along -z. It has a vertical field of view of 90 degrees and
// an aspect ratio of 2.
const camera = new PerspectiveCamera(90, 2, 0.1, 100);
camera.updateMatrixWorld(true);

type Robot = [name: string, x: number, y: number, z: number, badness?: number];

function place(layer: LabelLayer, robots: Robot[], selection: string | null = null, hidden: string[] = []) {
  layer.place(camera, 800, 400, {
    names: robots.map(([name]) => name),
    tops: Float64Array.from(robots.flatMap(([, x, y, z]) => [x, y, z])),
    badness: (i) => robots[i]![4] ?? 0,
    isShown: (i) => !hidden.includes(robots[i]![0]),
    selection,
    isMoving: false,
  });
}

function texts(layer: LabelLayer): (string | null)[] {
  return [...layer.element.children].map((label) => label.textContent);
}

test("a label is at its robot's place in the image", () => {
  const layer = new LabelLayer(() => {});
  place(layer, [["a", 2, 1, -2]]);
  expect((layer.element.firstChild as HTMLElement).style.transform).toContain("translate(600.0px, 100.0px)");
});

test("robots behind the camera or outside the image have no label", () => {
  const layer = new LabelLayer(() => {});
  place(layer, [
    ["behind", 0, 0, 5],
    ["aside", 9, 0, -2],
    ["seen", 0, 0, -3],
  ]);
  expect(texts(layer)).toEqual(["seen"]);
});

test("robots that a filter excludes have no label", () => {
  const layer = new LabelLayer(() => {});
  place(layer, [["a", -1, 0, -3], ["b", 1, 0, -3]], null, ["a"]);
  expect(texts(layer)).toEqual(["b"]);
});

test("of overlapping labels, the selected one has priority, then the worst, then the nearest", () => {
  const layer = new LabelLayer(() => {});
  const near: Robot = ["near", 0, 0, -2];
  const far: Robot = ["far", 0, 0, -4];
  place(layer, [far, near]);
  expect(texts(layer)).toEqual(["near"]);
  place(layer, [["far", 0, 0, -4, 2], near]);
  expect(texts(layer)).toEqual(["far"]);
  expect(layer.element.firstElementChild!.classList.contains("trouble")).toBe(true);
  place(layer, [["far", 0, 0, -4, 2], near], "near");
  expect(texts(layer)).toEqual(["near"]);
});

test("while robots move, their labels follow them, and other robots get labels a little later", () => {
  vi.useFakeTimers({ toFake: ["performance"] });
  const layer = new LabelLayer(() => {});
  const names = ["a", "b"];
  const show = (xOfA: number, zOfA: number, selection: string | null = null) => {
    const tops = Float64Array.from([xOfA, 0, zOfA, 0, 0, -3]);
    layer.place(camera, 800, 400, { names, tops, badness: () => 0, isShown: () => true, selection, isMoving: true });
    return [...layer.element.children].map((label) => `${label.textContent} ${/translate\((\S+)px/.exec((label as HTMLElement).style.transform)![1]}`);
  };
  expect(show(0, -2)).toEqual(["a 400.0"]); // a is in front of b
  expect(show(0.04, -4)).toEqual(["a 402.0"]); // a is behind b
  expect(show(0.04, -4, "b")).toEqual(["b 400.0"]); // a new selection counts at once
  show(0.04, -4);
  expect(show(0.04, -2)).toEqual(["b 400.0"]);
  vi.advanceTimersByTime(200);
  expect(show(0.04, -2)).toEqual(["a 404.0"]);
  expect(show(9, -2)).toEqual([]); // outside the image
  vi.useRealTimers();
});

test("no two labels of a crowd overlap", () => {
  const layer = new LabelLayer(() => {});
  const crowd = Array.from({ length: 400 }, (_, i): Robot => [`robot_${i}`, (i % 20) / 5 - 2, Math.floor(i / 20) / 10 - 1, -3]);
  place(layer, crowd);
  const boxes = [...layer.element.children].map((label) => {
    const [, x, y] = /translate\((-?[\d.]+)px, (-?[\d.]+)px\)/.exec((label as HTMLElement).style.transform)!.map(Number);
    return { x: x!, y: y!, width: 7 * label.textContent!.length + 12, height: 18 };
  });
  expect(boxes.length).toBeGreaterThan(10);
  expect(boxes.length).toBeLessThanOrEqual(40);
  boxes.forEach((a, i) =>
    boxes.slice(i + 1).forEach((b) => {
      const isApart = Math.abs(a.x - b.x) >= (a.width + b.width) / 2 || Math.abs(a.y - b.y) >= a.height;
      expect(isApart).toBe(true);
    }),
  );
});

test("a click on a label selects its robot, and markup in a name is shown as text", () => {
  const onPick = vi.fn();
  const layer = new LabelLayer(onPick);
  place(layer, [["<b>a</b>", 0, 0, -3]], "<b>a</b>");
  const label = layer.element.firstChild as HTMLElement;
  expect(label.classList.contains("selected")).toBe(true);
  label.click();
  expect(onPick).toHaveBeenCalledWith("<b>a</b>");
});
