import { PerspectiveCamera } from "three";
import { expect, test, vi } from "vitest";
import type { LabelView } from "./LabelChoice";
import { LabelChoice, MAX_LABELS } from "./LabelChoice";

// The camera is at the origin and looks along -z. It has a vertical field of view of 90 degrees and
// an aspect ratio of 2.
const camera = new PerspectiveCamera(90, 2, 0.1, 100);
camera.updateMatrixWorld(true);
const clipFromWorld = camera.projectionMatrix.clone().multiply(camera.matrixWorldInverse).elements;
const view: LabelView = { clipFromWorld, eye: { x: 0, y: 0, z: 0 }, width: 800, height: 400 };

type Robot = [name: string, x: number, y: number, z: number, badness?: number];

const WIDTH = 60;
const makeChoice = () => new LabelChoice(() => WIDTH);

function chosen(choice: LabelChoice, robots: Robot[], selection: string | null = null, hidden: string[] = [], of = view) {
  const found = choice.choose(of, {
    names: robots.map(([name]) => name),
    tops: Float64Array.from(robots.flatMap(([, x, y, z]) => [x, y, z])),
    badness: (i) => robots[i]![4] ?? 0,
    isShown: (i) => !hidden.includes(robots[i]![0]),
    selection,
    isMoving: false,
  });
  return found.map((robot) => ({ name: robots[robot]![0], x: choice.across[robot]!, y: choice.down[robot]! }));
}

const names = (...given: Parameters<typeof chosen>) => chosen(...given).map(({ name }) => name);

test("a label is at its robot's place in the view", () => {
  const [label] = chosen(makeChoice(), [["a", 2, 1, -2]]);
  expect(label!.x).toBeCloseTo(600);
  expect(label!.y).toBeCloseTo(100);
});

test("robots behind the camera or outside the view have no label", () => {
  const robots: Robot[] = [
    ["behind", 0, 0, 5],
    ["aside", 9, 0, -2],
    ["seen", 0, 0, -3],
  ];
  expect(names(makeChoice(), robots)).toEqual(["seen"]);
});

test("robots that a filter excludes have no label", () => {
  expect(names(makeChoice(), [["a", -1, 0, -3], ["b", 1, 0, -3]], null, ["a"])).toEqual(["b"]);
});

test("of overlapping labels, the selected one has priority, then the worst, then the nearest", () => {
  const choice = makeChoice();
  const near: Robot = ["near", 0, 0, -2];
  expect(names(choice, [["far", 0, 0, -4], near])).toEqual(["near"]);
  expect(names(choice, [["far", 0, 0, -4, 2], near])).toEqual(["far"]);
  expect(names(choice, [["far", 0, 0, -4, 2], near], "near")).toEqual(["near"]);
});

test("while robots move, their labels follow them, and other robots get labels a little later", () => {
  vi.useFakeTimers({ toFake: ["performance"] });
  const choice = makeChoice();
  const both = ["a", "b"];
  const show = (xOfA: number, zOfA: number, selection: string | null = null) => {
    const tops = Float64Array.from([xOfA, 0, zOfA, 0, 0, -3]);
    const found = choice.choose(view, { names: both, tops, badness: () => 0, isShown: () => true, selection, isMoving: true });
    return found.map((robot) => `${both[robot]} ${choice.across[robot]!.toFixed(1)}`);
  };
  expect(show(0, -2)).toEqual(["a 400.0"]); // a is in front of b
  expect(show(0.04, -4)).toEqual(["a 402.0"]); // a is behind b
  expect(show(0.04, -4, "b")).toEqual(["b 400.0"]); // a new selection counts at once
  show(0.04, -4);
  expect(show(0.04, -2)).toEqual(["b 400.0"]);
  vi.advanceTimersByTime(200);
  expect(show(0.04, -2)).toEqual(["a 404.0"]);
  expect(show(9, -2)).toEqual([]); // outside the view
  vi.useRealTimers();
});

test("no two labels of a crowd overlap, and no label is left out that has room", () => {
  const crowd = Array.from({ length: 400 }, (_, i): Robot => [`robot_${i}`, (i % 20) / 5 - 2, Math.floor(i / 20) / 10 - 1, -3]);
  const labels = chosen(makeChoice(), crowd);
  expect(labels.length).toBeGreaterThan(20);
  const all = chosen(new LabelChoice(() => 0), crowd, null, [], { ...view, height: 1e6 });
  expect(all.length).toBe(400);
  const isApart = (a: { x: number; y: number }, b: { x: number; y: number }) => Math.abs(a.x - b.x) >= WIDTH || Math.abs(a.y - b.y) >= 18;
  labels.forEach((a, i) => expect(labels.slice(i + 1).every((b) => isApart(a, b))).toBe(true));
  const places = all.map(({ name, x, y }) => ({ name, x, y: (y * view.height) / 1e6 }));
  for (const robot of places) {
    if (labels.some(({ name }) => name === robot.name)) continue;
    expect(labels.some((label) => Math.abs(label.x - robot.x) < WIDTH + 2 && Math.abs(label.y - robot.y) < 20)).toBe(true);
  }
});

test("hundreds of labels are shown where there is room, up to a limit", () => {
  const crowd = Array.from({ length: 900 }, (_, i): Robot => [`robot_${i}`, (i % 30) / 5 - 3, Math.floor(i / 30) / 10 - 1.5, -4]);
  const large = { ...view, width: 8000, height: 4000 };
  expect(names(makeChoice(), crowd, null, [], large).length).toBe(MAX_LABELS);
});
