// The states of robots' lamps, speakers and grippers, from their messages.

// The state of a lamp that is on.
export interface Glow {
  brightness: number; // above 0, at most 1
  colour: [number, number, number];
  radius: number; // m
  range: number; // range of the light, m; 0 means that the lamp lights no objects
  angle: number; // angle of the whole cone, rad; a full turn means all directions
  intensity: number; // intensity at full brightness
}

// The sound that a speaker plays.
export interface Sound {
  name: string; // "tone", "buzz", "chirp", "noise"
  frequency: number; // Hz
  volume: number; // from 0 to 1
  elapsed: number; // s
}

// The state of a gripper's fingers.
export interface Jaws {
  opening: number; // m
  reach: number; // m
  height: number; // m
  held: string; // name of the attached body; empty if there is none
}

type Fields = Record<string, unknown>;

// Returns the state of a lamp; null if the lamp is off, or if the message is from another device.
export function glowOf(message: unknown): Glow | null {
  const { brightness, color, radius_m, range_m, angle_rad, intensity } = fieldsOf(message);
  const { r, g, b } = fieldsOf(color);
  const glow = [brightness, r, g, b, radius_m, range_m, angle_rad, intensity];
  if (!areNumbers(glow) || glow[0]! <= 0) return null;
  return {
    brightness: glow[0]!,
    colour: [glow[1]!, glow[2]!, glow[3]!],
    radius: glow[4]!,
    range: glow[5]!,
    angle: glow[6]!,
    intensity: glow[7]!,
  };
}

// Returns the state of a speaker; null if the speaker is silent, or if the message is from another
// device.
export function soundOf(message: unknown): Sound | null {
  const { sound, frequency_hz, volume, elapsed_s } = fieldsOf(message);
  const numbers = [frequency_hz, volume, elapsed_s];
  if (typeof sound !== "string" || sound === "" || !areNumbers(numbers)) return null;
  return { name: sound, frequency: numbers[0]!, volume: numbers[1]!, elapsed: numbers[2]! };
}

// Returns the state of a gripper; null if the message is from another device.
export function jawsOf(message: unknown): Jaws | null {
  const { opening_m, reach_m, height_m, held } = fieldsOf(message);
  const numbers = [opening_m, reach_m, height_m];
  if (typeof held !== "string" || !areNumbers(numbers)) return null;
  return { opening: numbers[0]!, reach: numbers[1]!, height: numbers[2]!, held };
}

function fieldsOf(value: unknown): Fields {
  return (value ?? {}) as Fields;
}

function areNumbers(values: unknown[]): values is number[] {
  return values.every((value) => typeof value === "number" && Number.isFinite(value));
}
