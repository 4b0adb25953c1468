import { Matrix4, PointLight, SpotLight } from "three";
import { expect, test } from "vitest";
import { DeviceLayer, RING_LINES } from "./DeviceLayer";
import { LineLayer } from "./LineLayer";

const LAMP = {
  brightness: 1,
  color: { r: 1, g: 0, b: 0, a: 1 },
  radius_m: 0.05,
  range_m: 3,
  angle_rad: 6.2832,
  intensity: 2,
};
const SOUND = { sound: "tone", frequency_hz: 440, volume: 1, elapsed_s: 0.1 };

function placed(layer: DeviceLayer): LineLayer {
  const lines = new LineLayer({});
  lines.begin();
  layer.place(() => new Matrix4().makeTranslation(1, 2, 3), lines);
  return lines;
}

function lightsOf(layer: DeviceLayer, kind: typeof PointLight | typeof SpotLight) {
  return layer.group.children.filter((each) => each instanceof kind) as (PointLight | SpotLight)[];
}

test("a lamp glows in its colour at its place, and goes out", () => {
  const layer = new DeviceLayer();
  layer.take("/a/lamp", LAMP);
  placed(layer);
  const ball = layer.group.children[0]!;
  expect(ball.visible).toBe(true);
  expect(ball.position.toArray()).toEqual([1, 2, 3]);
  expect(ball.scale.x).toBe(0.05);
  layer.take("/a/lamp", { ...LAMP, brightness: 0 });
  placed(layer);
  expect(ball.visible).toBe(false);
});

test("a lamp with a range lights in all directions, with an angle only a cone, and an LED nothing", () => {
  const layer = new DeviceLayer();
  layer.take("/a/led", { ...LAMP, range_m: 0 });
  placed(layer);
  expect(lightsOf(layer, PointLight)).toHaveLength(0);
  layer.take("/a/lamp", LAMP);
  layer.take("/a/head", { ...LAMP, angle_rad: 1 });
  placed(layer);
  const [bulb] = lightsOf(layer, PointLight);
  expect(bulb!.distance).toBe(3);
  expect(bulb!.intensity).toBeCloseTo(2 * Math.PI, 9);
  const [head] = lightsOf(layer, SpotLight) as SpotLight[];
  expect(head!.angle).toBeCloseTo(0.5, 9);
  expect(head!.target.position.toArray()).toEqual([2, 2, 3]);
});

test("a few of many lamps light their surroundings, and their number does not decrease", () => {
  const layer = new DeviceLayer();
  for (let i = 0; i < 9; i++) layer.take(`/a/lamp_${i}`, LAMP);
  placed(layer);
  expect(lightsOf(layer, PointLight)).toHaveLength(4);
  layer.keepOnly(new Set());
  placed(layer);
  expect(lightsOf(layer, PointLight).map(({ intensity }) => intensity)).toEqual([0, 0, 0, 0]);
});

test("a speaker emits rings while it plays", () => {
  const layer = new DeviceLayer();
  layer.take("/a/speaker", SOUND);
  expect(placed(layer).segments).toBe(RING_LINES);
  layer.take("/a/speaker", { ...SOUND, sound: "" });
  expect(placed(layer).segments).toBe(0);
});

test("a gripper shows its jaws at their positions, in another colour if it holds something", () => {
  const layer = new DeviceLayer();
  const gripper = { opening_m: 0.06, told_to_open: false, held: "", reach_m: 0.09, height_m: 0.04 };
  const colours = [gripper, { ...gripper, held: "can" }].map((message) => {
    layer.take("/a/gripper", message);
    const lines = placed(layer);
    expect(lines.segments).toBe(8);
    const geometry = lines.lines.geometry;
    const starts = geometry.getAttribute("instanceStart");
    expect(starts.getY(0)).toBeCloseTo(2.03, 6);
    expect(starts.getY(4)).toBeCloseTo(1.97, 6);
    return geometry.getAttribute("instanceColorStart").getX(0);
  });
  expect(colours[0]).not.toBe(colours[1]);
});
