// Names above the robots. They are text of the page and not of the image, so that they are sharp
// and accessible to screen readers. They never overlap. The selected robot's name has the highest
// priority. Then follow the names of robots in trouble (worst first), and then of the nearest
// robots.
import type { Camera } from "three";
import { Matrix4, Vector3 } from "three";

const MOST_LABELS = 40;
const TEXT_PX = 11.5; // as in style/panels.css
const HEIGHT_PX = 20;
const PADDING_PX = 14; // padding on both sides, with the gap between two names
// While robots move and the camera is at rest, the robots with labels are chosen again after this
// time. If they were chosen in every frame, labels would change all the time.
const CHOICE_MS = 200;
const CHARACTER_PX = 7; // used if the browser does not return the width of a text

// The robots that may get a label, and their priorities.
export interface LabelledRobots {
  names: readonly string[];
  tops: Float64Array; // x y z of each label's anchor, in the world
  badness(robot: number): number; // 0: no problem
  isShown(robot: number): boolean;
  selection: string | null;
  isMoving: boolean; // more frames follow
}

interface Box {
  left: number;
  right: number;
  bottom: number;
}

interface ShownLabel {
  robot: number;
  x: number;
  bottom: number;
}

type Candidate = Box & ShownLabel;

// The inputs of the present choice, except the positions of the robots.
interface Choice {
  madeMs: number;
  names: readonly string[];
  selection: string | null;
  clipFromWorld: Matrix4;
  robots: number[];
}

// A label of the page, with a copy of its content. To compare the copy takes less time than to
// write the label.
interface Label {
  element: HTMLElement;
  frame: number; // the frame in which it was last shown
  x: number; // tenths of a pixel
  bottom: number;
  kind: string; // its CSS classes
}

// Priorities are numbers, so that thousands of them are sorted fast. The robot with the lowest
// number gets a label first. A number combines, in this order, the rank (0 if the robot is
// selected, else BEST_RANK minus its badness), the distance in centimetres, and the robot's index.
const ROBOTS_IN_KEY = 2 ** 20;
const DISTANCES_IN_KEY = 2 ** 24;
const BEST_RANK = 100; // more than the badness of any robot
const CENTIMETRES = 100;

export class LabelLayer {
  readonly element = document.createElement("div");
  private readonly labels = new Map<string, Label>();
  private frame = 0;
  private choice: Choice | null = null;
  private readonly widths = new Map<string, number>();
  private readonly measure = measureText();
  private readonly clipFromWorld = new Matrix4();
  private readonly eye = new Vector3();
  private keys: Float64Array = new Float64Array(0); // priorities of the robots in the image
  private across: Float64Array = new Float64Array(0); // the place of each robot in the image, in CSS pixels
  private down: Float64Array = new Float64Array(0);

  constructor(private readonly onPick: (name: string) => void) {
    this.element.className = "labels";
  }

  place(camera: Camera, width: number, height: number, robots: LabelledRobots): void {
    const { names, selection } = robots;
    this.frame += 1;
    for (const { robot, x, bottom } of this.shown(camera, width, height, robots)) {
      const name = names[robot]!;
      const label = this.labelOf(name);
      label.frame = this.frame;
      move(label, Math.round(10 * x), Math.round(10 * bottom));
      const kind = `label${name === selection ? " selected" : ""}${robots.badness(robot) > 0 ? " trouble" : ""}`;
      if (kind !== label.kind) label.element.className = label.kind = kind;
    }
    for (const [name, { element, frame }] of this.labels) {
      if (frame === this.frame) continue;
      element.remove();
      this.labels.delete(name);
    }
  }

  // Draws the labels at their present places on an image of the view. `width` is the width of the
  // image on the page.
  paint(context: CanvasRenderingContext2D, width: number): void {
    const scale = context.canvas.width / width;
    context.save();
    context.scale(scale, scale);
    context.font = getComputedStyle(this.element).font.replace(/\d+(\.\d+)?px/, `${TEXT_PX}px`);
    context.textBaseline = "middle";
    const frame = this.element.getBoundingClientRect();
    for (const { element: label } of this.labels.values()) {
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

  // Call this when the results of `badness` or `isShown` may have changed.
  renew(): void {
    this.choice = null;
  }

  // Returns the labels to show. If only the robots have moved, the labels are not chosen again for
  // a short time.
  private shown(camera: Camera, width: number, height: number, robots: LabelledRobots): ShownLabel[] {
    this.clipFromWorld.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    const now = performance.now();
    if (this.choice && robots.isMoving && this.isRecent(this.choice, robots, now)) return this.moved(this.choice, width, height, robots.tops);
    const chosen = this.chosen(camera, width, height, robots);
    const { names, selection } = robots;
    this.choice = { madeMs: now, names, selection, clipFromWorld: this.clipFromWorld.clone(), robots: chosen.map(({ robot }) => robot) };
    return chosen;
  }

  private isRecent({ madeMs, names, selection, clipFromWorld }: Choice, robots: LabelledRobots, now: number): boolean {
    const isSame = names === robots.names && selection === robots.selection && clipFromWorld.equals(this.clipFromWorld);
    return isSame && now - madeMs < CHOICE_MS;
  }

  // Returns the chosen robots that are still in the image, at their present places.
  private moved({ robots }: Choice, width: number, height: number, tops: Float64Array): ShownLabel[] {
    return robots.flatMap((robot) => (this.project(tops, robot, width, height) ? [{ robot, x: this.across[robot]!, bottom: this.down[robot]! }] : []));
  }

  // Returns the labels that do not overlap, at most MOST_LABELS.
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

  // Finds the robots in front of the camera and inside the image. Returns the number of these
  // robots. Writes their places to `across` and `down`, and their order to `keys`.
  private findInImage(camera: Camera, width: number, height: number, robots: LabelledRobots): number {
    const { names, tops, selection } = robots;
    if (this.keys.length < names.length) {
      [this.keys, this.across, this.down] = [0, 1, 2].map(() => new Float64Array(names.length)) as [Float64Array, Float64Array, Float64Array];
    }
    const { keys } = this;
    const eye = this.eye.setFromMatrixPosition(camera.matrixWorld);
    let found = 0;
    for (let robot = 0; robot < names.length; robot++) {
      if (!this.project(tops, robot, width, height) || !robots.isShown(robot)) continue;
      const rank = BEST_RANK - (names[robot] === selection ? BEST_RANK : robots.badness(robot));
      const at = 3 * robot;
      const distance = Math.sqrt((tops[at]! - eye.x) ** 2 + (tops[at + 1]! - eye.y) ** 2 + (tops[at + 2]! - eye.z) ** 2);
      const centimetres = Math.min(DISTANCES_IN_KEY - 1, Math.floor(CENTIMETRES * distance));
      keys[found++] = (rank * DISTANCES_IN_KEY + centimetres) * ROBOTS_IN_KEY + robot;
    }
    keys.subarray(0, found).sort();
    return found;
  }

  // Finds the place of a robot in the image. Returns true if the robot is in front of the camera
  // and inside the image.
  private project(tops: Float64Array, robot: number, width: number, height: number): boolean {
    const m = this.clipFromWorld.elements;
    const x = tops[3 * robot]!;
    const y = tops[3 * robot + 1]!;
    const z = tops[3 * robot + 2]!;
    const w = m[3]! * x + m[7]! * y + m[11]! * z + m[15]!;
    if (w <= 0) return false;
    const right = (m[0]! * x + m[4]! * y + m[8]! * z + m[12]!) / w;
    const up = (m[1]! * x + m[5]! * y + m[9]! * z + m[13]!) / w;
    this.across[robot] = ((right + 1) / 2) * width;
    this.down[robot] = ((1 - up) / 2) * height;
    return Math.abs(right) <= 1 && Math.abs(up) <= 1;
  }

  private widthOf(name: string): number {
    let width = this.widths.get(name);
    if (width === undefined) this.widths.set(name, (width = this.measure(name) + PADDING_PX));
    return width;
  }

  private labelOf(name: string): Label {
    let label = this.labels.get(name);
    if (!label) {
      const element = document.createElement("span");
      element.className = "label";
      element.textContent = name;
      element.addEventListener("click", () => this.onPick(name));
      label = { element, frame: 0, x: NaN, bottom: NaN, kind: "label" };
      this.labels.set(name, label);
      this.element.append(element);
    }
    return label;
  }
}

// Moves a label to a place in tenths of a pixel.
function move(label: Label, x: number, bottom: number): void {
  if (x === label.x && bottom === label.bottom) return;
  label.x = x;
  label.bottom = bottom;
  label.element.style.transform = `translate(${(x / 10).toFixed(1)}px, ${(bottom / 10).toFixed(1)}px) translate(-50%, -100%)`;
}

function overlap(a: Box, b: Box): boolean {
  return a.left < b.right && b.left < a.right && Math.abs(a.bottom - b.bottom) < HEIGHT_PX;
}

// Returns a function that measures texts. To measure the labels on the page would cause one layout
// per label.
function measureText(): (text: string) => number {
  let context: CanvasRenderingContext2D | null = null;
  return (text) => {
    context ??= document.createElement("canvas").getContext("2d");
    if (!context) return CHARACTER_PX * text.length;
    context.font = `${TEXT_PX}px system-ui, sans-serif`;
    return context.measureText(text).width;
  };
}
