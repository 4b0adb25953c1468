// Whether a simulation is being recorded, and to which file.
import { numberOr, objectAt, textOr } from "./json";

export interface Recording {
  isOn: boolean;
  path: string; // path of the current or the last recording; empty if there was no recording
  bytes: number;
  droppedMessages: number;
}

export function parseRecording(json: unknown): Recording {
  const recording = objectAt(json, "recording");
  return {
    isOn: recording.recording === true,
    path: textOr(recording.path, ""),
    bytes: numberOr(recording.size_bytes, 0),
    droppedMessages: numberOr(recording.dropped_messages, 0),
  };
}
