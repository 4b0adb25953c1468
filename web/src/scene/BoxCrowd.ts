// Many boxes in one draw call, which are placed by the processor: as instances each would cost a draw
// call of its own where no graphics card draws, some 20 µs.
import type { Box3, Material } from "three";
import { BoxGeometry, BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh } from "three";

const CORNERS = 24; // of a box, one for each face that meets there
const UNIT = new BoxGeometry(2, 2, 2);

export class BoxCrowd {
  readonly mesh: Mesh;
  private readonly positions: Float32Array;
  private readonly normals: Float32Array;
  private readonly middle: readonly number[];
  private readonly half: readonly number[];

  // So many boxes of this size, and where it lies in each one's own frame.
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

  // `matrices`: world_from_box of each, sixteen numbers, column by column.
  place(matrices: ArrayLike<number>): void {
    const corners = UNIT.getAttribute("position").array;
    const directions = UNIT.getAttribute("normal").array;
    const [mx, my, mz] = this.middle as [number, number, number];
    const [hx, hy, hz] = this.half as [number, number, number];
    const { positions, normals } = this;
    for (let box = 0, at = 0; box < this.count; box++) {
      const m = 16 * box;
      for (let k = 0; k < 3 * CORNERS; k += 3, at += 3) {
        const x = mx + hx * corners[k]!;
        const y = my + hy * corners[k + 1]!;
        const z = mz + hz * corners[k + 2]!;
        for (let row = 0; row < 3; row++) {
          const a = matrices[m + row]!;
          const b = matrices[m + 4 + row]!;
          const c = matrices[m + 8 + row]!;
          positions[at + row] = a * x + b * y + c * z + matrices[m + 12 + row]!;
          normals[at + row] = a * directions[k]! + b * directions[k + 1]! + c * directions[k + 2]!;
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

// The numbers over and over, each time `more` larger.
function repeated(numbers: ArrayLike<number>, count: number, more: number): Float32Array {
  const all = new Float32Array(numbers.length * count);
  for (let i = 0; i < all.length; i++) {
    all[i] = numbers[i % numbers.length]! + more * Math.floor(i / numbers.length);
  }
  return all;
}
