// Editing a simulation that stands still: what can be added, done again and taken back.
import type { Behaviours, ModelChoice } from "../api/SetUpApi";
import { mayAct } from "./people";
import type { State } from "./State";

export interface Editing {
  models: ModelChoice[];
  behaviours: Behaviours | null; // null: not known yet
  undo: string[]; // what each edit did, the newest last
  redo: string[];
  isBusy: boolean;
}

export const FIRST_EDITING: Editing = { models: [], behaviours: null, undo: [], redo: [], isBusy: false };

// What runs is paused first.
export function canEdit({ abilities, replay, status, setUp, people }: State): boolean {
  const phase = status?.phase;
  return (
    abilities.creates &&
    mayAct(people) &&
    replay === null &&
    setUp === null &&
    (phase === "created" || phase === "paused" || phase === "running")
  );
}
