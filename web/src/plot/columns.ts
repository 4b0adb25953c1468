// Converts curves to the arrays of times and values that the chart library draws (one array is a
// column), and computes their ranges.
import type { Series } from "../live/Series";

export interface Range {
  min: number;
  max: number;
}

export interface DrawnCurve {
  unit: string;
  colour: string;
  series: Series;
  isDashed?: boolean; // whether the curve belongs to the compared recording
}

// If the time between two samples is long, the curve is interrupted between them. The time is long
// if it exceeds SHORTEST_GAP_S and this multiple of the median interval.
const GAP_INTERVALS = 8;
const SHORTEST_GAP_S = 1.5;
const MARGIN = 0.06; // margin above and below, as a fraction of the range

// Returns the samples within the time range, and one more sample on each side. A gap in the curve
// is null.
export function columnsOf(series: Series, time: Range): [number[], (number | null)[]] {
  const [times, values]: [number[], (number | null)[]] = [[], []];
  const gap = gapOf(series, time);
  let previous = NaN;
  for (let i = Math.max(0, series.firstFrom(time.min) - 1); i < series.length; i++) {
    const at = series.timeAt(i);
    const value = series.valueAt(i);
    if (at - previous > gap) {
      times.push((previous + at) / 2);
      values.push(null);
    }
    times.push(at);
    values.push(Number.isFinite(value) ? value : null);
    previous = at;
    if (at > time.max) break;
  }
  return [times, values];
}

// Returns the longest time between two successive samples that the curve still connects.
export function gapOf(series: Series, time: Range): number {
  const first = series.firstFrom(time.min);
  const last = Math.min(series.length, series.firstFrom(time.max)) - 1;
  if (last - first < 2) return Infinity;
  const steps: number[] = [];
  const stride = Math.max(1, Math.floor((last - first) / 64));
  for (let i = first + 1; i <= last; i += stride) steps.push(series.timeAt(i) - series.timeAt(i - 1));
  steps.sort((a, b) => a - b);
  return Math.max(SHORTEST_GAP_S, GAP_INTERVALS * steps[steps.length >> 1]!);
}

// Returns the points of a plot of `y` against `x`. There is one point for each sample of `y`, with
// the newest value of `x` at that time.
export function pathOf(x: Series, y: Series, time: Range): [number[], number[]] {
  const [xs, ys]: [number[], number[]] = [[], []];
  for (let i = y.firstFrom(time.min); i < y.length && y.timeAt(i) <= time.max; i++) {
    const across = x.newestAt(y.timeAt(i));
    if (across === null || !Number.isFinite(across) || !Number.isFinite(y.valueAt(i))) continue;
    xs.push(across);
    ys.push(y.valueAt(i));
  }
  return [xs, ys];
}

// Returns the range that contains all values, with a margin; never empty.
export function rangeOf(lists: readonly (readonly (number | null)[])[]): Range {
  let [min, max] = [Infinity, -Infinity];
  for (const list of lists) {
    for (const value of list) {
      if (value === null || !Number.isFinite(value)) continue;
      min = Math.min(min, value);
      max = Math.max(max, value);
    }
  }
  if (!(min <= max)) return { min: 0, max: 1 };
  const span = max - min;
  if (span <= 1e-9 * Math.max(1, Math.abs(max))) {
    const half = Math.max(Math.abs(max) * 0.05, 0.05);
    return { min: min - half, max: max + half };
  }
  return { min: min - MARGIN * span, max: max + MARGIN * span };
}

// Returns the time range of the axis: the newest `span` seconds before `now`. If `span` is null,
// returns the whole range. `whole` is the range of a recording.
export function timeRange(
  curves: readonly DrawnCurve[],
  span: number | null,
  now: number,
  whole: Range | null = null,
): Range {
  const there = curves.filter(({ series }) => series.length > 0);
  if (span !== null) {
    const max = Math.max(now, span);
    return { min: max - span, max };
  }
  if (whole) return { min: whole.min, max: Math.max(whole.max, whole.min + 0.1) };
  const min = Math.min(now, ...there.map(({ series }) => series.timeAt(0)));
  return { min, max: Math.max(now, min + 1, ...there.map(({ series }) => series.timeAt(series.length - 1))) };
}
