import { Matrix4 } from "three";
import { expect, test } from "vitest";
import { BodyLayer } from "./BodyLayer";
import { ShownPoses } from "./ShownPoses";
import { body, scene } from "./testScene";

const WALL = body("wall", { isRobot: false, isStatic: true, pose: [1, 2, 3, 0, 0, 0, 1] });
const BOX = body("box", { isRobot: false, pose: [4, 5, 6, 0, 0, 0, 1] });

test("the reported pose of a body is not the one to which it is dragged", () => {
  const bodies = new BodyLayer(scene({ bodies: [WALL, BOX], poses: [{ body: 1, link: null }] }));
  const poses = new ShownPoses(() => {});
  poses.setScene(bodies);
  const x = (name: string) => poses.reportedOf(name)?.elements[12];
  for (const index of [0, 1]) bodies.moveBody(index, new Matrix4().makeTranslation(7, 8, 9));
  expect([x("wall"), x("box"), x("nothing")]).toEqual([1, 4, undefined]);
  poses.take({ step: 1n, stamp: { sec: 1, nsec: 0 }, layout_version: bodies.scene.layoutVersion, poses: new Float64Array([11, 0, 0, 0, 0, 0, 1]) } as never);
  expect([x("wall"), x("box")]).toEqual([1, 11]);
});
