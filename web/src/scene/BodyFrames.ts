// The displayed poses of a scene's bodies, and of the links that move relative to their bodies.
// They are in one list of numbers, with seven numbers for each frame (x y z qx qy qz qw, metres).
// The frames of the scene's `poses` are first, in their order. The frames of the other bodies
// follow. All instances are drawn from this list.
import type { Vector3 } from "three";
import { Matrix4, Quaternion, Vector3 as Vector } from "three";
import type { PoseNumbers, SceneDescription } from "../api/scene";

export const POSE_NUMBERS = 7;
export const MATRIX_NUMBERS = 16;

export class BodyFrames {
  readonly numbers: Float64Array;
  private readonly ofBodies: Int32Array; // the frame of each body
  private readonly ofLinks: readonly ReadonlyMap<string, number>[]; // the moving links of each body

  constructor({ bodies, poses }: SceneDescription) {
    this.ofBodies = new Int32Array(bodies.length).fill(-1);
    const ofLinks = bodies.map(() => new Map<string, number>());
    const bodiesOfFrames = poses.map(({ body }) => body);
    poses.forEach(({ body, link }, frame) => {
      if (link === null) this.ofBodies[body] = frame;
      else ofLinks[body]!.set(link, frame);
    });
    this.ofLinks = ofLinks;
    bodies.forEach((_, body) => {
      if (this.ofBodies[body]! < 0) this.ofBodies[body] = bodiesOfFrames.push(body) - 1;
    });
    this.numbers = new Float64Array(POSE_NUMBERS * bodiesOfFrames.length);
    bodiesOfFrames.forEach((body, frame) => this.numbers.set(bodies[body]!.pose, POSE_NUMBERS * frame));
  }

  frameOf(body: number): number {
    return this.ofBodies[body]!;
  }

  // The links of a body that move relative to the body, and their frames.
  linksOf(body: number): ReadonlyMap<string, number> {
    return this.ofLinks[body]!;
  }

  // Returns the displayed pose of a frame: world_from_frame.
  matrixOf(frame: number, out = new Matrix4()): Matrix4 {
    return readMatrix(this.numbers, POSE_NUMBERS * frame, out);
  }

  positionOf(frame: number, out: Vector3): Vector3 {
    return out.fromArray(this.numbers, POSE_NUMBERS * frame);
  }

  setMatrix(frame: number, worldFromFrame: Matrix4): void {
    worldFromFrame.decompose(position, rotation, scale);
    position.toArray(this.numbers, POSE_NUMBERS * frame);
    rotation.toArray(this.numbers, POSE_NUMBERS * frame + 3);
  }

  // Writes world_from_frame as sixteen numbers, column by column. Matrix4.compose does the same.
  // But it takes several times as long for a crowd, because it uses an object for each number.
  writeMatrix(frame: number, out: Float32Array, at: number): void {
    const { numbers } = this;
    const from = POSE_NUMBERS * frame;
    const x = numbers[from + 3]!;
    const y = numbers[from + 4]!;
    const z = numbers[from + 5]!;
    const w = numbers[from + 6]!;
    out[at] = 1 - 2 * (y * y + z * z);
    out[at + 1] = 2 * (x * y + w * z);
    out[at + 2] = 2 * (x * z - w * y);
    out[at + 3] = 0;
    out[at + 4] = 2 * (x * y - w * z);
    out[at + 5] = 1 - 2 * (x * x + z * z);
    out[at + 6] = 2 * (y * z + w * x);
    out[at + 7] = 0;
    out[at + 8] = 2 * (x * z + w * y);
    out[at + 9] = 2 * (y * z - w * x);
    out[at + 10] = 1 - 2 * (x * x + y * y);
    out[at + 11] = 0;
    out[at + 12] = numbers[from]!;
    out[at + 13] = numbers[from + 1]!;
    out[at + 14] = numbers[from + 2]!;
    out[at + 15] = 1;
  }
}

const position = new Vector();
const rotation = new Quaternion();
const scale = new Vector();
const UNIT_SCALE = new Vector(1, 1, 1);

function readMatrix(numbers: ArrayLike<number>, at: number, out: Matrix4): Matrix4 {
  position.set(numbers[at]!, numbers[at + 1]!, numbers[at + 2]!);
  rotation.set(numbers[at + 3]!, numbers[at + 4]!, numbers[at + 5]!, numbers[at + 6]!);
  return out.compose(position, rotation, UNIT_SCALE);
}

export function matrixOf(pose: PoseNumbers | Float64Array, at = 0): Matrix4 {
  return readMatrix(pose, at, new Matrix4());
}
