// The expectations of a scenario and their verdicts (docs/formats/scenario.md).
import type { ExpectationMessage } from "../protocol/messages";
import { formatTime, formatValue } from "../ui/format";

export const VERDICTS = ["pending", "holds", "violated"] as const;
export type Verdict = (typeof VERDICTS)[number];

export interface Expectation {
  name: string;
  yaml: string; // the YAML in the scenario, on one line
  where: string; // file:line:column
  verdict: Verdict;
  // Distance of the measured value to the limit, and the simulated time (s) of this distance. If
  // the condition must stay true, it is the smallest distance so far, and negative after a
  // violation. If the condition must become true, it is the largest distance so far, and negative
  // until the condition has been true.
  margin: { value: number; unit: string; time: number } | null;
  time: number; // simulated time of the verdict, s; 0 while it is pending
  detail: string;
  bodies: readonly string[]; // bodies that the expectation names
  places: readonly (readonly [x: number, y: number, radius: number])[];
  boxes: readonly (readonly [x0: number, x1: number, y0: number, y1: number])[];
}

export function expectationOf(message: ExpectationMessage): Expectation {
  return {
    name: message.name,
    yaml: message.yaml,
    where: message.where,
    verdict: VERDICTS.find((each) => each === message.state) ?? "pending",
    margin: message.has_margin
      ? { value: message.margin, unit: message.unit, time: message.margin_at_s }
      : null,
    time: message.time_s,
    detail: message.detail,
    bodies: message.bodies,
    places: tuples(message.places, 3).map(([x = 0, y = 0, radius = 0]) => [x, y, radius] as const),
    boxes: tuples(message.boxes, 4).map(([x0 = 0, x1 = 0, y0 = 0, y1 = 0]) => [x0, x1, y0, y1] as const),
  };
}

function tuples(numbers: ArrayLike<number>, size: number): number[][] {
  const all = Array.from(numbers);
  return Array.from({ length: Math.floor(all.length / size) }, (_, i) => all.slice(size * i, size * (i + 1)));
}

// Returns a text such as "3 of 5 held" or "2 of 5 violated"; empty if there are no expectations.
export function summaryOf(expectations: readonly Expectation[]): string {
  const count = (verdict: Verdict) => expectations.filter((each) => each.verdict === verdict).length;
  if (expectations.length === 0) return "";
  const violated = count("violated");
  if (violated > 0) return `${violated} of ${expectations.length} violated`;
  return `${count("holds")} of ${expectations.length} held`;
}

export function verdictWord(verdict: Verdict): string {
  return verdict === "holds" ? "held" : verdict;
}

// Returns a text such as "0.26 m at 0:12.40"; empty if there is no margin.
export function marginText({ margin }: Expectation): string {
  return margin === null ? "" : `${formatValue(margin.value, margin.unit)} at ${formatTime(margin.time)}`;
}
