import { expect, test } from "vitest";
import { glowOf, jawsOf, soundOf } from "./devices";

const LAMP = {
  brightness: 0.5,
  color: { r: 1, g: 0.5, b: 0, a: 1 },
  radius_m: 0.02,
  range_m: 3,
  angle_rad: 6.2832,
  intensity: 2,
};
const SPEAKER = { sound: "tone", frequency_hz: 440, volume: 0.5, elapsed_s: 0.1, left_s: 1, loudness_db: 85 };

test("the state of a lamp that is on has its glow", () => {
  expect(glowOf(LAMP)).toEqual({
    brightness: 0.5,
    colour: [1, 0.5, 0],
    radius: 0.02,
    range: 3,
    angle: 6.2832,
    intensity: 2,
  });
});

test("a lamp that is off, and other messages, do not glow", () => {
  expect(glowOf({ ...LAMP, brightness: 0 })).toBeNull();
  expect(glowOf({ ...LAMP, color: null })).toBeNull();
  expect(glowOf({ ...LAMP, range_m: NaN })).toBeNull();
  for (const message of [null, undefined, 7, {}, SPEAKER]) expect(glowOf(message)).toBeNull();
});

test("a speaker's state has its sound, and nothing while it is silent", () => {
  expect(soundOf(SPEAKER)).toEqual({ name: "tone", frequency: 440, volume: 0.5, elapsed: 0.1 });
  expect(soundOf({ ...SPEAKER, sound: "" })).toBeNull();
  for (const message of [null, undefined, 7, {}, LAMP]) expect(soundOf(message)).toBeNull();
});

test("a gripper's state has its opening and the held body", () => {
  const gripper = { opening_m: 0.06, told_to_open: false, held: "can", reach_m: 0.09, height_m: 0.04 };
  expect(jawsOf(gripper)).toEqual({ opening: 0.06, reach: 0.09, height: 0.04, held: "can" });
  for (const message of [null, 7, {}, LAMP, SPEAKER, { ...gripper, reach_m: Infinity }]) {
    expect(jawsOf(message)).toBeNull();
  }
});
