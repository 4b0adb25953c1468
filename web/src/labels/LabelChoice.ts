// Chooses the robots whose names are shown. Names never overlap when they are chosen. The selected
// robot's name has the highest priority. Then follow the names of robots in trouble (worst first),
// and then of the nearest robots. Places and sizes are in CSS pixels of the view.
import { LABEL_HEIGHT } from "./LabelPainter";

export const MAX_LABELS = 500;
const ROW = LABEL_HEIGHT + 2; // height of a label, with the gap to the next one
const GAP = 2; // between labels beside each other
// While robots move and the camera is at rest, the robots with labels are chosen again after this
// time. If they were chosen in every frame, labels would change all the time.
const CHOICE_MS = 200;

// The robots that may get a label, and their priorities.
export interface LabelledRobots {
  names: readonly string[];
  tops: Float64Array; // x y z of each label's anchor, in the world
  badness(robot: number): number; // 0: no problem
  isShown(robot: number): boolean;
  selection: string | null;
  isMoving: boolean; // more frames follow
}

export interface LabelView {
  clipFromWorld: readonly number[]; // by columns
  eye: { x: number; y: number; z: number };
  width: number;
  height: number;
}

interface Box {
  left: number;
  right: number;
  bottom: number;
}

// The inputs of the present choice, except the positions of the robots.
interface Inputs {
  madeMs: number;
  names: readonly string[];
  selection: string | null;
  clipFromWorld: readonly number[];
  width: number;
  height: number;
}

// Priorities are numbers, so that thousands of them are sorted fast. The robot with the lowest
// number gets a label first. A number combines, in this order, the rank (0 if the robot is
// selected, else BEST_RANK minus its badness), the distance in centimetres, and the robot's index.
const ROBOTS_IN_KEY = 2 ** 20;
const DISTANCES_IN_KEY = 2 ** 24;
const BEST_RANK = 100; // more than the badness of any robot
const CENTIMETRES = 100;

export class LabelChoice {
  // The place of each robot's label in the view: the middle of its lower edge. Valid for the robots
  // that choose() has returned.
  across: Float64Array = new Float64Array(0);
  down: Float64Array = new Float64Array(0);
  private keys: Float64Array = new Float64Array(0); // priorities of the robots in the view
  private chosen: number[] = [];
  private inputs: Inputs | null = null;

  // `widthOf` returns the width of a robot's label.
  constructor(private readonly widthOf: (name: string) => number) {}

  // Call this when the results of `badness`, `isShown` or `widthOf` may have changed.
  renew(): void {
    this.inputs = null;
  }

  // Returns the robots whose labels are shown, in the order of their priorities. If only the robots
  // have moved, they are not chosen again for a short time.
  choose(view: LabelView, robots: LabelledRobots): readonly number[] {
    const now = performance.now();
    if (this.inputs && robots.isMoving && isRecent(this.inputs, view, robots, now)) {
      return this.chosen.filter((robot) => this.project(view, robots.tops, robot));
    }
    this.chooseAgain(view, robots);
    const { names, selection } = robots;
    const { width, height } = view;
    this.inputs = { madeMs: now, names, selection, clipFromWorld: [...view.clipFromWorld], width, height };
    return this.chosen;
  }

  private chooseAgain(view: LabelView, robots: LabelledRobots): void {
    const taken = new Boxes(view.height);
    this.chosen = [];
    const found = this.findInView(view, robots);
    for (let i = 0; i < found && this.chosen.length < MAX_LABELS; i++) {
      const robot = this.keys[i]! % ROBOTS_IN_KEY;
      const half = (this.widthOf(robots.names[robot]!) + GAP) / 2;
      const x = this.across[robot]!;
      if (taken.add({ left: x - half, right: x + half, bottom: this.down[robot]! })) this.chosen.push(robot);
    }
  }

  // Finds the robots in front of the camera and inside the view. Returns the number of these robots.
  // Writes their places to `across` and `down`, and their order to `keys`.
  private findInView(view: LabelView, robots: LabelledRobots): number {
    const { names, tops, selection } = robots;
    if (this.keys.length < names.length) {
      [this.keys, this.across, this.down] = [0, 1, 2].map(() => new Float64Array(names.length)) as [Float64Array, Float64Array, Float64Array];
    }
    const { keys } = this;
    const { eye } = view;
    let found = 0;
    for (let robot = 0; robot < names.length; robot++) {
      if (!this.project(view, tops, robot) || !robots.isShown(robot)) continue;
      const rank = BEST_RANK - (names[robot] === selection ? BEST_RANK : robots.badness(robot));
      const at = 3 * robot;
      const distance = Math.sqrt((tops[at]! - eye.x) ** 2 + (tops[at + 1]! - eye.y) ** 2 + (tops[at + 2]! - eye.z) ** 2);
      const centimetres = Math.min(DISTANCES_IN_KEY - 1, Math.floor(CENTIMETRES * distance));
      keys[found++] = (rank * DISTANCES_IN_KEY + centimetres) * ROBOTS_IN_KEY + robot;
    }
    keys.subarray(0, found).sort();
    return found;
  }

  // Finds the place of a robot in the view. Returns true if the robot is in front of the camera and
  // inside the view.
  private project({ clipFromWorld: m, width, height }: LabelView, tops: Float64Array, robot: number): boolean {
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
}

function isRecent(inputs: Inputs, view: LabelView, robots: LabelledRobots, now: number): boolean {
  const isSame = inputs.names === robots.names && inputs.selection === robots.selection && inputs.width === view.width && inputs.height === view.height;
  return isSame && now - inputs.madeMs < CHOICE_MS && inputs.clipFromWorld.every((value, i) => value === view.clipFromWorld[i]);
}

// Boxes of the same height that do not overlap. They are stored in rows, so that a new box is
// compared only with the boxes of three rows.
class Boxes {
  private readonly rows: Box[][];

  constructor(height: number) {
    this.rows = Array.from({ length: Math.floor(height / ROW) + 3 }, () => []);
  }

  // Adds a box, whose bottom is inside the view. Returns false if it would overlap another box.
  add(box: Box): boolean {
    const row = Math.floor(box.bottom / ROW) + 1;
    for (let near = row - 1; near <= row + 1; near++) {
      for (const other of this.rows[near]!) if (overlap(box, other)) return false;
    }
    this.rows[row]!.push(box);
    return true;
  }
}

function overlap(a: Box, b: Box): boolean {
  return a.left < b.right && b.left < a.right && Math.abs(a.bottom - b.bottom) < ROW;
}
