// Names above the robots, as text of the page and not of the image, so that they are sharp and
// accessible to screen readers. They never overlap: the selected robot's name has priority, then
// those of robots in trouble (worst first), then the nearest.
import type { Camera } from "three";
import { Matrix4, Vector3 } from "three";

const MOST_LABELS = 40;
const TEXT_PX = 11.5; // as style/panels.css has it
const HEIGHT_PX = 20;
const PADDING_PX = 14; // of both sides, with what keeps two names apart
const CHARACTER_PX = 7; // where the browser does not tell a text's width

export interface LabelledRobots {
  names: readonly string[];
  tops: Float64Array; // x y z of each, in the world
  badness(robot: number): number; // 0: all is well
  isShown(robot: number): boolean;
  selection: string | null;
}

interface Box {
  left: number;
  right: number;
  bottom: number;
}

interface Candidate extends Box {
  robot: number;
  x: number;
}

// A priority is one number, so that thousands are sorted fast: the rank (the lowest comes first), the
// distance in centimetres, and the number of the robot.
const ROBOTS_IN_KEY = 2 ** 20;
const DISTANCES_IN_KEY = 2 ** 24;
const BEST_RANK = 100; // of a selected robot; the worst robots follow
const CENTIMETRES = 100;

export class LabelLayer {
  readonly element = document.createElement("div");
  private readonly labels = new Map<string, HTMLElement>();
  private readonly widths = new Map<string, number>();
  private readonly measure = measureText();
  private readonly clipFromWorld = new Matrix4();
  private readonly eye = new Vector3();
  private keys: Float64Array = new Float64Array(0); // of the robots in the image, by priority
  private across: Float64Array = new Float64Array(0); // the place of each robot in the image, in CSS pixels
  private down: Float64Array = new Float64Array(0);

  constructor(private readonly onPick: (name: string) => void) {
    this.element.className = "labels";
  }

  place(camera: Camera, width: number, height: number, robots: LabelledRobots): void {
    const shown = this.chosen(camera, width, height, robots);
    const names = new Set(shown.map(({ robot }) => robots.names[robot]!));
    for (const [name, label] of [...this.labels]) {
      if (names.has(name)) continue;
      label.remove();
      this.labels.delete(name);
    }
    for (const { robot, x, bottom } of shown) {
      const name = robots.names[robot]!;
      const label = this.labelOf(name);
      label.style.transform = `translate(${x.toFixed(1)}px, ${bottom.toFixed(1)}px) translate(-50%, -100%)`;
      label.classList.toggle("selected", name === robots.selection);
      label.classList.toggle("trouble", robots.badness(robot) > 0);
    }
  }

  // Draws the labels at their present places on an image of the view, whose width on the page is
  // `width`.
  paint(context: CanvasRenderingContext2D, width: number): void {
    const scale = context.canvas.width / width;
    context.save();
    context.scale(scale, scale);
    context.font = getComputedStyle(this.element).font.replace(/\d+(\.\d+)?px/, `${TEXT_PX}px`);
    context.textBaseline = "middle";
    const frame = this.element.getBoundingClientRect();
    for (const label of this.labels.values()) {
      const box = label.getBoundingClientRect();
      const [x, y] = [box.left - frame.left, box.top - frame.top];
      context.fillStyle = getComputedStyle(label).backgroundColor;
      context.beginPath();
      context.roundRect(x, y, box.width, box.height, 5);
      context.fill();
      context.fillStyle = getComputedStyle(label).color;
      context.fillText(label.textContent ?? "", x + 6, y + box.height / 2);
    }
    context.restore();
  }

  // The labels that have room, at most MOST_LABELS.
  private chosen(camera: Camera, width: number, height: number, robots: LabelledRobots): Candidate[] {
    const taken: Candidate[] = [];
    const found = this.findInImage(camera, width, height, robots);
    for (let i = 0; i < found && taken.length < MOST_LABELS; i++) {
      const robot = this.keys[i]! % ROBOTS_IN_KEY;
      const half = this.widthOf(robots.names[robot]!) / 2;
      const x = this.across[robot]!;
      const each = { robot, x, left: x - half, right: x + half, bottom: this.down[robot]! };
      if (!taken.some((other) => overlap(each, other))) taken.push(each);
    }
    return taken;
  }

  // Finds the robots in front of the camera and inside the image. Returns their number, and leaves their
  // places in `across` and `down` and their order in `keys`.
  private findInImage(camera: Camera, width: number, height: number, robots: LabelledRobots): number {
    const { names, tops, selection } = robots;
    if (this.keys.length < names.length) {
      [this.keys, this.across, this.down] = [0, 1, 2].map(() => new Float64Array(names.length)) as [Float64Array, Float64Array, Float64Array];
    }
    const { keys, across, down } = this;
    const m = this.clipFromWorld.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements;
    const eye = this.eye.setFromMatrixPosition(camera.matrixWorld);
    let found = 0;
    for (let robot = 0, at = 0; robot < names.length; robot++, at += 3) {
      const x = tops[at]!;
      const y = tops[at + 1]!;
      const z = tops[at + 2]!;
      const w = m[3]! * x + m[7]! * y + m[11]! * z + m[15]!;
      if (w <= 0) continue;
      const right = (m[0]! * x + m[4]! * y + m[8]! * z + m[12]!) / w;
      const up = (m[1]! * x + m[5]! * y + m[9]! * z + m[13]!) / w;
      if (Math.abs(right) > 1 || Math.abs(up) > 1 || !robots.isShown(robot)) continue;
      across[robot] = ((right + 1) / 2) * width;
      down[robot] = ((1 - up) / 2) * height;
      const rank = BEST_RANK - (names[robot] === selection ? BEST_RANK : robots.badness(robot));
      const distance = Math.sqrt((x - eye.x) ** 2 + (y - eye.y) ** 2 + (z - eye.z) ** 2);
      const centimetres = Math.min(DISTANCES_IN_KEY - 1, Math.floor(CENTIMETRES * distance));
      keys[found++] = (rank * DISTANCES_IN_KEY + centimetres) * ROBOTS_IN_KEY + robot;
    }
    keys.subarray(0, found).sort();
    return found;
  }

  private widthOf(name: string): number {
    let width = this.widths.get(name);
    if (width === undefined) this.widths.set(name, (width = this.measure(name) + PADDING_PX));
    return width;
  }

  private labelOf(name: string): HTMLElement {
    let label = this.labels.get(name);
    if (!label) {
      label = document.createElement("span");
      label.className = "label";
      label.textContent = name;
      label.addEventListener("click", () => this.onPick(name));
      this.labels.set(name, label);
      this.element.append(label);
    }
    return label;
  }
}

function overlap(a: Box, b: Box): boolean {
  return a.left < b.right && b.left < a.right && Math.abs(a.bottom - b.bottom) < HEIGHT_PX;
}

// Measuring the labels on the page would cause a layout for each.
function measureText(): (text: string) => number {
  let context: CanvasRenderingContext2D | null = null;
  return (text) => {
    context ??= document.createElement("canvas").getContext("2d");
    if (!context) return CHARACTER_PX * text.length;
    context.font = `${TEXT_PX}px system-ui, sans-serif`;
    return context.measureText(text).width;
  };
}
