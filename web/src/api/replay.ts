// The replay of a recording: its span, its playback state, and its events.
import { listAt, numberAt, objectAt, textAt, textOr } from "./json";

// The time range and the playback state of a replay.
export interface Replay {
  start: number; // s, simulated
  end: number;
  speed: number; // simulated seconds per second of wall-clock time
  loop: boolean;
}

export interface RecordedEvent {
  time: number; // s, simulated
  event: string; // started, paused, robot_added, agent_dead, …
  robot: string; // empty if the event concerns no robot
  detail: string;
}

// A line of a recording's log.
export interface RecordedLine {
  time: number; // s, simulated
  level: number; // as in rcl_interfaces/msg/Log: 10 (debug) to 50 (fatal)
  name: string;
  text: string;
}

export function parseReplay(json: unknown): Replay {
  const replay = objectAt(json, "replay");
  return {
    start: numberAt(replay.start_s, "replay.start_s"),
    end: numberAt(replay.end_s, "replay.end_s"),
    speed: numberAt(replay.speed, "replay.speed"),
    loop: replay.loop === true,
  };
}

export function parseEvents(json: unknown): RecordedEvent[] {
  return listAt(json, "events").map((each, i) => {
    const event = objectAt(each, `events[${i}]`);
    return {
      time: numberAt(event.time_s, `events[${i}].time_s`),
      event: textAt(event.event, `events[${i}].event`),
      robot: textOr(event.robot, ""),
      detail: textOr(event.detail, ""),
    };
  });
}

export function parseLog(json: unknown): RecordedLine[] {
  return listAt(json, "log").map((each, i) => {
    const line = objectAt(each, `log[${i}]`);
    return {
      time: numberAt(line.time_s, `log[${i}].time_s`),
      level: numberAt(line.level, `log[${i}].level`),
      name: textOr(line.name, ""),
      text: textAt(line.text, `log[${i}].text`),
    };
  });
}
