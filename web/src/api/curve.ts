// A curve: a value over a whole recording, as far as the server has read it.
import { listAt, numberAt, objectAt, textOr } from "./json";

// The requested value: a number in a topic's messages, in a robot's state, or (if neither is given)
// in the simulation's state.
export interface CurveOf {
  topic?: string;
  robot?: string;
  key: string;
}

// The samples of a curve that the server has read so far.
export interface WholeCurve {
  times: Float64Array; // s, simulated, ascending
  values: Float64Array; // NaN: not finite in the recording, such as a sonar's range without an echo
  // Whether `values` contains every sample. If not, it contains the minimum and the maximum of each
  // of many equal time intervals.
  isWhole: boolean;
  done: boolean; // whether the server has finished reading the recording
  problem: string; // why values are missing; empty if no values are missing
}

export function parseCurve(json: unknown): WholeCurve {
  const curve = objectAt(json, "curve");
  const times = listAt(curve.time_s, "curve.time_s").map((each, i) => numberAt(each, `curve.time_s[${i}]`));
  const values = listAt(curve.values, "curve.values");
  if (values.length !== times.length) {
    throw new Error(`curve.values: expected ${times.length} values, found ${values.length}`);
  }
  return {
    times: Float64Array.from(times),
    values: Float64Array.from(values, (each) => (typeof each === "number" ? each : NaN)),
    isWhole: curve.is_whole === true,
    done: curve.done === true,
    problem: textOr(curve.problem, ""),
  };
}

export function curveQuery({ topic, robot, key }: CurveOf, most: number): string {
  const of = topic ? `topic=${encodeURIComponent(topic)}&` : robot ? `robot=${encodeURIComponent(robot)}&` : "";
  return `${of}key=${encodeURIComponent(key)}&most=${most}`;
}
