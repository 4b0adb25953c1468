// Draws the places of expectations: goals and limits as circles and boxes on the floor, coloured by
// verdict.
import { Matrix4 } from "three";
import type { Expectation, Verdict } from "../state/expectations";
import type { Rgb } from "./LineLayer";
import { LineLayer, rgb } from "./LineLayer";

const ABOVE_FLOOR = 0.03; // m
const FARTHEST = 500; // m: extent of a box that is open to one side
const CORNERS = 48; // number of corners of a circle
const COLOURS: Record<Verdict, Rgb> = {
  pending: rgb(0x1f6feb),
  holds: rgb(0x2da44e),
  violated: rgb(0xd1242f),
};
const WORLD = new Matrix4();

export class ExpectationMarks {
  private readonly drawn: LineLayer;

  constructor(thin = false) {
    this.drawn = new LineLayer({ widthPx: 2.5, thin });
    this.lines.visible = false;
  }

  get lines(): LineLayer["lines"] {
    return this.drawn.lines;
  }

  get segments(): number {
    return this.drawn.segments;
  }

  set(expectations: readonly Expectation[]): void {
    this.drawn.begin();
    for (const { verdict, places, boxes } of expectations) {
      for (const place of places) this.circle(place, COLOURS[verdict]);
      for (const box of boxes) this.box(box, COLOURS[verdict]);
    }
    this.drawn.finish();
    this.lines.visible = this.drawn.segments > 0;
  }

  private circle([x, y, radius]: Expectation["places"][number], colour: Rgb): void {
    const corner = (i: number) => {
      const angle = (2 * Math.PI * i) / CORNERS;
      return [x + radius * Math.cos(angle), y + radius * Math.sin(angle), ABOVE_FLOOR];
    };
    for (let i = 0; i < CORNERS; i++) this.drawn.add(WORLD, corner(i), corner(i + 1), colour);
  }

  private box(limits: Expectation["boxes"][number], colour: Rgb): void {
    const [x0, x1, y0, y1] = limits.map((limit) => Math.min(FARTHEST, Math.max(-FARTHEST, limit))) as [number, number, number, number];
    const corners = [
      [x0, y0],
      [x1, y0],
      [x1, y1],
      [x0, y1],
    ].map((corner) => [...corner, ABOVE_FLOOR]);
    corners.forEach((corner, i) => this.drawn.add(WORLD, corner, corners[(i + 1) % 4]!, colour));
  }
}
