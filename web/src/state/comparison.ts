// A second recording that is laid over the one that is replayed.
import type { Difference } from "../api/history";
import type { SceneDescription } from "../api/scene";

export interface Comparison {
  recording: string; // its name
  simulation: string; // that it is of
  scene: SceneDescription | null; // null: not known yet
  difference: Difference | null; // null: not known, or not looked for
  problem: string; // why it cannot be compared; empty: it can
}
