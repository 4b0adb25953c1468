// A small scene for tests.
import type { SceneBody, SceneDescription } from "../api/scene";

export const HERE = [0, 0, 0, 0, 0, 0, 1];

export function body(name: string, more: Partial<SceneBody> = {}): SceneBody {
  return {
    name,
    model: "cart-1",
    isStatic: false,
    isFixed: more.isStatic === true,
    isRobot: true,
    isOfWorld: false,
    isAvatar: false,
    isStation: false,
    hasDrive: true,
    pose: HERE,
    links: ["chassis", "wheel"],
    sensors: [],
    collisions: null,
    joints: [],
    ...more,
  };
}

export function scene(more: Partial<SceneDescription> = {}): SceneDescription {
  return {
    layoutVersion: 1,
    name: "test",
    bounds: { min: [-5, -5, 0], max: [5, 5, 2] },
    look: { ambient: [0.4, 0.4, 0.4], background: [0.7, 0.7, 0.7], shadows: true, sky: false },
    lights: [],
    bodies: [],
    poses: [],
    ...more,
  };
}
