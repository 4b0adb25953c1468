// Draws the parts of a distant crowd as boxes, and omits small parts. A thousand robots of a few
// pixels do not need thousands of triangles each. Without a graphics card, these would take
// seconds.
import type { Mesh, PerspectiveCamera } from "three";
import { Group, Vector3 } from "three";
import type { FramedPart } from "./bakedParts";
import type { BodyFrames } from "./BodyFrames";
import { POSE_NUMBERS } from "./BodyFrames";
import { BoxCrowd } from "./BoxCrowd";
import type { ModelInstances, Rig } from "./ModelInstances";
import { boundsOf } from "./ModelTemplate";

const SMALLEST_CROWD = 50;
// If the nearest robot of a crowd is smaller than COARSE_BELOW pixels in the image, the crowd is
// drawn as boxes. If this robot is larger than FINE_ABOVE pixels, the crowd is drawn with its
// shapes. Between the two limits, nothing changes.
const COARSE_BELOW = 12;
const FINE_ABOVE = 16;
// Parts smaller than this fraction of the largest part have no box. When the crowd is at the limits
// above, such a part is two or three pixels wide.
const SMALL_SHARE = 0.4;

interface Crowd {
  meshes: readonly Mesh[];
  boxes: { boxes: BoxCrowd; rig: Rig }[]; // boxes that replace the large parts
  radius: number; // radius of one body, m
  frames: Int32Array; // the frames of the bodies
  isCoarse: boolean;
  isStale: boolean; // whether the bodies have moved since the boxes were placed
}

export class CrowdDetail {
  readonly group = new Group();
  private readonly crowds: Crowd[] = [];

  constructor(private readonly frames: BodyFrames) {}

  // Adds bodies of one model with this radius in metres. Fewer than SMALLEST_CROWD bodies are
  // always drawn with their shapes.
  add({ meshes, rigs, bodies }: ModelInstances, radius: number): void {
    if (bodies.length < SMALLEST_CROWD || !(radius > 0)) return;
    const parts = rigs.flatMap((rig) => rig.parts.map((framed) => ({ rig, framed, size: sizeOf(framed) })));
    const largest = Math.max(...parts.map(({ size }) => size));
    const large = parts.filter(({ size }) => size >= SMALL_SHARE * largest);
    const boxes = large.map(({ rig, framed }) => ({ rig, boxes: boxesFor(framed, bodies.length) }));
    const frames = Int32Array.from(bodies, (body) => this.frames.frameOf(body));
    this.crowds.push({ meshes, boxes, radius, frames, isCoarse: false, isStale: true });
  }

  // Call this when the bodies have moved.
  moved(): void {
    for (const crowd of this.crowds) crowd.isStale = true;
  }

  // Chooses the level of detail for a view with this height in pixels.
  choose(camera: PerspectiveCamera, height: number): void {
    const focal = height / 2 / Math.tan((camera.fov * Math.PI) / 360);
    for (const crowd of this.crowds) {
      const across = (2 * crowd.radius * focal) / this.nearest(camera, crowd.frames);
      this.show(crowd, crowd.isCoarse ? across < FINE_ABOVE : across < COARSE_BELOW);
      if (!crowd.isCoarse || !crowd.isStale) continue;
      for (const { boxes, rig } of crowd.boxes) boxes.place(rig.matrices.array);
      crowd.isStale = false;
    }
  }

  dispose(): void {
    for (const { boxes } of this.crowds) for (const each of boxes) each.boxes.dispose();
  }

  // Returns the distance from the camera to the nearest body.
  private nearest(camera: PerspectiveCamera, frames: Int32Array): number {
    const { numbers } = this.frames;
    const { x, y, z } = camera.position;
    let least = Infinity;
    for (let i = 0; i < frames.length; i++) {
      const at = POSE_NUMBERS * frames[i]!;
      const squared = (numbers[at]! - x) ** 2 + (numbers[at + 1]! - y) ** 2 + (numbers[at + 2]! - z) ** 2;
      if (squared < least) least = squared;
    }
    return Math.sqrt(least);
  }

  private show(crowd: Crowd, isCoarse: boolean): void {
    if (isCoarse === crowd.isCoarse) return;
    crowd.isCoarse = isCoarse;
    for (const mesh of crowd.meshes) mesh.visible = !isCoarse;
    for (const { boxes } of crowd.boxes) {
      if (isCoarse) this.group.add(boxes.mesh);
      else boxes.mesh.removeFromParent();
    }
  }
}

// Returns the length of the part's diagonal, m.
function sizeOf({ part }: FramedPart): number {
  return boundsOf(part).getSize(new Vector3()).length();
}

function boxesFor({ part, frameFromPart }: FramedPart, count: number): BoxCrowd {
  boundsOf(part); // so that the bounds of the geometry are computed
  const boxes = new BoxCrowd(part.geometry.boundingBox!, frameFromPart, part.material, count);
  boxes.mesh.castShadow = boxes.mesh.receiveShadow = !part.material.transparent;
  return boxes;
}
