// Computes the marks of events on the timeline. Events that are close together share a mark.
import type { Difference, Kept, RecordingNote } from "../api/history";
import type { RecordedEvent, Replay } from "../api/replay";
import { count, formatTime } from "../ui/format";
import type { State } from "./State";

// A mark on the timeline, for one or several events.
export interface Mark {
  time: number; // simulated time of the first event, s
  share: number; // position in the timeline's time range, 0 to 1
  isBad: boolean; // whether something died or failed
  kind: "event" | "note" | "difference"; // the most important kind of its events
  text: string; // one line per event, at most MOST_LINES, and the number of further events
}

// The minimum distance of two marks, as a fraction of the span.
const NARROWEST_SHARE = 1 / 250;
const MOST_LINES = 6;
const BAD = ["agent_dead", "agent_unresponsive", "failed", "expectation_violated"];

const MOST_EVENTS = 3000;

// The time range of a timeline: the range of the recording, or of a run's stored past until now.
export type Span = Pick<Replay, "start" | "end">;

export function spanOf(replay: Replay | null, kept: Kept | null, time: number): Span | null {
  if (replay) return { start: replay.start, end: replay.end };
  if (!kept || kept.end <= kept.start) return null;
  return { start: kept.start, end: Math.max(kept.end, time) };
}

// Returns `known`, with the events of `found` that it does not contain yet, ordered by time. If
// there are no new events, returns `known` itself.
export function withNewEvents(known: RecordedEvent[], found: readonly RecordedEvent[]): RecordedEvent[] {
  const keys = new Set(known.map(keyOf));
  const added = found.filter((event) => !keys.has(keyOf(event)));
  if (added.length === 0) return known;
  return [...known, ...added].sort((a, b) => a.time - b.time).slice(-MOST_EVENTS);
}

function keyOf({ time, event, robot, detail }: RecordedEvent): string {
  return JSON.stringify([time, event, robot, detail]);
}

// Returns the notes of the recording and its first difference from another recording as events, so
// that they get marks.
export function noteAndDifferenceEvents(notes: readonly RecordingNote[], difference: Difference | null): RecordedEvent[] {
  const events = notes.map(({ time, text }) => ({ time, event: NOTE, robot: "", detail: text }));
  if (difference?.time == null) return events;
  return [...events, { time: difference.time, event: DIFFERENCE, robot: "", detail: difference.text }];
}

const NOTE = "note";
const DIFFERENCE = "first difference";

export function shareOf(time: number, { start, end }: Span): number {
  return end > start ? Math.min(1, Math.max(0, (time - start) / (end - start))) : 0;
}

// Returns the marks of the events, ordered by time. Events before the range are left out.
export function marksOf(events: readonly RecordedEvent[], span: Span): Mark[] {
  const groups: RecordedEvent[][] = [];
  for (const event of events) {
    if (event.time < span.start) continue;
    const first = groups.at(-1)?.[0];
    const isNear = first && shareOf(event.time, span) - shareOf(first.time, span) < NARROWEST_SHARE;
    if (isNear) groups.at(-1)!.push(event);
    else groups.push([event]);
  }
  return groups.map((group) => ({
    time: group[0]!.time,
    share: shareOf(group[0]!.time, span),
    isBad: group.some(({ event }) => BAD.includes(event)),
    kind: kindOf(group),
    text: textOf(group),
  }));
}

function kindOf(group: RecordedEvent[]): Mark["kind"] {
  if (group.some(({ event }) => event === DIFFERENCE)) return "difference";
  return group.some(({ event }) => event === NOTE) ? "note" : "event";
}

function textOf(group: RecordedEvent[]): string {
  const lines = group.slice(0, MOST_LINES).map(lineOf);
  if (group.length > MOST_LINES) lines.push(`and ${count(group.length - MOST_LINES, "more event")}`);
  return lines.join("\n");
}

// Returns a text such as "0:03.20 agent dead · robot_3 (wander): killed".
function lineOf({ time, event, robot, detail }: RecordedEvent): string {
  const what = [event.replaceAll("_", " "), detail || robot].filter((part) => part !== "").join(" · ");
  return `${formatTime(time)} ${what}`;
}

type Marked = Pick<State, "replay" | "kept" | "time" | "events" | "notes" | "comparison">;

// Returns all marks of the timeline: events, notes, and the first difference from a second
// recording.
export function allMarks({ replay, kept, time, events, notes, comparison }: Marked): Mark[] {
  const span = spanOf(replay, kept, time);
  if (!span) return [];
  const further = noteAndDifferenceEvents(notes, comparison?.difference ?? null);
  const all = further.length > 0 ? [...events, ...further].sort((a, b) => a.time - b.time) : events;
  return marksOf(all, span);
}

// Returns the time of the first mark after `time` (direction 1), or of the last mark before it
// (direction -1); null if there is none.
export function markBeside(marks: Mark[], time: number, direction: 1 | -1): number | null {
  const CLOSE = 1e-6;
  const found =
    direction > 0
      ? marks.find((mark) => mark.time > time + CLOSE)
      : marks.findLast((mark) => mark.time < time - CLOSE);
  return found?.time ?? null;
}
