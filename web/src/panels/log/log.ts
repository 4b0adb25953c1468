// The lines of /rosout: the events of a simulation, and messages of its behaviours.

export interface LogLine {
  time: number; // s, simulated
  level: number; // as in rcl_interfaces/msg/Log: 10 (debug) to 50 (fatal)
  name: string; // the source: a robot, or gsv
  text: string;
}

export interface Log {
  lines: readonly LogLine[]; // ordered by time; the newest is last
  lowest: number; // lowest level that is shown
  filter: string; // text that a line's name or message must contain
}

export const NO_LOG: Log = { lines: [], lowest: 0, filter: "" };
export const MOST_LINES = 5000;

export const LEVELS: readonly { level: number; label: string; word: string }[] = [
  { level: 0, label: "All levels", word: "debug" },
  { level: 20, label: "Info and above", word: "info" },
  { level: 30, label: "Warnings and above", word: "warning" },
  { level: 40, label: "Errors only", word: "error" },
];

// The number of newest lines with which a new line is compared. This is needed because a new
// subscription delivers the last hundred lines again.
const LIKELY_AGAIN = 200;

// Returns "info", "warning", "error" or "debug".
export function levelWord(level: number): string {
  return LEVELS.findLast((each) => level >= each.level)?.word ?? "debug";
}

export function withLine(lines: readonly LogLine[], line: LogLine): readonly LogLine[] {
  const isSame = (other: LogLine) =>
    other.time === line.time && other.text === line.text && other.name === line.name;
  if (lines.slice(-LIKELY_AGAIN).some(isSame)) return lines;
  return [...lines.slice(lines.length >= MOST_LINES ? 1 : 0), line];
}

export function shownLines({ lines, lowest, filter }: Log): LogLine[] {
  const wanted = filter.trim().toLowerCase();
  return lines.filter(
    ({ level, name, text }) =>
      level >= lowest && (wanted === "" || `${name} ${text}`.toLowerCase().includes(wanted)),
  );
}

// Returns the number of lines up to an instant. `lines` must be ordered by time.
export function countUntil(lines: readonly LogLine[], time: number): number {
  const after = lines.findIndex((line) => line.time > time + 1e-9);
  return after < 0 ? lines.length : after;
}
