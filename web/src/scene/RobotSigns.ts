// Shows the robots' names and marks of their states in the view.
import type { PerspectiveCamera } from "three";
import { Matrix4, Vector3 } from "three";
import { LabelLayer } from "../labels/LabelLayer";
import type { ShownState } from "../state/health";
import { SHOWN_STATES, badness, isTrouble } from "../state/health";
import type { RobotPlaces } from "./RobotPlaces";
import { StateMarks } from "./StateMarks";

// The state of each robot by name, and the robots that a filter selects (null: there is no filter).
export interface RobotStates {
  states: ReadonlyMap<string, ShownState> | null; // null: no states are reported
  chosen: ReadonlySet<string> | null;
}

export interface SignsShown {
  labels: boolean;
  states: boolean;
}

// The labels with the names, and the marks of the states.
export class RobotSigns {
  readonly labels: LabelLayer;
  private readonly clipFromWorld = new Matrix4();
  private readonly eye = new Vector3();
  readonly marks = new StateMarks();
  private robots: RobotPlaces | null = null;
  private known: RobotStates = { states: null, chosen: null };
  // State of each robot, as an index of SHOWN_STATES.
  private states: Uint8Array = new Uint8Array(0);
  private radii: Float64Array = new Float64Array(0);
  private tops: Float64Array = new Float64Array(0); // places above the robots in the present frame

  // `redraw` requests a frame.
  constructor(redraw: () => void) {
    this.labels = new LabelLayer(redraw);
  }

  setRobots(robots: RobotPlaces | null): void {
    this.robots = robots;
    this.setStates(this.known);
    this.measure();
  }

  setStates(known: RobotStates): void {
    this.known = known;
    this.labels.renew();
    const unknown = SHOWN_STATES.indexOf("unknown");
    this.states = Uint8Array.from(this.robots?.names ?? [], (name) => {
      const state = known.states?.get(name);
      return state === undefined ? unknown : SHOWN_STATES.indexOf(state);
    });
  }

  // Call this when shapes have arrived.
  measure(): void {
    this.labels.renew();
    this.robots?.measure();
    this.radii = this.robots?.radii() ?? new Float64Array(0);
  }

  // Call this before a frame is drawn. `height` is the height of the view in CSS pixels.
  placeMarks(camera: PerspectiveCamera, height: number, ratio: number, { states }: SignsShown): void {
    const { chosen } = this.known;
    this.tops = this.robots?.tops() ?? this.tops;
    if (!this.robots || !states || (!this.known.states && !chosen)) return this.marks.hide();
    const { names } = this.robots;
    const isChosen = chosen && ((robot: number) => chosen.has(names[robot]!));
    this.marks.place(this.tops, { states: this.states, radii: this.radii, isChosen }, camera, height, ratio);
  }

  // Call this when a frame is drawn, after placeMarks. `isMoving` means that more frames follow.
  placeLabels(camera: PerspectiveCamera, width: number, height: number, selection: string | null, shown: SignsShown, isMoving: boolean): void {
    if (!this.robots) return this.labels.clear();
    if (!shown.labels) return;
    const { names } = this.robots;
    const { chosen } = this.known;
    const clipFromWorld = this.clipFromWorld.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements;
    const eye = this.eye.setFromMatrixPosition(camera.matrixWorld);
    this.labels.place({ clipFromWorld, eye, width, height }, {
      names,
      tops: this.tops,
      selection,
      isMoving,
      badness: (robot) => {
        const state = SHOWN_STATES[this.states[robot]!]!;
        return isTrouble(state) ? badness(state) : 0;
      },
      isShown: (robot) => chosen === null || chosen.has(names[robot]!) || names[robot] === selection,
    });
  }
}
