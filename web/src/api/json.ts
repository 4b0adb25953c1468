// Reads parts of JSON documents from untrusted sources. If a value has the wrong type, functions
// "…At" throw an error with the key and the expected type, and functions "…Or" return a default.

export type JsonObject = Record<string, unknown>;

export function objectAt(value: unknown, where: string): JsonObject {
  if (typeof value === "object" && value !== null && !Array.isArray(value)) return value as JsonObject;
  throw new Error(`${where}: expected an object, found ${nameOf(value)}`);
}

export function listAt(value: unknown, where: string): unknown[] {
  if (Array.isArray(value)) return value;
  throw new Error(`${where}: expected a list, found ${nameOf(value)}`);
}

export function textAt(value: unknown, where: string): string {
  if (typeof value === "string") return value;
  throw new Error(`${where}: expected a text, found ${nameOf(value)}`);
}

export function numberAt(value: unknown, where: string): number {
  if (typeof value === "number" && Number.isFinite(value)) return value;
  throw new Error(`${where}: expected a number, found ${nameOf(value)}`);
}

export function numbersAt(value: unknown, count: number, where: string): number[] {
  const list = listAt(value, where);
  if (list.length !== count) throw new Error(`${where}: expected ${count} numbers, found ${list.length}`);
  return list.map((each, index) => numberAt(each, `${where}[${index}]`));
}

export function textOr(value: unknown, otherwise: string): string {
  return typeof value === "string" ? value : otherwise;
}

export function numberOr(value: unknown, otherwise: number): number {
  return typeof value === "number" && Number.isFinite(value) ? value : otherwise;
}

function nameOf(value: unknown): string {
  if (value === null) return "null";
  if (value === undefined) return "nothing";
  if (Array.isArray(value)) return "a list";
  return typeof value === "object" ? "an object" : `a ${typeof value}`;
}
