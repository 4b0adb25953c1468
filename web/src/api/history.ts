// The part of a running simulation's past that the server stores (its time range), and the notes of
// viewers.
import { listAt, numberAt, objectAt, textAt, textOr } from "./json";

// The stored part of a running simulation's past.
export interface Kept {
  start: number; // s, simulated
  end: number;
}

export interface RecordingNote {
  id: number;
  time: number; // s, simulated
  text: string;
}

export function parseKept(json: unknown): Kept {
  const kept = objectAt(json, "history");
  return { start: numberAt(kept.start_s, "history.start_s"), end: numberAt(kept.end_s, "history.end_s") };
}

export function parseNotes(json: unknown): RecordingNote[] {
  return listAt(json, "notes").map((each, i) => {
    const note = objectAt(each, `notes[${i}]`);
    return {
      id: numberAt(note.id, `notes[${i}].id`),
      time: numberAt(note.time_s, `notes[${i}].time_s`),
      text: textOr(note.text, ""),
    };
  });
}

// The first difference between two recordings.
export interface Difference {
  isEqual: boolean;
  time: number | null; // simulated time, s; null if the messages are equal
  text: string; // the text that `gsv rec diff` prints
}

export function parseDifference(json: unknown): Difference {
  const difference = objectAt(json, "difference");
  return {
    isEqual: difference.equal === true,
    time: typeof difference.time_s === "number" ? difference.time_s : null,
    text: textAt(difference.text, "difference.text"),
  };
}
