// Draws a grid in metres on the floor, and a ring around the selected body.
import { Box3, BufferGeometry, Color, Float32BufferAttribute, LineBasicMaterial, LineSegments } from "three";
import { Mesh, MeshBasicMaterial, RingGeometry, Vector3 } from "three";

// m: height of the grid over the world's floor, so that the grid is not inside of the floor
const HIGHEST_FLOOR = 0.004;
const MOST_CELLS = 200;
const RING_COLOUR = new Color(0x2f81f7);

// Makes lines on the floor of the box. Their distance is one metre (ten metres in a large world).
export function makeGrid(box: Box3): LineSegments {
  const size = box.getSize(new Vector3());
  const cell = Math.max(size.x, size.y) > MOST_CELLS ? 10 : 1;
  const clamp = (value: number) => Math.max(-MOST_CELLS * cell, Math.min(MOST_CELLS * cell, value));
  const [x0, x1] = [Math.floor(clamp(box.min.x) / cell) - 1, Math.ceil(clamp(box.max.x) / cell) + 1];
  const [y0, y1] = [Math.floor(clamp(box.min.y) / cell) - 1, Math.ceil(clamp(box.max.y) / cell) + 1];
  const points: number[] = [];
  for (let x = x0; x <= x1; x++) points.push(x * cell, y0 * cell, 0, x * cell, y1 * cell, 0);
  for (let y = y0; y <= y1; y++) points.push(x0 * cell, y * cell, 0, x1 * cell, y * cell, 0);
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
  const material = new LineBasicMaterial({
    color: 0x1b2733,
    transparent: true,
    opacity: 0.16,
    depthWrite: false,
    toneMapped: false,
  });
  const grid = new LineSegments(geometry, material);
  grid.position.z = HIGHEST_FLOOR;
  grid.raycast = () => {};
  return grid;
}

export function disposeGrid(grid: LineSegments): void {
  grid.geometry.dispose();
  (grid.material as LineBasicMaterial).dispose();
  grid.removeFromParent();
}

// A ring on the floor around a robot.
export class SelectionRing {
  readonly mesh = new Mesh(
    new RingGeometry(1, 1.1, 64),
    new MeshBasicMaterial({
      color: RING_COLOUR,
      transparent: true,
      opacity: 0.9,
      depthWrite: false,
      toneMapped: false,
    }),
  );

  constructor() {
    this.mesh.visible = false;
    this.mesh.renderOrder = 1;
    this.mesh.raycast = () => {};
  }

  // Shows the ring around `position`, the robot's origin on the floor. `radius` is in metres.
  place(position: Vector3, radius: number): void {
    this.mesh.visible = true;
    this.mesh.position.set(position.x, position.y, position.z + 2 * HIGHEST_FLOOR);
    this.mesh.scale.set(radius, radius, 1);
  }

  hide(): void {
    this.mesh.visible = false;
  }
}
