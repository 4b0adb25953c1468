import { Matrix4 } from "three";
import { expect, test } from "vitest";
import { shortWay } from "../live/angle";
import { rotationOf } from "../scene/poses";
import { SelectedPose } from "./SelectedPose";

function at(x: number, stamp: number) {
  return { pose: new Matrix4().makeRotationZ(0.5).setPosition(x, 2, 0), stamp };
}

test("the pose has position, heading, and the speed in simulated time", () => {
  const selected = new SelectedPose();
  expect(selected.update("a", at(1, 10), 0)).toEqual({
    x: 1,
    y: 2,
    z: 0,
    roll: expect.closeTo(0),
    pitch: expect.closeTo(0),
    yaw: expect.closeTo(0.5),
    speed: 0,
    turnRate: 0,
  });
  expect(selected.update("a", at(1.25, 10.5), 100)?.speed).toBeCloseTo(0.5);
});

test("values change at a readable rate", () => {
  const selected = new SelectedPose();
  selected.update("a", at(1, 0), 0);
  expect(selected.update("a", at(2, 0.05), 50)).toBeNull();
  expect(selected.update("b", at(2, 0.05), 60)).not.toBeNull();
});

test("a reset does not count as speed", () => {
  const selected = new SelectedPose();
  selected.update("a", at(9, 100), 0);
  expect(selected.update("a", at(0, 0), 200)?.speed).toBe(0);
});

test("a jump in a recording does not count as speed", () => {
  const selected = new SelectedPose();
  selected.update("a", at(0, 1), 0);
  expect(selected.update("a", at(9, 31), 200)?.speed).toBe(0);
});

test("a rotation across pi is small", () => {
  const facing = (yaw: number, stamp: number) => ({ pose: new Matrix4().makeRotationZ(yaw), stamp });
  const selected = new SelectedPose();
  selected.update("a", facing(3.1, 0), 0);
  const { turnRate } = selected.update("a", facing(-3.1, 0.5), 200)!;
  expect(turnRate).toBeCloseTo((2 * Math.PI - 6.2) / 0.5);
  expect(shortWay(-2 * Math.PI)).toBeCloseTo(0);
});

test("the heading of a tilted robot is that of its x axis", () => {
  const tilted = new Matrix4().makeRotationZ(-2).multiply(new Matrix4().makeRotationY(0.3));
  const { roll, pitch, yaw } = rotationOf(tilted);
  expect([roll, pitch, yaw]).toEqual([expect.closeTo(0), expect.closeTo(0.3), expect.closeTo(-2)]);
});
