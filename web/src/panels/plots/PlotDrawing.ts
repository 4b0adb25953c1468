// Draws the curves of the plots while the panel is visible, and writes their values into the
// legend.
import { PathChart } from "../../plot/PathChart";
import type { DrawnCurve, Range } from "../../plot/columns";
import { pathOf, timeRange } from "../../plot/columns";
import type { Look, Mark, UPlot } from "../../plot/TimeCharts";
import { TimeCharts, timeAt } from "../../plot/TimeCharts";
import type { Curve } from "../../state/plots";
import { curveName } from "../../state/plots";
import { shallowEqual } from "../../state/Store";
import { element, setText } from "../../ui/element";
import { formatTime, formatValue } from "../../ui/format";
import { smallButton } from "../../ui/smallButton";
import type { PanelPorts } from "../contract/ports";
import type { PlotEvents } from "./PlotEvents";
import type { PlotFeed } from "./PlotFeed";

const DRAWING_MS = 100; // period of drawing, so that curves can be read
const NEAR_PX = 6; // maximum distance of the pointer from an event

type Shown = Curve & DrawnCurve;
type Ports = Pick<PanelPorts, "state" | "replay" | "plots">;

export class PlotDrawing {
  readonly place = element("div", { class: "plot-canvas", role: "img", "aria-label": "Plot" });
  readonly legend = element("ul", { class: "plot-legend", "aria-label": "Curves" });
  private charts: { time: TimeCharts; path: PathChart } | null = null;
  private isOpen = false;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private pointed: number | null = null; // position of the pointer, CSS pixels from the left
  // while the user drags in a recording, the time range of the axis does not change
  private heldSpan: Range | null = null;
  private readonly values = new Map<string, HTMLElement>();
  // whether the window of the panel has dark colours; another window may have others
  private dark: MediaQueryList | null = null;
  private window: Window | null = null;
  private readonly instant = element("span", { class: "plot-instant number" });

  constructor(
    private readonly ports: Ports,
    private readonly feed: PlotFeed,
    private readonly events: PlotEvents,
  ) {
    const { place } = this;
    const left = ({ clientX }: PointerEvent) => clientX - place.getBoundingClientRect().left;
    place.addEventListener("pointermove", (event) => this.point(left(event)));
    place.addEventListener("pointerleave", () => this.point(null));
    place.addEventListener("pointerdown", (event) => this.hold(event, left(event)));
    for (const end of ["pointerup", "pointercancel"]) place.addEventListener(end, () => this.letGo());
    ports.state.watch(
      ({ replay, plots }) => replay !== null && plots.against === null,
      (canSeek) => (place.title = canSeek ? "Click or drag to go to a time" : ""),
    );
    if (typeof ResizeObserver !== "undefined") new ResizeObserver(() => this.request()).observe(place);
  }

  // Draws after each change, until the returned function is called.
  open(): () => void {
    this.isOpen = true;
    this.request();
    const end = this.ports.state.watch(
      ({ time, plots }) => ({ time, span: plots.span, against: plots.against, events: plots.events }),
      () => this.request(),
      shallowEqual,
    );
    return () => {
      this.isOpen = false;
      this.followColours(null);
      clearTimeout(this.timer);
      this.timer = undefined;
      end();
    };
  }

  request(): void {
    if (!this.isOpen) return;
    this.timer ??= setTimeout(() => void this.draw().finally(() => (this.timer = undefined)), DRAWING_MS);
  }

  showLegend(curves: readonly Curve[]): void {
    this.values.clear();
    const items = curves.map((curve) => {
      const value = element("span", { class: "number" });
      this.values.set(curve.id, value);
      const swatch = element("span", { class: "swatch" });
      swatch.style.background = curve.colour;
      const remove = smallButton("close", `Remove ${curveName(curve)}`, () => this.ports.plots.remove(curve.id));
      const name = element("span", { class: "plot-name", title: curveName(curve) }, curveName(curve));
      return element("li", {}, swatch, name, value, remove);
    });
    this.legend.replaceChildren(...(curves.length > 0 ? [element("li", {}, this.instant)] : []), ...items);
    this.request();
  }

  private point(x: number | null): void {
    this.pointed = x;
    if (this.heldSpan && x !== null) this.seek(x);
    this.request();
  }

  // In a recording, if the horizontal axis is the time, a press on the plot goes to the time under
  // the pointer. While the user drags, the time follows the pointer.
  private hold({ button, pointerId }: PointerEvent, x: number): void {
    const { replay, plots } = this.ports.state.get();
    if (button !== 0 || !replay || plots.against !== null) return;
    this.place.setPointerCapture(pointerId);
    this.heldSpan = this.span();
    this.point(x);
  }

  private letGo(): void {
    this.heldSpan = null;
    this.request();
  }

  private seek(x: number): void {
    void this.ports.replay.seek(timeAt(x, this.place.clientWidth, this.span()));
  }

  private curves(): Shown[] {
    return this.ports.state.get().plots.curves.flatMap((curve) => {
      const series = this.feed.seriesOf(curve.id);
      return series ? [{ ...curve, series }] : [];
    });
  }

  // Returns the curves of the same quantities in the compared recording. They are drawn dashed.
  private compared(curves: readonly Shown[]): DrawnCurve[] {
    return curves.flatMap(({ id, unit, colour }) => {
      const series = this.feed.comparedOf(id);
      return series ? [{ unit, colour, series, isDashed: true }] : [];
    });
  }

  private span(): Range {
    if (this.heldSpan) return this.heldSpan;
    const { plots, time, replay } = this.ports.state.get();
    return timeRange(this.curves(), plots.span, time, replay && { min: replay.start, max: replay.end });
  }

  // Draws again when the colours of this window change. The panel may have moved to another window:
  // then the charts are made anew, see MountedPanel.afterMove().
  private followColours(window: Window | null): void {
    if (window === this.window) return;
    if (window !== null) this.clear();
    this.window = window;
    this.dark?.removeEventListener("change", this.recolour);
    this.dark = window?.matchMedia?.("(prefers-color-scheme: dark)") ?? null;
    this.dark?.addEventListener("change", this.recolour);
  }

  private readonly recolour = () => this.request();

  private async draw(): Promise<void> {
    this.followColours(this.place.ownerDocument.defaultView);
    const { time, replay, plots } = this.ports.state.get();
    const curves = this.curves();
    const span = this.span();
    const across = curves.find(({ id }) => id === plots.against) ?? null;
    const pointed = this.pointed === null || across ? null : timeAt(this.pointed, this.place.clientWidth, span);
    const marks = plots.events ? this.events.marks() : [];
    setText(this.instant, `at ${formatTime(pointed ?? time)}${eventAt(marks, pointed, this.place.clientWidth, span)}`);
    this.showValues(curves, pointed ?? time);
    if (this.place.clientWidth === 0 || this.place.clientHeight === 0) return;
    if (curves.length === 0) return this.clear();
    this.charts ??= this.makeCharts((await import("uplot")).default);
    if (!across) {
      this.charts.path.clear();
      return this.charts.time.show([...this.compared(curves), ...curves], { time: span, present: replay && time, marks });
    }
    this.charts.time.clear();
    const others = curves.filter((curve) => curve !== across);
    const paths = others.map(({ colour, series }) => ({ colour, points: pathOf(across.series, series, span) }));
    const label = across.unit === "" ? curveName(across) : `${curveName(across)} [${across.unit}]`;
    this.charts.path.show(paths, { label, isEqual: across.unit === "m" && others.every(({ unit }) => unit === "m") });
  }

  private clear(): void {
    this.charts?.time.clear();
    this.charts?.path.clear();
  }

  private makeCharts(uplot: UPlot) {
    const look = () => lookOf(this.place);
    return { time: new TimeCharts(uplot, this.place, look), path: new PathChart(uplot, this.place, look) };
  }

  private showValues(curves: readonly Shown[], time: number): void {
    for (const { id, unit, series } of curves) {
      const value = series.newestAt(time);
      const cell = this.values.get(id);
      if (cell) setText(cell, value === null ? "–" : formatValue(value, unit));
    }
  }
}

// Returns a text with the events near the pointer; empty if there are none.
function eventAt(marks: readonly Mark[], pointed: number | null, width: number, span: Range): string {
  if (pointed === null) return "";
  const near = (NEAR_PX / Math.max(1, width)) * (span.max - span.min);
  const found = marks.filter(({ time }) => Math.abs(time - pointed) <= near);
  return found.length === 0 ? "" : ` · ${found.map(({ label }) => label).join(", ")}`;
}

// Returns the page's present colours (light or dark).
function lookOf(place: HTMLElement): Look {
  const style = getComputedStyle(place);
  const of = (name: string) => style.getPropertyValue(name).trim() || "grey";
  return { ink: of("--ink"), dim: of("--ink-dim"), line: of("--line"), bad: of("--bad"), font: `11.5px ${style.fontFamily}` };
}
