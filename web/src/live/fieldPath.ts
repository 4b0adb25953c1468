// Paths to the fields of a message: "status.robots[2].distance_m".
const MAX_LENGTH = 300;

export type Step = string | number; // a field's name, or the index of an element

// Parses a path. Returns null for other texts.
export function parsePath(path: string): Step[] | null {
  if (path.length > MAX_LENGTH) return null;
  if (path.startsWith(".")) return null;
  const steps: Step[] = [];
  const pattern = /(?:^|\.)([A-Za-z_]\w*)|\[(\d{1,9})\]/gy;
  while (pattern.lastIndex < path.length) {
    const found = pattern.exec(path);
    if (!found) return null;
    if (found[1] !== undefined) steps.push(found[1]);
    else if (steps.length > 0) steps.push(Number(found[2]));
    else return null;
  }
  return steps.length > 0 ? steps : null;
}

export function pathOf(parent: string, step: Step): string {
  if (typeof step === "number") return `${parent}[${step}]`;
  return parent === "" ? step : `${parent}.${step}`;
}

// Returns the value at the path; undefined if there is none.
export function fieldAt(message: unknown, steps: readonly Step[]): unknown {
  let value = message;
  for (const step of steps) {
    if (typeof value !== "object" || value === null || !Object.hasOwn(value, step)) return undefined;
    value = (value as Record<Step, unknown>)[step];
  }
  return value;
}

// Returns the number at the path (true is 1, a time is in seconds); null if there is none.
export function numberAt(message: unknown, steps: readonly Step[]): number | null {
  return numberOf(fieldAt(message, steps));
}

export function numberOf(value: unknown): number | null {
  if (typeof value === "number") return value;
  if (typeof value === "bigint") return Number(value);
  if (typeof value === "boolean") return value ? 1 : 0;
  return isTime(value) ? value.sec + value.nsec * 1e-9 : null;
}

export function isTime(value: unknown): value is { sec: number; nsec: number } {
  if (typeof value !== "object" || value === null) return false;
  const { sec, nsec } = value as Record<string, unknown>;
  return typeof sec === "number" && typeof nsec === "number" && Object.keys(value).length === 2;
}
