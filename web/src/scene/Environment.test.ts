import { Color, Vector3 } from "three";
import { expect, test } from "vitest";
import { meanOf, radianceOf } from "./Environment";
import { scene } from "./testScene";

function look(more: object) {
  return { ...scene().look, ...more };
}

test.each([true, false])("a white surface is as bright as the ambient light, and 55 % of it from below (sky: %s)", (sky) => {
  const radiance = radianceOf(look({ ambient: [0.5, 0.4, 0.3], background: [0.2, 0.6, 0.4], sky }));
  [0.5, 0.4, 0.3].forEach((value, k) => {
    expect(meanOf(radiance).toArray()[k]).toBeCloseTo(value, 2);
    expect(meanOf(radiance, -1).toArray()[k]).toBeCloseTo(0.55 * value, 6);
  });
});

test("windows are brighter than the sky beside them, and black worlds are lit too", () => {
  const radiance = radianceOf(look({ ambient: [0, 0, 0] }));
  const at = (degrees: number) => {
    const angle = (degrees * Math.PI) / 180;
    return radiance(new Vector3(0.8 * Math.cos(angle), 0.8 * Math.sin(angle), 0.6), new Color()).g;
  };
  // There are five windows, 72° apart. The centre of the first one is at 18°. At 54° is the sky
  // between two windows.
  expect(at(18) / at(54)).toBeCloseTo(3, 2);
  expect(at(54)).toBeGreaterThan(0.15);
});
