// Draws curves against simulated time: one uPlot chart per unit, one below the other, with the same
// time axis.
import type uPlot from "uplot";
import { formatTime } from "../ui/format";
import type { DrawnCurve, Range } from "./columns";
import { columnsOf, rangeOf } from "./columns";

export type UPlot = typeof uPlot;

export const LEFT_PX = 54;
export const RIGHT_PX = 10;
const TIME_AXIS_PX = 22;
const GAP_PX = 6;
const COMPARED_DASHES = [5, 4];
const CURSORS = "gsv-plots"; // key of the cursor that all charts share

// The colours of the charts.
export interface Look {
  ink: string;
  dim: string;
  line: string;
  bad: string;
  font: string;
}

// An event that is marked on the time axis.
export interface Mark {
  time: number; // s, simulated
  label: string;
  isBad: boolean;
}

export interface TimeView {
  time: Range; // s, simulated
  present: number | null; // present instant of a recording, s; null for a running simulation
  marks: readonly Mark[];
}

interface Strip {
  chart: uPlot;
  curves: readonly DrawnCurve[];
}

// Returns the simulated time at pixel `x` of charts of this width.
export function timeAt(x: number, width: number, time: Range): number {
  return time.min + ((x - LEFT_PX) / Math.max(1, width - LEFT_PX - RIGHT_PX)) * (time.max - time.min);
}

export class TimeCharts {
  private strips: Strip[] = [];
  private shape = "";
  private view: TimeView = { time: { min: 0, max: 1 }, present: null, marks: [] };

  constructor(
    private readonly uplot: UPlot,
    private readonly host: HTMLElement,
    private readonly look: () => Look,
  ) {}

  show(curves: readonly DrawnCurve[], view: TimeView): void {
    this.view = view;
    const { clientWidth: width, clientHeight: height } = this.host;
    const units = [...new Set(curves.map(({ unit }) => unit))];
    const shape = JSON.stringify([width, height, curves.map(({ unit, colour, isDashed }) => [unit, colour, isDashed])]);
    if (shape !== this.shape) {
      this.clear();
      this.shape = shape;
      const share = (height - TIME_AXIS_PX) / Math.max(1, units.length);
      this.strips = units.map((unit, i) => {
        const isLast = i === units.length - 1;
        const members = curves.filter((curve) => curve.unit === unit);
        const options = this.options(unit, members, width, Math.max(30, share + (isLast ? TIME_AXIS_PX : 0)), isLast);
        return { chart: new this.uplot(options, emptyData(members), this.host), curves: members };
      });
    }
    for (const [i, strip] of this.strips.entries()) {
      strip.curves = curves.filter((curve) => curve.unit === units[i]);
      const tables = strip.curves.map(({ series }) => columnsOf(series, view.time) as uPlot.AlignedData);
      const hasValues = tables.some(([times]) => times.length > 0);
      strip.chart.setData(hasValues ? this.uplot.join(tables, tables.map(() => [0, 1])) : emptyData(strip.curves));
    }
  }

  clear(): void {
    for (const { chart } of this.strips) chart.destroy();
    this.strips = [];
    this.shape = "";
  }

  private options(unit: string, curves: readonly DrawnCurve[], width: number, height: number, isLast: boolean): uPlot.Options {
    const { font } = this.look();
    const ink = (name: keyof Look) => () => this.look()[name];
    const axis = { stroke: ink("dim"), font, grid: { stroke: ink("line"), width: 1 }, ticks: { show: false } };
    return {
      width,
      height,
      padding: [GAP_PX, RIGHT_PX, isLast ? 0 : GAP_PX, 0],
      legend: { show: false },
      cursor: { y: false, drag: { x: false, y: false }, sync: { key: CURSORS }, points: { show: curves.length <= 8 } },
      scales: {
        x: { time: false, range: () => [this.view.time.min, this.view.time.max] },
        y: { range: (chart) => valueRange(chart) },
      },
      axes: [
        isLast
          ? { ...axis, size: TIME_AXIS_PX, space: 90, gap: 2, values: (_, times) => times.map((time) => (time < 0 ? "" : formatTime(time))) }
          : { ...axis, size: 0, space: 90, values: (_, times) => times.map(() => "") },
        { ...axis, size: LEFT_PX, space: 30, gap: 4 },
      ],
      series: [{}, ...curves.map(({ colour, isDashed }) => ({
          stroke: colour,
          width: 1.6,
          points: { show: false },
          spanGaps: false,
          ...(isDashed && { dash: COMPARED_DASHES }),
        }))],
      hooks: {
        draw: [
          (chart) => {
            this.drawUnit(chart, unit);
            for (const mark of this.view.marks) this.drawInstant(chart, mark.time, mark.isBad ? "bad" : "dim", [2, 4]);
            if (this.view.present !== null) this.drawInstant(chart, this.view.present, "ink", []);
          },
        ],
      },
    };
  }

  private drawUnit({ ctx, bbox }: uPlot, unit: string): void {
    if (unit === "") return;
    const { ink, font } = this.look();
    ctx.save();
    ctx.fillStyle = ink;
    ctx.font = font.replace(/[\d.]+px/, (size) => `${parseFloat(size) * devicePixelRatio}px`);
    ctx.textAlign = "left";
    ctx.textBaseline = "top";
    ctx.fillText(unit, bbox.left + 6 * devicePixelRatio, bbox.top + 3 * devicePixelRatio);
    ctx.restore();
  }

  private drawInstant(chart: uPlot, time: number, colour: keyof Look, dashes: number[]): void {
    const { min, max } = this.view.time;
    if (time < min || time > max) return;
    const { ctx, bbox } = chart;
    const x = Math.round(chart.valToPos(time, "x", true)) + 0.5;
    ctx.save();
    ctx.strokeStyle = this.look()[colour];
    ctx.lineWidth = devicePixelRatio;
    ctx.setLineDash(dashes.map((dash) => dash * devicePixelRatio));
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.restore();
  }
}

function emptyData(curves: readonly DrawnCurve[]): uPlot.AlignedData {
  return [[], ...curves.map(() => [])];
}

function valueRange(chart: uPlot): [number, number] {
  const { min, max } = rangeOf(chart.data.slice(1) as (number | null)[][]);
  return [min, max];
}
