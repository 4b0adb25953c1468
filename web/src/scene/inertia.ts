// The box of uniform density that has the same mass and inertia as a link.
import { Matrix4 } from "three";
import type { SceneInertial } from "../api/scene";

export interface EquivalentBox {
  frameFromBox: Matrix4; // a rotation about the centre of mass, in the frame of the inertia
  // m; if no real body can have this inertia, one of the numbers is 0
  half: readonly [number, number, number];
}

const SWEEPS = 12; // Jacobi's method converges quadratically: a 3 x 3 matrix needs about five

export function equivalentBox({ mass, inertia }: Pick<SceneInertial, "mass" | "inertia">): EquivalentBox {
  const [xx, yy, zz, xy, xz, yz] = inertia;
  const { values, vectors } = principalAxes([
    [xx, xy, xz],
    [xy, yy, yz],
    [xz, yz, zz],
  ]);
  // A box with sides a, b, c has the moment m (b² + c²) / 12 about the axis of a, so that
  // a² = 6 (I_b + I_c - I_a) / m.
  const [a, b, c] = values as [number, number, number];
  const side = (squared: number) => Math.sqrt(Math.max(0, (6 * squared) / mass)) / 2;
  const v = vectors;
  const frameFromBox = new Matrix4().set(
    v[0]![0]!, v[0]![1]!, v[0]![2]!, 0,
    v[1]![0]!, v[1]![1]!, v[1]![2]!, 0,
    v[2]![0]!, v[2]![1]!, v[2]![2]!, 0,
    0, 0, 0, 1,
  );
  return { frameFromBox, half: [side(b + c - a), side(a + c - b), side(a + b - c)] };
}

// The eigenvalues and eigenvectors (columns) of a symmetric matrix, by Jacobi's rotations.
function principalAxes(matrix: number[][]): { values: number[]; vectors: number[][] } {
  const m = matrix;
  const vectors = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  for (let sweep = 0; sweep < SWEEPS; sweep++) {
    for (const [p, q] of [[0, 1], [0, 2], [1, 2]] as const) {
      const off = m[p]![q]!;
      if (off === 0) continue;
      const theta = (m[q]![q]! - m[p]![p]!) / (2 * off);
      const t = (theta >= 0 ? 1 : -1) / (Math.abs(theta) + Math.hypot(theta, 1));
      const c = 1 / Math.hypot(t, 1);
      const s = t * c;
      rotateColumns(m, p, q, c, s);
      rotateRows(m, p, q, c, s);
      rotateColumns(vectors, p, q, c, s);
    }
  }
  return { values: [m[0]![0]!, m[1]![1]!, m[2]![2]!], vectors };
}

function rotateColumns(m: number[][], p: number, q: number, c: number, s: number): void {
  for (const row of m) [row[p], row[q]] = [c * row[p]! - s * row[q]!, s * row[p]! + c * row[q]!];
}

function rotateRows(m: number[][], p: number, q: number, c: number, s: number): void {
  const [first, second] = [m[p]!, m[q]!];
  m[p] = first.map((value, i) => c * value - s * second[i]!);
  m[q] = first.map((value, i) => s * value + c * second[i]!);
}
