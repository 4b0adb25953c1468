// Groups of pedestrians in a simulation that is being set up (docs/formats/scenario.md).
import type { JsonObject } from "./json";
import { listAt, numberOr, objectAt, textOr } from "./json";

// A disc to which pedestrians walk. Metres.
export interface Goal {
  x: number;
  y: number;
  radius: number;
}

export interface PedestrianSetUp {
  name: string;
  count: number;
  route: Goal[];
  others: JsonObject; // keys that the form does not show, such as speed and radius
}

const FIRST_ROUTE: Goal[] = [
  { x: -3, y: 0, radius: 1 },
  { x: 3, y: 0, radius: 1 },
];

export function newPedestrians(taken: readonly PedestrianSetUp[]): PedestrianSetUp {
  const names = new Set(taken.map(({ name }) => name));
  let name = "pedestrian";
  for (let number = 2; names.has(name); number += 1) name = `pedestrian_${number}`;
  return { name, count: 5, route: FIRST_ROUTE, others: {} };
}

// Returns the route in the format of --pedestrians: "x,y[,radius]:…".
export function routeText(route: readonly Goal[]): string {
  return route.map(({ x, y, radius }) => [x, y, ...(radius === 0 ? [] : [radius])].join(",")).join(":");
}

// Parses a route. Returns null for other texts.
export function parseRoute(text: string): Goal[] | null {
  const goals: Goal[] = [];
  for (const part of text.split(":")) {
    const numbers = part.split(",").map((each) => (each.trim() === "" ? NaN : Number(each)));
    if (numbers.length < 2 || numbers.length > 3 || numbers.some((each) => !Number.isFinite(each))) return null;
    goals.push({ x: numbers[0]!, y: numbers[1]!, radius: numbers[2] ?? 0 });
  }
  return goals;
}

export function pedestriansJson({ name, count, route, others }: PedestrianSetUp): JsonObject {
  return { ...others, ...(name && { name }), count, route: route.map((goal) => ({ ...goal })) };
}

export function parsePedestrians(value: unknown): PedestrianSetUp[] {
  return listAt(value ?? [], "pedestrians").map((each, i) => {
    const { name, count, route, ...others } = objectAt(each, `pedestrians[${i}]`);
    const goals = listAt(route ?? [], `pedestrians[${i}].route`).map((goal, k) => {
      const { x, y, radius } = objectAt(goal, `pedestrians[${i}].route[${k}]`);
      return { x: numberOr(x, 0), y: numberOr(y, 0), radius: numberOr(radius, 0) };
    });
    return { name: textOr(name, ""), count: numberOr(count, 1), route: goals, others };
  });
}
