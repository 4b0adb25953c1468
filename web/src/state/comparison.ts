// A second recording that is compared with the replayed one.
import type { Difference } from "../api/history";
import type { SceneDescription } from "../api/scene";

export interface Comparison {
  recording: string; // name of the recording
  simulation: string; // name of its simulation
  scene: SceneDescription | null; // null if unknown
  difference: Difference | null; // null if unknown, or not requested
  problem: string; // why it cannot be compared; empty if it can
}
