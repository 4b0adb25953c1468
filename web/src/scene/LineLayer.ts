// Draws coloured lines that are rewritten for each frame: axes, camera views, contacts, trails.
import type { Matrix4 } from "three";
import { Color, Vector3 } from "three";
import { Segments } from "./Segments";

const SMALLEST_CAPACITY = 256; // segments
const NUMBERS_PER_SEGMENT = 6;

export type Rgb = readonly [number, number, number];

// Converts a colour of a style sheet to the numbers that three.js draws with.
export function rgb(hex: number): Rgb {
  return new Color(hex).toArray() as [number, number, number];
}

export class LineLayer {
  private readonly drawn: Segments;
  private used = 0; // numbers
  private readonly point = new Vector3();

  // Lines on top are visible through walls.
  constructor({ widthPx = 2, onTop = false, thin = false }) {
    this.drawn = new Segments({ widthPx, thin, depthTest: !onTop });
    if (onTop) this.lines.renderOrder = 2;
    this.drawn.allot(SMALLEST_CAPACITY);
  }

  get lines(): Segments["lines"] {
    return this.drawn.lines;
  }

  get segments(): number {
    return this.used / NUMBERS_PER_SEGMENT;
  }

  begin(): void {
    this.used = 0;
  }

  // Adds a line between two points of a frame, x y z each.
  add(worldFromFrame: Matrix4, from: readonly number[], to: readonly number[], colour: Rgb): void {
    this.makeRoom();
    for (const end of [from, to]) {
      this.point.fromArray(end).applyMatrix4(worldFromFrame).toArray(this.drawn.positions, this.used);
      this.drawn.colours.set(colour, this.used);
      this.used += 3;
    }
  }

  // Adds a line between two points in the world, which begin at the indices `from` and `to` of a
  // list of numbers.
  addInWorld(points: Float32Array, from: number, to: number, colour: Rgb): void {
    this.makeRoom();
    for (const at of [from, to]) {
      for (let k = 0; k < 3; k++) this.drawn.positions[this.used + k] = points[at + k]!;
      this.drawn.colours.set(colour, this.used);
      this.used += 3;
    }
  }

  finish(): void {
    this.drawn.upload(this.segments);
  }

  private makeRoom(): void {
    const { positions, colours } = this.drawn;
    if (this.used + NUMBERS_PER_SEGMENT <= positions.length) return;
    this.drawn.allot((2 * positions.length) / NUMBERS_PER_SEGMENT);
    this.drawn.positions.set(positions);
    this.drawn.colours.set(colours);
  }
}
