// From values to pixels and back, and the round numbers beside an axis.

export interface Range {
  min: number;
  max: number;
}

const MARGIN = 0.06; // of the span, above and below

// The range that shows all finite values, with a little room; never empty.
export function rangeOf(min: number, max: number): Range {
  if (!(min <= max)) return { min: 0, max: 1 };
  const span = max - min;
  if (span <= 1e-9 * Math.max(1, Math.abs(max))) {
    const half = Math.max(Math.abs(max) * 0.05, 0.05);
    return { min: min - half, max: max + half };
  }
  return { min: min - MARGIN * span, max: max + MARGIN * span };
}

// Round numbers within the range: 1, 2 or 5 times a power of ten apart, at most `most` of them.
export function ticksOf({ min, max }: Range, most: number): number[] {
  const span = max - min;
  if (!(span > 0) || !Number.isFinite(span) || most < 1) return [];
  const rough = span / most;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((each) => each * power).find((each) => each >= rough * (1 - 1e-9))!;
  const ticks: number[] = [];
  for (let i = Math.ceil(min / step - 1e-9); i * step <= max + 1e-9 * step; i++) ticks.push(i * step);
  return ticks;
}

// As many digits as ticks that lie `step` apart need.
export function tickLabel(tick: number, step: number): string {
  const size = Math.max(Math.abs(tick), step);
  if (size >= 1e6 || step < 1e-5) return tick === 0 ? "0" : tick.toExponential(1);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const text = tick.toFixed(digits);
  return Number(text) === 0 ? "0" : text;
}

// Where a value stands between two edges in pixels.
export function place(value: number, { min, max }: Range, from: number, to: number): number {
  return from + ((value - min) / (max - min)) * (to - from);
}
