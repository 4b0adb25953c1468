// The state of editing: what can be added, and the edits that can be undone and redone.
import type { Behaviours, ModelChoice } from "../api/SetUpApi";
import type { SceneDescription } from "../api/scene";

export const EDIT_PANEL = "edit"; // id of the panel that is open while editing

// The mode and the steps of the handles that move or rotate the selected body.
export interface GizmoTool {
  mode: "move" | "turn";
  snaps: boolean;
  distance: number; // m
  angleDeg: number;
}

// A wall that is drawn by two clicks; lengths in metres.
export interface WallDrawing {
  thickness: number;
  height: number;
  colour: string; // RRGGBB
  from: { x: number; y: number } | null; // the first click; null before the first click
}

export interface Editing {
  models: ModelChoice[];
  objects: string[]; // models that are not robots
  chosen: string | null; // the selected object; null: edits change the selected robot
  more: readonly string[]; // other selected bodies
  tool: GizmoTool;
  wall: WallDrawing | null; // if set, the next clicks on the floor are the wall's ends
  behaviours: Behaviours | null; // null if unknown
  undo: string[]; // names of the edits; the newest is last
  redo: string[];
  isBusy: boolean;
}

export const FIRST_EDITING: Editing = {
  models: [],
  objects: [],
  chosen: null,
  more: [],
  tool: { mode: "move", snaps: false, distance: 0.1, angleDeg: 15 },
  wall: null,
  behaviours: null,
  undo: [],
  redo: [],
  isBusy: false,
};

// Returns the names of movable bodies of which the user can add copies. There is one name for each
// model. Robots and avatars are left out.
export function copiesOf(scene: SceneDescription | null): string[] {
  const names = new Map<string, string>(); // names of bodies, by model
  for (const { name, model, isRobot, isAvatar, isFixed } of scene?.bodies ?? []) {
    if (!isRobot && !isAvatar && !isFixed && !names.has(model)) names.set(model, name);
  }
  return [...names.values()].sort();
}

// The body that edits change: the selected object. If no object is selected, the selected robot.
export function chosenOf({ editing, selection }: { editing: Editing | null; selection: string | null }): string | null {
  return editing?.chosen ?? selection;
}

// All selected bodies. The first one is the reference for moving and rotating.
export function allChosen(state: { editing: Editing | null; selection: string | null }): readonly string[] {
  const first = chosenOf(state);
  return first === null ? [] : [first, ...(state.editing?.more ?? [])];
}
