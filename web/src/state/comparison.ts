// A second recording that is compared with the replayed one.
import type { Difference } from "../api/history";
import type { SceneDescription } from "../api/scene";
import { formatTime } from "../ui/format";

export interface Comparison {
  recording: string; // name of the recording
  simulation: string; // name of its simulation
  scene: SceneDescription | null; // null if unknown
  difference: Difference | null; // null if unknown, or not requested
  problem: string; // why the recordings cannot be compared; empty if they can be compared
}

// Returns a sentence about the difference of the recordings, and the details that are shown below
// it.
export function resultOf({ recording, difference, problem }: Comparison): { sentence: string; details: string } {
  if (problem !== "") return { sentence: `${recording}: ${problem}`, details: "" };
  if (difference === null) return { sentence: `Compared with ${recording}.`, details: "" };
  const details = difference.text.trim();
  if (difference.isEqual) return { sentence: `${recording} has the same messages.`, details };
  const when = difference.time === null ? "" : ` at ${formatTime(difference.time)}`;
  return { sentence: `First difference from ${recording}${when}:`, details };
}
