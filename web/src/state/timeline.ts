// What a timeline shows of a recording's events: those of about one instant share a mark.
import type { RecordedEvent, Replay } from "../api/replay";
import { count, formatTime } from "../ui/format";

export interface Mark {
  time: number; // s, simulated: of the first
  share: number; // of the recording's span, 0 to 1
  isBad: boolean; // something died, or failed
  text: string; // a line for each event
}

// The part of the span that two marks need to be told apart.
const NARROWEST_SHARE = 1 / 250;
const MOST_LINES = 6;
const BAD = ["agent_dead", "agent_unresponsive", "failed", "expectation_violated"];

export function shareOf(time: number, { start, end }: Replay): number {
  return end > start ? Math.min(1, Math.max(0, (time - start) / (end - start))) : 0;
}

// `events` by time.
export function marksOf(events: RecordedEvent[], replay: Replay): Mark[] {
  const groups: RecordedEvent[][] = [];
  for (const event of events) {
    const first = groups.at(-1)?.[0];
    const isNear = first && shareOf(event.time, replay) - shareOf(first.time, replay) < NARROWEST_SHARE;
    if (isNear) groups.at(-1)!.push(event);
    else groups.push([event]);
  }
  return groups.map((group) => ({
    time: group[0]!.time,
    share: shareOf(group[0]!.time, replay),
    isBad: group.some(({ event }) => BAD.includes(event)),
    text: textOf(group),
  }));
}

function textOf(group: RecordedEvent[]): string {
  const lines = group.slice(0, MOST_LINES).map(lineOf);
  if (group.length > MOST_LINES) lines.push(`and ${count(group.length - MOST_LINES, "more event")}`);
  return lines.join("\n");
}

// "0:03.20 agent dead · robot_3 (wander): killed"
function lineOf({ time, event, robot, detail }: RecordedEvent): string {
  const what = [event.replaceAll("_", " "), detail || robot].filter((part) => part !== "").join(" · ");
  return `${formatTime(time)} ${what}`;
}

// The instant of the next mark after `time`, or of the last one before it; null: there is none.
export function markBeside(marks: Mark[], time: number, direction: 1 | -1): number | null {
  const CLOSE = 1e-6;
  const found =
    direction > 0
      ? marks.find((mark) => mark.time > time + CLOSE)
      : marks.findLast((mark) => mark.time < time - CLOSE);
  return found?.time ?? null;
}
