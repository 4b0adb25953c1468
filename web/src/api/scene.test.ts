import { expect, test } from "vitest";
import { camerasOf, parseScene, robotsOf } from "./scene";

const HERE = [0, 0, 0, 0, 0, 0, 1];

function document() {
  return {
    layout_version: 3,
    name: "house",
    bounds: { min: [-1, -2, 0], max: [1, 2, 3] },
    look: { ambient: [0.4, 0.4, 0.4], background: [0.7, 0.7, 0.7], shadows: true, sky: false },
    lights: [
      {
        name: "sun",
        kind: "directional",
        pose: [0, 0, 10, 0, 0, 0, 1],
        direction: [0, 0, -1],
        colour: [1, 1, 1],
        intensity: 1,
        range_m: 20,
        inner_angle_rad: 0,
        outer_angle_rad: 0,
        cast_shadows: true,
      },
    ],
    bodies: [
      { name: "wall", model: "w-1", is_static: true, pose: HERE, links: ["link"], sensors: [] },
      {
        name: "robbie",
        model: "r-1",
        is_static: false,
        is_robot: true,
        pose: HERE,
        links: ["base", "wheel"],
        sensors: [
          { name: "eye", type: "camera", overlay: "picture", link: "base", topic: "/robbie/eye" },
          { name: "front", type: "sonar", overlay: "lines", link: "base", topic: "/robbie/front" },
        ],
      },
      { name: "me", model: "r-1", is_static: false, is_avatar: true, pose: HERE, links: [], sensors: [] },
    ],
    poses: [
      { body: 1, link: null },
      { body: 1, link: "wheel" },
    ],
  };
}

test("a scene is read with its lights, its bodies, and the body of each pose", () => {
  const scene = parseScene(document());
  expect(scene.layoutVersion).toBe(3);
  expect(scene.bounds.max).toEqual([1, 2, 3]);
  expect(scene.lights[0]).toMatchObject({ kind: "directional", position: [0, 0, 10], castShadows: true });
  expect(scene.bodies[0]).toMatchObject({ isStatic: true, isRobot: false });
  expect(scene.poses[1]).toEqual({ body: 1, link: "wheel" });
});

test("robots and avatars are listed, and their cameras", () => {
  const scene = parseScene(document());
  expect(robotsOf(scene).map(({ name }) => name)).toEqual(["robbie", "me"]);
  expect(camerasOf(scene)).toEqual([{ robot: "robbie", sensor: "eye", topic: "/robbie/eye" }]);
  expect(camerasOf(null)).toEqual([]);
});

test.each([
  [
    "a pose of six numbers",
    (d: ReturnType<typeof document>) => d.bodies[0]!.pose.pop(),
    "bodies[0].pose: expected 7 numbers, found 6",
  ],
  [
    "a pose for a body that is not there",
    (d: ReturnType<typeof document>) => (d.poses[1]!.body = 3),
    "poses[1].body: expected a body index from 0 to 2, found 3",
  ],
  [
    "an unknown light",
    (d: ReturnType<typeof document>) => (d.lights[0]!.kind = "laser"),
    "lights[0].kind: expected directional, point or spot, found laser",
  ],
  [
    "no bounds",
    (d: ReturnType<typeof document>) => Reflect.deleteProperty(d, "bounds"),
    "bounds: expected an object, found nothing",
  ],
])("%s is refused with its place", (_, damage, sentence) => {
  const damaged = structuredClone(document());
  damage(damaged);
  expect(() => parseScene(damaged)).toThrow(sentence);
});
