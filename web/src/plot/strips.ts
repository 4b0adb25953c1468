// Draws curves against simulated time: a strip for each unit, one below the other, on one time axis.
import type { Series } from "../live/Series";
import { formatTime } from "../ui/format";
import type { Range } from "./scale";
import { place, rangeOf, tickLabel, ticksOf } from "./scale";

export interface DrawnCurve {
  unit: string;
  colour: string;
  series: Series;
}

export interface PlotLook {
  ink: string;
  dim: string;
  line: string;
  font: string;
}

export interface PlotView {
  width: number; // CSS pixels
  height: number;
  time: Range; // s, simulated
  cursor: number | null; // s: the instant that is pointed at
  present?: number; // s: where a recording stands
}

export const LEFT_PX = 54;
const RIGHT_PX = 10;
const BOTTOM_PX = 20;
const TOP_PX = 6;
const STRIP_GAP_PX = 8;
const TICK_PX = 34; // between two of the value axis
const TIME_TICK_PX = 90;
// A longer stretch without a value is a gap, where values usually come this many times faster.
const GAP_INTERVALS = 8;
const SHORTEST_GAP_S = 1.5;

// The simulated instant under a pixel.
export function timeAt(x: number, { width, time }: Pick<PlotView, "width" | "time">): number {
  return time.min + ((x - LEFT_PX) / Math.max(1, width - LEFT_PX - RIGHT_PX)) * (time.max - time.min);
}

export function drawPlot(
  context: CanvasRenderingContext2D,
  curves: DrawnCurve[],
  view: PlotView,
  look: PlotLook,
): void {
  const units = [...new Set(curves.map(({ unit }) => unit))];
  const strips = Math.max(1, units.length);
  const height = (view.height - TOP_PX - BOTTOM_PX - (strips - 1) * STRIP_GAP_PX) / strips;
  context.clearRect(0, 0, view.width, view.height);
  context.font = look.font;
  context.lineWidth = 1;
  drawTimeAxis(context, view, look);
  for (let i = 0; i < strips; i++) {
    const top = TOP_PX + i * (height + STRIP_GAP_PX);
    const unit = units[i] ?? "";
    const members = curves.filter((curve) => curve.unit === unit);
    drawStrip(context, members, unit, { ...view, top, height }, look);
  }
  if (view.present !== undefined) drawInstant(context, view.present, view, look, []);
  if (view.cursor !== null) drawInstant(context, view.cursor, view, look, [3, 3]);
}

interface StripView extends PlotView {
  top: number;
}

function drawStrip(
  context: CanvasRenderingContext2D,
  curves: DrawnCurve[],
  unit: string,
  view: StripView,
  look: PlotLook,
): void {
  const { top, height, width } = view;
  const right = width - RIGHT_PX;
  const values = valuesIn(curves, view.time);
  context.strokeStyle = look.line;
  context.strokeRect(LEFT_PX + 0.5, Math.round(top) + 0.5, right - LEFT_PX, Math.round(height));
  const ticks = ticksOf(values, Math.max(1, Math.floor(height / TICK_PX)));
  const step = (ticks[1] ?? values.max) - (ticks[0] ?? values.min);
  context.fillStyle = look.dim;
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const tick of ticks) {
    const y = Math.round(place(tick, values, top + height, top)) + 0.5;
    line(context, LEFT_PX, y, right, y);
    context.fillText(tickLabel(tick, Math.abs(step)), LEFT_PX - 6, y);
  }
  context.textAlign = "left";
  context.textBaseline = "top";
  context.fillStyle = look.ink;
  if (unit !== "") context.fillText(unit, LEFT_PX + 6, top + 5);
  context.save();
  context.beginPath();
  context.rect(LEFT_PX, top, right - LEFT_PX, height);
  context.clip();
  for (const curve of curves) drawCurve(context, curve, values, view);
  context.restore();
}

function drawCurve(
  context: CanvasRenderingContext2D,
  { series, colour }: DrawnCurve,
  values: Range,
  { time, width, top, height }: StripView,
): void {
  const right = width - RIGHT_PX;
  context.strokeStyle = colour;
  context.lineWidth = 1.6;
  context.lineJoin = "round";
  context.beginPath();
  const gap = gapOf(series, time);
  let isDown = false;
  let [previous, lastX, lastY] = [NaN, NaN, NaN];
  const first = Math.max(0, series.firstFrom(time.min) - 1);
  for (let i = first; i < series.length; i++) {
    const at = series.timeAt(i);
    const value = series.valueAt(i);
    if (!Number.isFinite(value) || at - previous > gap) isDown = false;
    previous = at;
    if (!Number.isFinite(value)) continue;
    const x = place(at, time, LEFT_PX, right);
    const y = place(value, values, top + height, top);
    // Of many values in one pixel the next that differs is enough.
    if (isDown && Math.abs(x - lastX) < 0.4 && Math.abs(y - lastY) < 0.4) continue;
    if (isDown) context.lineTo(x, y);
    else {
      context.moveTo(x, y);
      context.lineTo(x + 0.5, y);
    }
    isDown = true;
    [lastX, lastY] = [x, y];
    if (at > time.max) break;
  }
  context.stroke();
  context.lineWidth = 1;
}

function drawTimeAxis(context: CanvasRenderingContext2D, view: PlotView, look: PlotLook): void {
  const { width, height, time } = view;
  const right = width - RIGHT_PX;
  context.strokeStyle = look.line;
  context.fillStyle = look.dim;
  context.textAlign = "center";
  context.textBaseline = "bottom";
  for (const tick of ticksOf(time, Math.max(1, Math.floor((right - LEFT_PX) / TIME_TICK_PX)))) {
    const x = Math.round(place(tick, time, LEFT_PX, right)) + 0.5;
    line(context, x, TOP_PX, x, height - BOTTOM_PX);
    if (tick >= 0) context.fillText(formatTime(tick), Math.min(x, right - 22), height - 3);
  }
}

function drawInstant(
  context: CanvasRenderingContext2D,
  time: number,
  view: PlotView,
  look: PlotLook,
  dashes: number[],
): void {
  const x = Math.round(place(time, view.time, LEFT_PX, view.width - RIGHT_PX)) + 0.5;
  if (x < LEFT_PX || x > view.width - RIGHT_PX) return;
  context.strokeStyle = look.ink;
  context.setLineDash(dashes);
  line(context, x, TOP_PX, x, view.height - BOTTOM_PX);
  context.setLineDash([]);
}

function line(context: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}

function valuesIn(curves: DrawnCurve[], time: Range): Range {
  let [min, max] = [Infinity, -Infinity];
  for (const { series } of curves) {
    const first = Math.max(0, series.firstFrom(time.min) - 1);
    for (let i = first; i < series.length && series.timeAt(i) <= time.max; i++) {
      const value = series.valueAt(i);
      if (!Number.isFinite(value)) continue;
      min = Math.min(min, value);
      max = Math.max(max, value);
    }
  }
  return rangeOf(min, max);
}

// The stretch of time from which on two neighbours are not joined.
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

// The time that the axis spans: the newest `span` seconds before `now`, or all there is (null), which
// of a recording is `whole`.
export function timeRange(
  curves: DrawnCurve[],
  span: number | null,
  now: number,
  whole: Range | null = null,
): Range {
  const starts = curves.filter(({ series }) => series.length > 0).map(({ series }) => series.timeAt(0));
  const ends = curves
    .filter(({ series }) => series.length > 0)
    .map(({ series }) => series.timeAt(series.length - 1));
  if (span !== null) {
    const max = Math.max(now, span);
    return { min: max - span, max };
  }
  if (whole) return { min: whole.min, max: Math.max(whole.max, whole.min + 0.1) };
  const min = Math.min(now, ...starts);
  return { min, max: Math.max(now, min + 1, ...ends) };
}
