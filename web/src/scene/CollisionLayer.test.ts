import { expect, test } from "vitest";
import { Matrix4 } from "three";
import { parseScene } from "../api/scene";
import { collisionScene } from "./CollisionLayer";
import { LineLayer } from "./LineLayer";
import { drawJoint } from "./markings";
import { body, scene } from "./testScene";

test("only the selected robot's collision shapes are shown, or all without a selection", () => {
  const bodies = [body("a", { collisions: "c-1" }), body("b", { collisions: "c-2" }), body("sign")];
  const models = (selection: string | null) =>
    collisionScene(scene({ bodies }), selection).bodies.map(({ model }) => model);
  expect(models(null)).toEqual(["c-1", "c-2", ""]);
  expect(models("b")).toEqual(["", "c-2", ""]);
});

test("a revolute joint has a circle about its axis, and a prismatic joint a bar at each end", () => {
  const lines = new LineLayer({ widthPx: 2 });
  const segments = (kind: string) => {
    lines.begin();
    drawJoint(lines, new Matrix4(), { kind, axis: [0, 0, 1] });
    lines.finish();
    return lines.segments;
  };
  expect([segments("revolute"), segments("prismatic")]).toEqual([13, 3]);
});

test("a scene has collision shapes and joints; older scenes have neither", () => {
  const pose = [0, 0, 0, 0, 0, 0, 1];
  const common = { name: "a", model: "m", pose, links: [], sensors: [] };
  const joint = { name: "hinge", kind: "revolute", link: "door", pose, axis: [0, 0, 1] };
  const parsed = parseScene({
    layout_version: 1,
    bounds: { min: [0, 0, 0], max: [1, 1, 1] },
    look: { ambient: [0, 0, 0], background: [0, 0, 0] },
    lights: [],
    poses: [],
    bodies: [{ ...common, collisions: "c", joints: [joint] }, common],
  });
  expect(parsed.bodies[0]).toMatchObject({ collisions: "c", joints: [joint] });
  expect(parsed.bodies[1]).toMatchObject({ collisions: null, joints: [] });
});
