// Draws many boxes in one draw call, with vertices computed by the processor: without a graphics
// card, each instance would cost a draw call of about 20 µs.
import type { Box3, Material } from "three";
import { BoxGeometry, BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh } from "three";

const CORNERS = 24; // of a box, one for each face that meets there
const UNIT = new BoxGeometry(2, 2, 2);

// For each corner: its side along x, y and z (bits 0 to 2), and twice the axis of its face's
// normal, plus 1 if the normal points in the positive direction.
const SIDES = Uint8Array.from({ length: CORNERS }, (_, corner) =>
  [0, 1, 2].reduce((bits, k) => bits | (UNIT.getAttribute("position").getComponent(corner, k) > 0 ? 1 << k : 0), 0),
);
const FACES = Uint8Array.from({ length: CORNERS }, (_, corner) => {
  const along = [0, 1, 2].map((k) => UNIT.getAttribute("normal").getComponent(corner, k));
  const axis = along.findIndex((value) => Math.abs(value) > 0.5);
  return 2 * axis + (along[axis]! > 0 ? 1 : 0);
});

export class BoxCrowd {
  readonly mesh: Mesh;
  private readonly positions: Float32Array;
  private readonly normals: Float32Array;
  private readonly middle: readonly number[];
  private readonly half: readonly number[];

  // The number of boxes, their size, and the centre of a box in its own frame.
  constructor(
    box: Box3,
    material: Material,
    private readonly count: number,
  ) {
    this.middle = [0, 1, 2].map((k) => (box.min.getComponent(k) + box.max.getComponent(k)) / 2);
    this.half = [0, 1, 2].map((k) => (box.max.getComponent(k) - box.min.getComponent(k)) / 2);
    this.positions = new Float32Array(3 * CORNERS * count);
    this.normals = new Float32Array(3 * CORNERS * count);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(this.positions, 3).setUsage(DynamicDrawUsage));
    geometry.setAttribute("normal", new BufferAttribute(this.normals, 3).setUsage(DynamicDrawUsage));
    geometry.setAttribute("uv", new BufferAttribute(repeated(UNIT.getAttribute("uv").array, count, 0), 2));
    geometry.setIndex(new BufferAttribute(Uint32Array.from(repeated(UNIT.index!.array, count, CORNERS)), 1));
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.raycast = () => {};
  }

  // `matrices`: world_from_box of each box, sixteen numbers, column by column.
  place(matrices: ArrayLike<number>): void {
    const [mx, my, mz] = this.middle as [number, number, number];
    const [hx, hy, hz] = this.half as [number, number, number];
    const { positions, normals } = this;
    for (let box = 0; box < this.count; box++) {
      const m = 16 * box;
      const from = 3 * CORNERS * box;
      for (let row = 0; row < 3; row++) {
        const [a, b, c] = [matrices[m + row]!, matrices[m + 4 + row]!, matrices[m + 8 + row]!];
        const middle = a * mx + b * my + c * mz + matrices[m + 12 + row]!;
        const [x, y, z] = [a * hx, b * hy, c * hz];
        for (let corner = 0, at = from + row; corner < CORNERS; corner++, at += 3) {
          const sides = SIDES[corner]!;
          positions[at] =
            middle + ((sides & 1) === 0 ? -x : x) + ((sides & 2) === 0 ? -y : y) + ((sides & 4) === 0 ? -z : z);
          const face = FACES[corner]!;
          const along = face >> 1 === 0 ? a : face >> 1 === 1 ? b : c;
          normals[at] = (face & 1) === 0 ? -along : along;
        }
      }
    }
    for (const name of ["position", "normal"]) this.mesh.geometry.getAttribute(name).needsUpdate = true;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.removeFromParent();
  }
}

// Repeats the numbers, each time increased by `more`.
function repeated(numbers: ArrayLike<number>, count: number, more: number): Float32Array {
  const all = new Float32Array(numbers.length * count);
  for (let i = 0; i < all.length; i++) {
    all[i] = numbers[i % numbers.length]! + more * Math.floor(i / numbers.length);
  }
  return all;
}
