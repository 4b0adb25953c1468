// Draws many boxes in one draw call. The processor computes their vertices, because without a
// graphics card each instance would be a draw call of about 20 µs. The graphics compute the normals
// from the flat faces, so a box has only eight vertices.
import type { Box3, Material, Matrix4 } from "three";
import { BoxGeometry, BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh, Vector3 } from "three";

const CORNERS = 8; // bit k of a corner's index is 1 if the corner is at the far end of axis k
const FACES = trianglesOfABox();

export class BoxCrowd {
  readonly mesh: Mesh;
  private readonly positions: Float32Array;
  // The box's corner with the smallest coordinates, in the body's frame.
  private readonly corner: Vector3;
  // The three edges of the box that start at `corner`, in the body's frame.
  private readonly edges: readonly [Vector3, Vector3, Vector3];

  // `count` is the number of boxes, one for each body. `box` is in the frame of a part of the body.
  // `frameFromPart` is the pose of the part in the body's frame.
  constructor(
    box: Box3,
    frameFromPart: Matrix4,
    material: Material,
    private readonly count: number,
  ) {
    const corner = (x: number, y: number, z: number) => new Vector3(x, y, z).applyMatrix4(frameFromPart);
    const { min, max } = box;
    this.corner = corner(min.x, min.y, min.z);
    this.edges = [
      corner(max.x, min.y, min.z).sub(this.corner),
      corner(min.x, max.y, min.z).sub(this.corner),
      corner(min.x, min.y, max.z).sub(this.corner),
    ];
    this.positions = new Float32Array(3 * CORNERS * count);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(this.positions, 3).setUsage(DynamicDrawUsage));
    // The normals do not affect the shading. three.js needs them for the offset of shadows.
    geometry.setAttribute("normal", new BufferAttribute(repeated([0, 0, 1], CORNERS * count, 0), 3));
    geometry.setAttribute("uv", new BufferAttribute(repeated([0, 0, 1, 0, 0, 1, 1, 1, 0, 0, 1, 0, 0, 1, 1, 1], count, 0), 2));
    geometry.setIndex(new BufferAttribute(Uint32Array.from(repeated(FACES, count, CORNERS)), 1));
    this.mesh = new Mesh(geometry, flat(material));
    this.mesh.frustumCulled = false;
    this.mesh.raycast = () => {};
  }

  // `matrices`: world_from_frame of each body, sixteen numbers, column by column.
  place(matrices: ArrayLike<number>): void {
    const { corner, positions } = this;
    const [i, j, k] = this.edges;
    for (let box = 0; box < this.count; box++) {
      const m = 16 * box;
      for (let row = 0; row < 3; row++) {
        const a = matrices[m + row]!;
        const b = matrices[m + 4 + row]!;
        const c = matrices[m + 8 + row]!;
        const first = a * corner.x + b * corner.y + c * corner.z + matrices[m + 12 + row]!;
        const x = a * i.x + b * i.y + c * i.z;
        const y = a * j.x + b * j.y + c * j.z;
        const z = a * k.x + b * k.y + c * k.z;
        const at = 3 * CORNERS * box + row;
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

// Returns a copy of the material with flat shading: one normal for each face.
function flat(material: Material): Material {
  const copy = material.clone();
  if ("flatShading" in copy) copy.flatShading = true;
  return copy;
}

// Repeats the numbers. In each repetition, they are larger by `more` than in the previous one.
function repeated(numbers: ArrayLike<number>, count: number, more: number): Float32Array {
  const all = new Float32Array(numbers.length * count);
  for (let i = 0; i < all.length; i++) {
    all[i] = numbers[i % numbers.length]! + more * Math.floor(i / numbers.length);
  }
  return all;
}
