// Of a crowd that is far away each part is drawn as a box, and small parts are not drawn: a thousand
// robots of a few pixels need no thousands of triangles each, which without a graphics card take seconds.
import type { BufferGeometry, Matrix4, Mesh, PerspectiveCamera } from "three";
import { BoxGeometry, Vector3 } from "three";

const SMALLEST_CROWD = 50;
// Pixels of the page that the nearest of a crowd measures across; between the two it stays as it is.
const COARSE_BELOW = 12;
const FINE_ABOVE = 16;
// Of the largest part; at the pixels above such a part is two or three pixels wide.
const SMALL_SHARE = 0.4;

interface Part {
  mesh: Mesh;
  fine: BufferGeometry;
  coarse: BufferGeometry;
  isSmall: boolean;
}

interface Crowd {
  parts: Part[];
  radius: number; // of one of them, m
  places: readonly Matrix4[]; // world_from_body, as shown now
  isCoarse: boolean;
}

export class CrowdDetail {
  private readonly crowds: Crowd[] = [];

  // Meshes, each so many metres large, that together show bodies of one model, which stand at `places`;
  // few are left as they are.
  add(meshes: readonly { mesh: Mesh; size: number }[], radius: number, places: readonly Matrix4[]): void {
    if (places.length < SMALLEST_CROWD || !(radius > 0)) return;
    const largest = Math.max(...meshes.map(({ size }) => size));
    const parts = meshes.map(({ mesh, size }) => ({
      mesh,
      fine: mesh.geometry,
      coarse: boxAround(mesh.geometry),
      isSmall: size < SMALL_SHARE * largest,
    }));
    this.crowds.push({ parts, radius, places, isCoarse: false });
  }

  // For a picture so many pixels high.
  choose(camera: PerspectiveCamera, height: number): void {
    const focal = height / 2 / Math.tan((camera.fov * Math.PI) / 360);
    for (const crowd of this.crowds) {
      const across = (2 * crowd.radius * focal) / nearest(camera, crowd.places);
      const isCoarse = crowd.isCoarse ? across < FINE_ABOVE : across < COARSE_BELOW;
      if (isCoarse === crowd.isCoarse) continue;
      crowd.isCoarse = isCoarse;
      for (const { mesh, fine, coarse, isSmall } of crowd.parts) {
        mesh.geometry = isCoarse ? coarse : fine;
        mesh.visible = !isCoarse || !isSmall;
      }
    }
  }

  dispose(): void {
    for (const { parts } of this.crowds) {
      for (const { coarse } of parts) coarse.dispose();
    }
  }
}

function boxAround(geometry: BufferGeometry): BufferGeometry {
  geometry.computeBoundingBox();
  const bounds = geometry.boundingBox!;
  const size = bounds.getSize(new Vector3());
  const middle = bounds.getCenter(new Vector3());
  return new BoxGeometry(size.x, size.y, size.z).translate(middle.x, middle.y, middle.z);
}

const place = new Vector3();

function nearest(camera: PerspectiveCamera, places: readonly Matrix4[]): number {
  let least = Infinity;
  for (const each of places) least = Math.min(least, place.setFromMatrixPosition(each).distanceTo(camera.position));
  return least;
}
