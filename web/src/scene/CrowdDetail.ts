// Draws the parts of a distant crowd as boxes and omits small parts: a thousand robots of a few
// pixels need no thousands of triangles each, which take seconds without a graphics card.
import type { InstancedMesh, Material, Matrix4, Mesh, PerspectiveCamera } from "three";
import { Group, Vector3 } from "three";
import { BoxCrowd } from "./BoxCrowd";

const SMALLEST_CROWD = 50;
// The size in pixels of the nearest robot of a crowd. Between the two limits, the level of detail
// does not change.
const COARSE_BELOW = 12;
const FINE_ABOVE = 16;
// The smallest fraction of the largest part. At the pixels above, such a part is two or three
// pixels wide.
const SMALL_SHARE = 0.4;

export interface CrowdMesh {
  mesh: Mesh;
  size: number; // from corner to corner, m
}

interface Crowd {
  meshes: Mesh[];
  boxes: { boxes: BoxCrowd; mesh: InstancedMesh }[]; // of the large parts
  radius: number; // of one of them, m
  places: readonly Matrix4[]; // world_from_body, as shown now
  isCoarse: boolean;
  isStale: boolean; // the boxes stand where the bodies stood
}

export class CrowdDetail {
  readonly group = new Group();
  private readonly crowds: Crowd[] = [];

  // The meshes that show all bodies of one model at `places`. A small number of bodies is left
  // unchanged.
  add(meshes: readonly CrowdMesh[], radius: number, places: readonly Matrix4[]): void {
    if (places.length < SMALLEST_CROWD || !(radius > 0)) return;
    const largest = Math.max(...meshes.map(({ size }) => size));
    const large = meshes.filter(({ size }) => size >= SMALL_SHARE * largest);
    const boxes = large.map(({ mesh }) => ({ mesh: mesh as InstancedMesh, boxes: boxesFor(mesh, places.length) }));
    this.crowds.push({ meshes: meshes.map(({ mesh }) => mesh), boxes, radius, places, isCoarse: false, isStale: true });
  }

  // Call this when the bodies have moved.
  moved(): void {
    for (const crowd of this.crowds) crowd.isStale = true;
  }

  // For a view with this height in pixels.
  choose(camera: PerspectiveCamera, height: number): void {
    const focal = height / 2 / Math.tan((camera.fov * Math.PI) / 360);
    for (const crowd of this.crowds) {
      const across = (2 * crowd.radius * focal) / nearest(camera, crowd.places);
      this.show(crowd, crowd.isCoarse ? across < FINE_ABOVE : across < COARSE_BELOW);
      if (!crowd.isCoarse || !crowd.isStale) continue;
      for (const { boxes, mesh } of crowd.boxes) boxes.place(mesh.instanceMatrix.array);
      crowd.isStale = false;
    }
  }

  dispose(): void {
    for (const { boxes } of this.crowds) for (const each of boxes) each.boxes.dispose();
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

function boxesFor(mesh: Mesh, count: number): BoxCrowd {
  mesh.geometry.computeBoundingBox();
  const boxes = new BoxCrowd(mesh.geometry.boundingBox!, mesh.material as Material, count);
  boxes.mesh.castShadow = mesh.castShadow;
  boxes.mesh.receiveShadow = mesh.receiveShadow;
  return boxes;
}

const place = new Vector3();

function nearest(camera: PerspectiveCamera, places: readonly Matrix4[]): number {
  let least = Infinity;
  for (const each of places) least = Math.min(least, place.setFromMatrixPosition(each).distanceTo(camera.position));
  return least;
}
