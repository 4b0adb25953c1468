// Coloured lines that are written anew for each picture: axes, camera views, contacts, trails.
import type { Matrix4 } from "three";
import { Color, Vector3 } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import type { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { segmentsGeometry, uploadSegments } from "./segments";

const SMALLEST_CAPACITY = 256; // segments
const NUMBERS_PER_SEGMENT = 6;

export type Rgb = readonly [number, number, number];

// A colour as it is written in style sheets, in the numbers that three.js draws with.
export function rgb(hex: number): Rgb {
  return new Color(hex).toArray() as [number, number, number];
}

export class LineLayer {
  readonly lines: LineSegments2;
  private positions = new Float32Array(0);
  private colours = new Float32Array(0);
  private used = 0; // numbers
  private readonly point = new Vector3();

  // Lines on top of everything can be seen through walls.
  constructor({ widthPx = 2, onTop = false }) {
    const material = new LineMaterial({
      linewidth: widthPx,
      vertexColors: true,
      depthTest: !onTop,
      toneMapped: false,
    });
    this.lines = new LineSegments2(segmentsGeometry(this.positions, this.colours), material);
    this.lines.frustumCulled = false;
    this.lines.raycast = () => {};
    if (onTop) this.lines.renderOrder = 2;
    this.allot(SMALLEST_CAPACITY);
  }

  get segments(): number {
    return this.used / NUMBERS_PER_SEGMENT;
  }

  begin(): void {
    this.used = 0;
  }

  // A line between two points of a frame; x y z each.
  add(worldFromFrame: Matrix4, from: readonly number[], to: readonly number[], colour: Rgb): void {
    this.makeRoom();
    for (const end of [from, to]) {
      this.point.fromArray(end).applyMatrix4(worldFromFrame).toArray(this.positions, this.used);
      this.colours.set(colour, this.used);
      this.used += 3;
    }
  }

  // A line in the world between the points that begin at `from` and `to` in a list of numbers.
  addInWorld(points: Float32Array, from: number, to: number, colour: Rgb): void {
    this.makeRoom();
    for (const at of [from, to]) {
      for (let k = 0; k < 3; k++) this.positions[this.used + k] = points[at + k]!;
      this.colours.set(colour, this.used);
      this.used += 3;
    }
  }

  finish(): void {
    uploadSegments(this.lines.geometry as LineSegmentsGeometry, this.segments);
  }

  private makeRoom(): void {
    if (this.used + NUMBERS_PER_SEGMENT <= this.positions.length) return;
    const { positions, colours } = this;
    this.allot((2 * positions.length) / NUMBERS_PER_SEGMENT);
    this.positions.set(positions);
    this.colours.set(colours);
  }

  private allot(segments: number): void {
    this.positions = new Float32Array(NUMBERS_PER_SEGMENT * segments);
    this.colours = new Float32Array(NUMBERS_PER_SEGMENT * segments);
    this.lines.geometry.dispose();
    this.lines.geometry = segmentsGeometry(this.positions, this.colours);
  }
}
