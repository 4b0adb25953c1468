// Draws the robots of a second recording as transparent ghosts in the scene of the first recording.
import { Group, MeshBasicMaterial } from "three";
import type { SceneDescription } from "../api/scene";
import { BodyLayer } from "./BodyLayer";
import type { ModelLibrary } from "./ModelLibrary";
import type { ModelTemplate } from "./ModelTemplate";

const NUMBERS_A_POSE = 7;

export class GhostLayer {
  readonly group = new Group();
  // One material for all ghosts. They need only be visible, and look different from the robots.
  private readonly material = new MeshBasicMaterial({
    color: 0x8b5cf6,
    transparent: true,
    opacity: 0.6,
    depthWrite: false,
  });
  private shown: { bodies: BodyLayer; entries: readonly number[]; layoutVersion: number } | null = null;

  // Shows the robots of a scene; null: shows no robots. Calls `onChange` when the view must be
  // drawn again.
  setScene(scene: SceneDescription | null, library: ModelLibrary, onChange: () => void): void {
    this.shown?.bodies.dispose();
    this.shown = null;
    if (!scene) return;
    const { ghosts, entries } = ghostsOf(scene);
    const bodies = new BodyLayer(ghosts);
    this.shown = { bodies, entries, layoutVersion: scene.layoutVersion };
    this.group.add(bodies.group);
    const models = new Map(ghosts.bodies.map(({ model, links }) => [model, links] as const));
    for (const [model, links] of models) {
      library.get(model, links).then(
        (template) => {
          if (this.shown?.bodies !== bodies) return;
          bodies.addModel(model, this.ghostOf(template));
          onChange();
        },
        () => {}, // a ghost without a shape is not drawn, but its curves can be compared
      );
    }
  }

  // Takes the poses of the second recording: 7 numbers per pose, in the order of its scene's list
  // of poses. Poses of another layout are ignored.
  setPoses(layoutVersion: number, poses: Float64Array): void {
    if (!this.shown || this.shown.layoutVersion !== layoutVersion) return;
    const { bodies, entries } = this.shown;
    const numbers = new Float64Array(NUMBERS_A_POSE * entries.length);
    for (const [i, entry] of entries.entries()) {
      const from = NUMBERS_A_POSE * entry;
      if (from + NUMBERS_A_POSE > poses.length) return;
      numbers.set(poses.subarray(from, from + NUMBERS_A_POSE), NUMBERS_A_POSE * i);
    }
    bodies.setPoses(numbers);
  }

  // Returns the displayed position of a ghost, x, y, z in the world; null if there is no ghost.
  placeOf(robot: string): [number, number, number] | null {
    const pose = this.shown?.bodies.poseOf(this.shown.bodies.indexOf(robot));
    return pose ? (pose.elements.slice(12, 15) as [number, number, number]) : null;
  }

  private ghostOf(template: ModelTemplate): ModelTemplate {
    return { ...template, parts: template.parts.map((part) => ({ ...part, material: this.material })) };
  }
}

// Returns the scene with only its robots, and the indices of their poses in the list of the whole
// scene.
export function ghostsOf(scene: SceneDescription): { ghosts: SceneDescription; entries: number[] } {
  const robots = scene.bodies.flatMap(({ isRobot, isAvatar }, index) => (isRobot || isAvatar ? [index] : []));
  const places = new Map(robots.map((body, place) => [body, place]));
  const entries = scene.poses.flatMap(({ body }, entry) => (places.has(body) ? [entry] : []));
  const poses = entries.map((entry) => {
    const { body, link } = scene.poses[entry]!;
    return { body: places.get(body)!, link };
  });
  return { ghosts: { ...scene, bodies: robots.map((index) => scene.bodies[index]!), poses }, entries };
}
