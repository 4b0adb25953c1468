// The output of a robot's behaviour that the server stores.
import { listAt, numberOr, objectAt, textOr } from "./json";

export interface OutputLine {
  time: number; // s, simulated
  level: number; // as in rcl_interfaces/msg/Log
  text: string;
}

const LEVELS: Record<string, number> = { stdout: 20, stderr: 30 };

// Returns the last lines of the first robot in the answer.
export function parseOutput(json: unknown): OutputLine[] {
  const [robot] = listAt(objectAt(json, "health").robots ?? [], "health.robots");
  if (robot === undefined) return [];
  return listAt(objectAt(robot, "robot").output ?? [], "robot.output").map((each) => {
    const line = objectAt(each, "line");
    return { time: numberOr(line.time_s, 0), level: LEVELS[textOr(line.stream, "")] ?? 40, text: textOr(line.text, "") };
  });
}
