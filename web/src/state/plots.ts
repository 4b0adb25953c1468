// The values that are plotted, against simulated time or against each other.
import type { Reference } from "../live/expression";
import { parseExpression } from "../live/expression";

// The source of a plotted value.
export type Source =
  | { kind: "simulation" }
  | { kind: "robot"; robot: string }
  | { kind: "sensor"; topic: string } // the key is the name of a value (live/values.ts)
  | { kind: "topic"; topic: string } // the key is the path of a field (live/fieldPath.ts)
  | { kind: "expression" }; // the key is the text of an expression (live/expression.ts)

export interface Curve {
  id: string;
  source: Source;
  key: string; // key of the value in its source
  unit: string;
  colour: string;
}

// The plotted curves and the axes.
export interface Plots {
  curves: Curve[];
  span: number | null; // the newest seconds that are shown (number of seconds); null for all
  against: string | null; // id of the curve on the horizontal axis; null for simulated time
  events: boolean; // whether events are marked
}

export const NO_PLOTS: Plots = { curves: [], span: 30, against: null, events: true };
export const SPANS: readonly (number | null)[] = [10, 30, 120, 600, null];
export const MOST_CURVES = 8;

// Colours that are distinguishable on white and on black.
const COLOURS = ["#2f81e0", "#e0701a", "#2a9d4a", "#c2399b", "#d0453e", "#12938f", "#8a63d2", "#9a7d0a"];

export const ROBOT_VALUES: readonly { key: string; label: string; unit: string }[] = [
  { key: "x", label: "x", unit: "m" },
  { key: "y", label: "y", unit: "m" },
  { key: "z", label: "z", unit: "m" },
  { key: "yaw", label: "heading", unit: "rad" },
  { key: "speed", label: "speed", unit: "m/s" },
  { key: "turn_rate", label: "turning", unit: "rad/s" },
  { key: "distance", label: "driven", unit: "m" },
  { key: "collisions", label: "collisions", unit: "" },
];

export const SIMULATION_VALUES: readonly { key: string; label: string; unit: string }[] = [
  { key: "real_time_factor", label: "real-time factor", unit: "×" },
  { key: "late_steps", label: "late steps", unit: "" },
];

export function curveId(source: Source, key: string): string {
  const of = source.kind === "robot" ? source.robot : "topic" in source ? source.topic : "";
  return `${source.kind} ${of} ${key}`;
}

// Returns a label such as "b21r speed", "b21r sonar_03 range" or "real-time factor".
export function curveName({ source, key }: Pick<Curve, "source" | "key">): string {
  if (source.kind === "expression") return key;
  if (source.kind === "sensor" || source.kind === "topic") return `${source.topic.replace(/^\//, "").replaceAll("/", " ")} ${key}`;
  const values = source.kind === "robot" ? ROBOT_VALUES : SIMULATION_VALUES;
  const label = values.find((value) => value.key === key)?.label ?? key;
  return source.kind === "robot" ? `${source.robot} ${label}` : label;
}

// Adds the curve, unless it already exists or there are too many.
export function withCurve(plots: Plots, source: Source, key: string, unit: string): Plots {
  const id = curveId(source, key);
  const isThere = plots.curves.some((curve) => curve.id === id);
  if (isThere || plots.curves.length >= MOST_CURVES) return plots;
  const used = plots.curves.map(({ colour }) => colour);
  const colour = COLOURS.find((each) => !used.includes(each)) ?? COLOURS[0]!;
  return { ...plots, curves: [...plots.curves, { id, source, key, unit, colour }] };
}

export function withoutCurve(plots: Plots, id: string): Plots {
  const against = plots.against === id ? null : plots.against;
  return { ...plots, against, curves: plots.curves.filter((curve) => curve.id !== id) };
}

// Returns the value to which a reference in an expression refers.
export function referredTo({ of, key }: Reference): Pick<Curve, "source" | "key"> {
  if (of.startsWith("/")) return { source: { kind: "topic", topic: of }, key };
  return { source: of === "simulation" ? { kind: "simulation" } : { kind: "robot", robot: of }, key };
}

// Returns the reference with which an expression refers to a curve.
export function referenceTo({ source, key }: Pick<Curve, "source" | "key">): string {
  if (source.kind === "expression") return `(${key})`;
  const of = source.kind === "robot" ? source.robot : source.kind === "simulation" ? "simulation" : source.topic;
  return `{${of} ${key}}`;
}

// Returns the values from which a curve is computed. This is its own value, or the values to which
// its expression refers.
export function inputsOf(curve: Pick<Curve, "source" | "key">): Pick<Curve, "source" | "key">[] {
  if (curve.source.kind !== "expression") return [curve];
  return parseExpression(curve.key).references.map(referredTo);
}
