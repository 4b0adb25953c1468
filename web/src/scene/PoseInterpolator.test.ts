import { expect, test } from "vitest";
import { PoseInterpolator } from "./PoseInterpolator";

const INTERVAL_MS = 40;

function poseAt(x: number, yaw = 0): Float64Array {
  return Float64Array.of(x, 0, 0, 0, 0, Math.sin(yaw / 2), Math.cos(yaw / 2));
}

function update(step: number, poses: Float64Array) {
  return { step, stamp: step / 100, poses };
}

function xAt(interpolator: PoseInterpolator, nowMs: number): number {
  const out = new Float64Array(7);
  expect(interpolator.read(nowMs, out)).toBe(true);
  return out[0]!;
}

// Returns the poses of a robot that moves at 1 m/s, reported every 40 ms.
function moving(updates: number, jitterMs: (i: number) => number = () => 0): PoseInterpolator {
  const interpolator = new PoseInterpolator();
  for (let i = 0; i < updates; i++) {
    interpolator.push(update(i, poseAt((i * INTERVAL_MS) / 1000)), i * INTERVAL_MS + jitterMs(i));
  }
  return interpolator;
}

test("there is nothing to show before the first update", () => {
  const interpolator = new PoseInterpolator();
  expect(interpolator.read(0, new Float64Array(7))).toBe(false);
  expect(interpolator.isSettled(0)).toBe(true);
});

test("uniform motion is shown as uniform motion with a delay", () => {
  const interpolator = moving(11);
  for (let now = 390; now <= 430; now += 8) {
    expect(xAt(interpolator, now)).toBeCloseTo((now - interpolator.delayMs) / 1000, 9);
  }
});

test("the delay is longer than an update interval", () => {
  expect(moving(11).delayMs).toBeCloseTo(64, 9);
});

test("early and late arrivals are smoothed", () => {
  const interpolator = moving(30, (i) => (i % 2 === 0 ? 8 : -8));
  const start = 29 * INTERVAL_MS - 20;
  let previous = xAt(interpolator, start);
  for (let now = start + 10; now < start + 50; now += 10) {
    const x = xAt(interpolator, now);
    const speed = (x - previous) / 0.01;
    expect(speed).toBeGreaterThan(0.7);
    expect(speed).toBeLessThan(1.4);
    previous = x;
  }
});

test("the displayed pose ends at the last update and stays there", () => {
  const interpolator = moving(5);
  expect(interpolator.isSettled(4 * INTERVAL_MS)).toBe(false);
  expect(interpolator.isSettled(1000)).toBe(true);
  expect(xAt(interpolator, 1000)).toBeCloseTo(0.16, 12);
});

test("a single step after a long pause is animated", () => {
  const interpolator = moving(5);
  interpolator.push(update(5, poseAt(1.16)), 60_000);
  const middle = xAt(interpolator, 60_000 + interpolator.delayMs - INTERVAL_MS / 2);
  expect(middle).toBeCloseTo(0.66, 6);
});

test("old poses are removed after a reset", () => {
  const interpolator = moving(10);
  interpolator.push(update(0, poseAt(-3)), 500);
  expect(xAt(interpolator, 500)).toBe(-3);
  expect(interpolator.at(0.09)).toBeNull();
});

test("rotations use the shorter arc and keep unit length", () => {
  const interpolator = new PoseInterpolator();
  interpolator.push(update(0, poseAt(0, 3.1)), 0);
  const negated = poseAt(0, 3.1 + 0.1).map((value, i) => (i >= 3 ? -value : value));
  interpolator.push(update(1, negated), INTERVAL_MS);
  const out = new Float64Array(7);
  interpolator.read(INTERVAL_MS / 2 + interpolator.delayMs, out);
  expect(Math.hypot(out[3]!, out[4]!, out[5]!, out[6]!)).toBeCloseTo(1, 12);
  const yaw = 2 * Math.atan2(out[5]!, out[6]!);
  expect(yaw).toBeCloseTo(3.15, 6);
});

test("the poses of a recent instant are available", () => {
  expect(moving(10).at(0.07)?.[0]).toBeCloseTo(0.28, 12);
  expect(moving(100).at(0.01)).toBeNull();
});

test("the poses at a simulated time lie between two updates, and the newest one of equal times counts", () => {
  const interpolator = new PoseInterpolator();
  const out = new Float64Array(7);
  expect(interpolator.readAt(1, out)).toBe(false);
  interpolator.push(update(100, poseAt(1)), 0);
  interpolator.push(update(200, poseAt(3)), 40);
  interpolator.push(update(200, poseAt(5)), 80); // the user has edited the simulation while it is paused
  const at = (stamp: number) => (interpolator.readAt(stamp, out), out[0]);
  expect(at(1.5)).toBeCloseTo(2, 12);
  expect(at(1)).toBe(1);
  expect(at(0.5)).toBe(1);
  expect(at(2)).toBe(5);
  expect(at(9)).toBe(5);
});
