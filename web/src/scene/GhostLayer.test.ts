import { expect, test } from "vitest";
import type { SceneBody, SceneDescription } from "../api/scene";
import { GhostLayer, ghostsOf } from "./GhostLayer";
import type { ModelLibrary } from "./ModelLibrary";

const POSE = [0, 0, 0, 0, 0, 0, 1];

function body(name: string, isRobot: boolean): SceneBody {
  return { name, model: name, isRobot, isAvatar: false, isFixed: false, links: [], sensors: [], pose: POSE } as unknown as SceneBody;
}

const SCENE = {
  layoutVersion: 4,
  bodies: [body("crate", false), body("a", true), body("b", true)],
  poses: [
    { body: 0, link: null },
    { body: 1, link: null },
    { body: 1, link: "wheel" },
    { body: 2, link: null },
  ],
} as unknown as SceneDescription;

const LIBRARY = { get: () => new Promise(() => {}) } as unknown as ModelLibrary;

function posesAt(...xs: number[]): Float64Array {
  return Float64Array.from(xs.flatMap((x) => [x, 0, 0, 0, 0, 0, 1]));
}

test("only robots are ghosts, with the entries of their own poses", () => {
  const { ghosts, entries } = ghostsOf(SCENE);
  expect(ghosts.bodies.map(({ name }) => name)).toEqual(["a", "b"]);
  expect(entries).toEqual([1, 2, 3]);
  expect(ghosts.poses).toEqual([
    { body: 0, link: null },
    { body: 0, link: "wheel" },
    { body: 1, link: null },
  ]);
});

test("a ghost stands where the second recording has its robot", () => {
  const layer = new GhostLayer();
  layer.setScene(SCENE, LIBRARY, () => {});
  layer.setPoses(4, posesAt(9, 1, 2, 3));
  expect(layer.placeOf("a")).toEqual([1, 0, 0]);
  expect(layer.placeOf("b")).toEqual([3, 0, 0]);
  expect(layer.placeOf("crate")).toBeNull();
  layer.setPoses(5, posesAt(9, 7, 7, 7)); // poses of another layout
  layer.setPoses(4, posesAt(9, 7)); // too few poses
  expect(layer.placeOf("b")).toEqual([3, 0, 0]);
  layer.setScene(null, LIBRARY, () => {});
  expect(layer.placeOf("a")).toBeNull();
});
