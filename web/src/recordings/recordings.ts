// The recordings that the server can replay.
import type { JsonServer } from "../api/JsonServer";
import { listAt, numberOr, objectAt, textAt, textOr } from "../api/json";

// One recording in the list.
export interface RecordingLine {
  name: string;
  size: number; // bytes
  modified: string; // in the format of RFC 3339; empty if unknown
  state: "complete" | "unfinished" | "unreadable";
  problem: string; // why the recording cannot be read; empty if it can be read
  duration: number; // simulated time, s; only for complete recordings
  messages: number;
  world: string; // empty if unknown
  robots: number; // 0 if unknown
  verdict: string; // verdict of the test that made the recording; empty if there is none
  sentence: string; // the expectation that failed
  violation: number | null; // s, simulated
}

export interface Recordings {
  folder: string;
  leftOut: number;
  lines: RecordingLine[]; // ordered by time; the newest is first
}

// The time limit is long, because it takes long to read many recordings for the first time.
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

// Returns the address of a page that replays the recording. The page opens a private replay, which
// no other page shows. The replay starts at the simulated time `from`, in seconds.
export function replayUrl(name: string, from: number | null = null): string {
  return `./?recording=${encodeURIComponent(name)}${from === null ? "" : `#t=${from}`}`;
}
