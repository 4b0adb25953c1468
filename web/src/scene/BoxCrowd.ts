// Draws many boxes in one draw call, with vertices computed by the processor: without a graphics
// card, each instance would cost a draw call of about 20 µs. The graphics derive the normals of the
// flat faces, so a box has only eight vertices.
import type { Box3, Material } from "three";
import { BoxGeometry, BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh } from "three";

const CORNERS = 8; // bit k of a corner's number: whether it is at the far end of axis k
const FACES = trianglesOfABox();

export class BoxCrowd {
  readonly mesh: Mesh;
  private readonly positions: Float32Array;
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
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(this.positions, 3).setUsage(DynamicDrawUsage));
    // Shadows are displaced along it.
    geometry.setAttribute("normal", new BufferAttribute(repeated([0, 0, 1], CORNERS * count, 0), 3));
    geometry.setAttribute("uv", new BufferAttribute(repeated([0, 0, 1, 0, 0, 1, 1, 1, 0, 0, 1, 0, 0, 1, 1, 1], count, 0), 2));
    geometry.setIndex(new BufferAttribute(Uint32Array.from(repeated(FACES, count, CORNERS)), 1));
    this.mesh = new Mesh(geometry, flat(material));
    this.mesh.frustumCulled = false;
    this.mesh.raycast = () => {};
  }

  // `matrices`: world_from_box of each box, sixteen numbers, column by column.
  place(matrices: ArrayLike<number>): void {
    const [mx, my, mz] = this.middle as [number, number, number];
    const [hx, hy, hz] = this.half as [number, number, number];
    const { positions } = this;
    for (let box = 0; box < this.count; box++) {
      const m = 16 * box;
      for (let row = 0; row < 3; row++) {
        const a = matrices[m + row]!;
        const b = matrices[m + 4 + row]!;
        const c = matrices[m + 8 + row]!;
        const middle = a * mx + b * my + c * mz + matrices[m + 12 + row]!;
        const x = 2 * a * hx;
        const y = 2 * b * hy;
        const z = 2 * c * hz;
        const at = 3 * CORNERS * box + row;
        const first = middle - (x + y + z) / 2;
        positions[at] = first;
        positions[at + 3] = first + x;
        positions[at + 6] = first + y;
        positions[at + 9] = first + x + y;
        positions[at + 12] = first + z;
        positions[at + 15] = first + x + z;
        positions[at + 18] = first + y + z;
        positions[at + 21] = first + x + y + z;
      }
    }
    this.mesh.geometry.getAttribute("position").needsUpdate = true;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    (this.mesh.material as Material).dispose();
    this.mesh.removeFromParent();
  }
}

// The triangles of a box, as numbers of its corners.
function trianglesOfABox(): number[] {
  const box = new BoxGeometry(2, 2, 2);
  const corners = box.getAttribute("position");
  const cornerOf = (vertex: number) =>
    [0, 1, 2].reduce((bits, k) => bits | (corners.getComponent(vertex, k) > 0 ? 1 << k : 0), 0);
  return Array.from(box.index!.array, cornerOf);
}

// A copy of the material whose normals follow from the faces.
function flat(material: Material): Material {
  const copy = material.clone();
  if ("flatShading" in copy) copy.flatShading = true;
  return copy;
}

// Repeats the numbers, each time increased by `more`.
function repeated(numbers: ArrayLike<number>, count: number, more: number): Float32Array {
  const all = new Float32Array(numbers.length * count);
  for (let i = 0; i < all.length; i++) {
    all[i] = numbers[i % numbers.length]! + more * Math.floor(i / numbers.length);
  }
  return all;
}
