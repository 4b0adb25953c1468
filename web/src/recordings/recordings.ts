// The recordings that the server can replay.
import type { JsonServer } from "../api/JsonServer";
import { listAt, numberOr, objectAt, textAt, textOr } from "../api/json";

export interface RecordingLine {
  name: string;
  size: number; // bytes
  modified: string; // as RFC 3339 has it; empty: not known
  state: "complete" | "unfinished" | "unreadable";
  problem: string; // why it cannot be read
  duration: number; // s, simulated; of those that are complete
  messages: number;
  world: string; // empty: not known
  robots: number; // 0: not known
  verdict: string; // of the test that kept it; empty: none
  sentence: string; // what failed
  violation: number | null; // s, simulated
}

export interface Recordings {
  folder: string;
  leftOut: number;
  lines: RecordingLine[]; // the newest first
}

// Reading many recordings for the first time takes long.
const TIMEOUT_MS = 30_000;

export async function fetchRecordings(server: JsonServer): Promise<Recordings> {
  const answer = objectAt(await server.get("api/recordings", TIMEOUT_MS), "recordings");
  return {
    folder: textOr(answer.folder, ""),
    leftOut: numberOr(answer.left_out, 0),
    lines: listAt(answer.recordings, "recordings").map(parseRecordingLine),
  };
}

function parseRecordingLine(json: unknown): RecordingLine {
  const line = objectAt(json, "recording");
  const state = textOr(line.state, "");
  return {
    name: textAt(line.name, "recording.name"),
    size: numberOr(line.size_bytes, 0),
    modified: textOr(line.modified, ""),
    state: state === "complete" || state === "unfinished" ? state : "unreadable",
    problem: textOr(line.problem, ""),
    duration: numberOr(line.duration_s, 0),
    messages: numberOr(line.messages, 0),
    world: textOr(line.world, ""),
    robots: numberOr(line.robots, 0),
    verdict: textOr(line.verdict, ""),
    sentence: textOr(line.sentence, ""),
    violation: typeof line.violation_s === "number" ? line.violation_s : null,
  };
}

// The address of a page that replays the recording in its own session, from that simulated second
// on.
export function replayUrl(name: string, from: number | null = null): string {
  return `./?recording=${encodeURIComponent(name)}${from === null ? "" : `#t=${from}`}`;
}
