// Draws curves against another curve, such as the path of a point. Both axes can have the same
// scale.
import type uPlot from "uplot";
import type { Range } from "./columns";
import { rangeOf } from "./columns";
import type { Look, UPlot } from "./TimeCharts";
import { LEFT_PX, RIGHT_PX } from "./TimeCharts";

const AXIS_PX = 34;
const TOP_PX = 8;
const DOT_PX = 4; // diameter of the newest point

// A curve that is drawn against another curve.
export interface Path {
  colour: string;
  points: [number[], number[]];
}

// How the axes of the chart are drawn.
export interface PathView {
  label: string; // label of the horizontal axis
  isEqual: boolean; // whether both axes have the same scale
}

export class PathChart {
  private chart: uPlot | null = null;
  private shape = "";
  private ranges: [Range, Range] = [rangeOf([]), rangeOf([])];

  constructor(
    private readonly uplot: UPlot,
    private readonly host: HTMLElement,
    private readonly look: () => Look,
  ) {}

  show(paths: readonly Path[], { label, isEqual }: PathView): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    this.ranges = rangesOf(paths, isEqual, width - LEFT_PX - RIGHT_PX, height - AXIS_PX - TOP_PX);
    const shape = JSON.stringify([width, height, label, paths.map(({ colour }) => colour)]);
    if (shape !== this.shape || !this.chart) {
      this.clear();
      this.shape = shape;
      this.chart = new this.uplot(this.options(paths, label, width, height), dataOf(paths), this.host);
      return;
    }
    this.chart.setData(dataOf(paths));
  }

  clear(): void {
    this.chart?.destroy();
    this.chart = null;
    this.shape = "";
  }

  private options(paths: readonly Path[], label: string, width: number, height: number): uPlot.Options {
    const { font } = this.look();
    const axis = {
      stroke: () => this.look().dim,
      font,
      grid: { stroke: () => this.look().line, width: 1 },
      ticks: { show: false },
    };
    const limits = (i: 0 | 1) => () => [this.ranges[i].min, this.ranges[i].max] as [number, number];
    return {
      mode: 2,
      width,
      height,
      padding: [TOP_PX, RIGHT_PX, 0, 0],
      legend: { show: false },
      cursor: { drag: { x: false, y: false }, points: { show: false } },
      scales: { x: { time: false, range: limits(0) }, y: { range: limits(1) } },
      axes: [
        { ...axis, size: AXIS_PX, label, labelSize: 14, labelGap: 0, labelFont: font },
        { ...axis, size: LEFT_PX, space: 30 },
      ],
      series: [
        {},
        ...paths.map(({ colour }) => ({
          stroke: colour,
          facets: [
            { scale: "x", auto: true },
            { scale: "y", auto: true },
          ],
          paths: drawPath,
        })),
      ] as uPlot.Series[],
    };
  }
}

function dataOf(paths: readonly Path[]): uPlot.AlignedData {
  return [null, ...paths.map(({ points }) => points)] as unknown as uPlot.AlignedData;
}

// Draws the points in the order of time. Their x values may increase and decrease.
function drawPath(chart: uPlot, index: number): null {
  const [xs, ys] = chart.data[index] as unknown as [number[], number[]];
  const { ctx, bbox } = chart;
  const colour = (chart.series[index]!.stroke as () => string)();
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.strokeStyle = ctx.fillStyle = colour;
  ctx.lineWidth = 1.6 * devicePixelRatio;
  ctx.beginPath();
  xs.forEach((x, i) => ctx.lineTo(chart.valToPos(x, "x", true), chart.valToPos(ys[i]!, "y", true)));
  ctx.stroke();
  if (xs.length > 0) {
    ctx.beginPath();
    ctx.arc(chart.valToPos(xs.at(-1)!, "x", true), chart.valToPos(ys.at(-1)!, "y", true), DOT_PX * devicePixelRatio, 0, 2 * Math.PI);
    ctx.fill();
  }
  ctx.restore();
  return null;
}

export function rangesOf(paths: readonly Path[], isEqual: boolean, width: number, height: number): [Range, Range] {
  const x = rangeOf(paths.map(({ points }) => points[0]));
  const y = rangeOf(paths.map(({ points }) => points[1]));
  if (!isEqual || width <= 0 || height <= 0) return [x, y];
  const scale = Math.max((x.max - x.min) / width, (y.max - y.min) / height);
  return [widened(x, scale * width), widened(y, scale * height)];
}

function widened({ min, max }: Range, span: number): Range {
  const middle = (min + max) / 2;
  return { min: middle - span / 2, max: middle + span / 2 };
}
