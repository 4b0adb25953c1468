import { expect, test } from "vitest";
import { parseJoints } from "./joints";

test("joints are read with their limits and commands", () => {
  const { joints, refusal, time } = parseJoints({
    body: "arm",
    time_s: 2,
    joints: [
      { name: "elbow", kind: "revolute", unit: "rad", position: 0.5, velocity: 0, minimum: -1, maximum: 1, command: { position: 0.6 } },
      { name: "wheel", kind: "continuous", unit: "rad", position: 9, velocity: 1, refusal: "it is the drive's" },
    ],
  });
  expect([time, refusal]).toEqual([2, ""]);
  expect(joints[0]).toMatchObject({ name: "elbow", minimum: -1, maximum: 1, maxVelocity: Infinity, command: { kind: "position", value: 0.6 }, refusal: "" });
  expect(joints[1]).toMatchObject({ minimum: -Infinity, command: null, refusal: "it is the drive's" });
});
