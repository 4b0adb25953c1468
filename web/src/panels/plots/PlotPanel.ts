// The panel of plots: values against simulated time, several curves, as a table for other programs.
import { MOST_SAMPLES } from "../../live/Series";
import { csvOf } from "../../live/csv";
import type { DrawnCurve, PlotView } from "../../plot/strips";
import type { Range } from "../../plot/scale";
import { drawPlot, timeAt, timeRange } from "../../plot/strips";
import type { Curve } from "../../state/plots";
import { MOST_CURVES, ROBOT_VALUES, SIMULATION_VALUES, SPANS, curveName } from "../../state/plots";
import { shallowEqual } from "../../state/Store";
import { element, setText } from "../../ui/element";
import { download, fileName } from "../../ui/files";
import { formatTime, formatValue } from "../../ui/format";
import type { IconName } from "../../ui/icons";
import { icon } from "../../ui/icons";
import type { MountedPanel } from "../contract/Panel";
import type { PanelPorts } from "../contract/ports";
import { PlotFeed } from "./PlotFeed";
import type { WholeCurvePorts } from "./WholeCurves";
import { WholeCurves } from "./WholeCurves";

type Ports = Pick<PanelPorts, "state" | "topics" | "replay" | "plots"> & WholeCurvePorts;

const DRAWING_MS = 100; // between two pictures: as fast as curves can be read

// Collects from when it is mounted, whether it is open or not.
export function mount(ports: Ports): MountedPanel {
  const canvas = element("canvas", { class: "plot-canvas", role: "img", "aria-label": "Plot" });
  const legend = element("ul", { class: "plot-legend", "aria-label": "Curves" });
  const empty = element(
    "p",
    { class: "plot-empty" },
    "No curves yet. Choose a value above, or press the curve button beside a value in the inspector.",
  );
  const feed = new PlotFeed(ports.state, ports.topics, () => drawing.request());
  const drawing = new Drawing(ports, feed, canvas, legend);
  ports.state.watch(
    ({ plots }) => plots.curves,
    (curves) => {
      empty.hidden = curves.length > 0;
      drawing.showLegend(curves);
    },
  );
  feed.start();
  new WholeCurves(ports, (id, curve) => feed.takeWhole(id, curve)).start();
  if (typeof ResizeObserver !== "undefined") new ResizeObserver(() => drawing.request()).observe(canvas);
  const save = headButton("save", "Save as CSV", () => saveTable(ports, feed));
  return {
    body: element("div", { class: "plot-body" }, legend, element("div", { class: "plot-place" }, canvas, empty)),
    tools: [addChoice(ports), spanChoice(ports), element("span", { class: "spacer" }), save],
    whileOpen: () => drawing.open(),
  };
}

function headButton(picture: IconName, label: string, onclick: () => void): HTMLElement {
  return element(
    "button",
    { class: "button plain small", type: "button", "aria-label": label, title: label, onclick },
    icon(picture),
  );
}

// The values of the simulation and of the selected robot; those of sensors are in the inspector.
function addChoice({ state, plots }: Ports): HTMLElement {
  const choice = element("select", { "aria-label": "Add a curve" });
  const fill = ({ selection, isFull }: { selection: string | null; isFull: boolean }) => {
    choice.replaceChildren(new Option(isFull ? `At most ${MOST_CURVES} curves` : "Add a curve…", ""));
    const group = (label: string, kind: string, values: readonly { key: string; label: string }[]) => {
      const options = element("optgroup", { label });
      options.append(...values.map(({ key, label: name }) => new Option(name, `${kind} ${key}`)));
      choice.append(options);
    };
    if (selection !== null) group(selection, "robot", ROBOT_VALUES);
    group("Simulation", "simulation", SIMULATION_VALUES);
    choice.disabled = isFull;
  };
  choice.addEventListener("change", () => {
    const [kind, key] = choice.value.split(" ");
    choice.value = "";
    const { selection } = state.get();
    if (kind === "simulation") plots.add({ kind: "simulation" }, key!);
    else if (kind === "robot" && selection !== null) plots.add({ kind: "robot", robot: selection }, key!);
  });
  state.watch(
    ({ selection, plots: known }) => ({ selection, isFull: known.curves.length >= MOST_CURVES }),
    fill,
    shallowEqual,
  );
  return choice;
}

function spanChoice({ state, plots }: Ports): HTMLElement {
  const choice = element("select", { "aria-label": "Time shown" });
  choice.append(
    ...SPANS.map((span) => new Option(span === null ? "All" : `Last ${spanLabel(span)}`, String(span))),
  );
  state.watch(
    ({ replay }) => replay !== null,
    (isReplay) => (choice.options[SPANS.indexOf(null)]!.text = isReplay ? "Whole recording" : "All"),
  );
  choice.addEventListener("change", () => {
    const span = choice.value === "null" ? null : Number(choice.value);
    plots.setSpan(span);
  });
  state.watch(
    (known) => known.plots.span,
    (span) => (choice.value = String(span)),
  );
  return choice;
}

function spanLabel(seconds: number): string {
  return seconds < 120 ? `${seconds} s` : `${seconds / 60} min`;
}

const THINNED =
  `For a curve with more than ${MOST_SAMPLES.toLocaleString("en")} values, the table holds the minimum and the ` +
  "maximum of each short interval. `gsv rec export` writes all values.";

function saveTable({ state, notices }: Ports, feed: PlotFeed): void {
  const { plots, simulation, time } = state.get();
  const columns = plots.curves.flatMap((curve) => {
    const series = feed.seriesOf(curve.id);
    return series ? [{ name: curveName(curve), unit: curve.unit, series }] : [];
  });
  download(fileName(simulation, time, "plot", "csv"), new Blob([csvOf(columns)], { type: "text/csv" }));
  if (plots.curves.some(({ id }) => feed.isThinned(id))) notices.notify("note", THINNED);
}

class Drawing {
  private isOpen = false;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private pointed: number | null = null; // CSS pixels from the canvas' left
  private heldSpan: Range | null = null; // while a recording is dragged: the axis stays
  private readonly values = new Map<string, HTMLElement>();
  private readonly instant = element("span", { class: "plot-instant number" });

  constructor(
    private readonly ports: Ports,
    private readonly feed: PlotFeed,
    private readonly canvas: HTMLCanvasElement,
    private readonly legend: HTMLElement,
  ) {
    canvas.addEventListener("pointermove", (event) => this.point(event.offsetX));
    canvas.addEventListener("pointerleave", () => this.point(null));
    canvas.addEventListener("pointerdown", (event) => this.hold(event));
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => this.letGo());
    ports.state.watch(
      ({ replay }) => replay !== null,
      (isReplay) => (canvas.title = isReplay ? "Click or drag to go to a time" : ""),
    );
  }

  // Draws what changes until the function that it gives is called.
  open(): () => void {
    this.isOpen = true;
    this.request();
    const end = this.ports.state.watch(
      ({ time, plots }) => ({ time, span: plots.span }),
      () => this.request(),
      shallowEqual,
    );
    return () => {
      this.isOpen = false;
      clearTimeout(this.timer);
      this.timer = undefined;
      end();
    };
  }

  request(): void {
    if (!this.isOpen) return;
    this.timer ??= setTimeout(() => {
      this.timer = undefined;
      this.draw();
    }, DRAWING_MS);
  }

  showLegend(curves: Curve[]): void {
    this.values.clear();
    const items = curves.map((curve) => {
      const value = element("span", { class: "number" });
      this.values.set(curve.id, value);
      const swatch = element("span", { class: "swatch" });
      swatch.style.background = curve.colour;
      const label = `Remove ${curveName(curve)}`;
      const remove = headButton("close", label, () => this.ports.plots.remove(curve.id));
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

  // A recording goes where the plot is pressed, and along while it is held.
  private hold({ button, pointerId, offsetX }: PointerEvent): void {
    if (button !== 0 || !this.ports.state.get().replay) return;
    this.canvas.setPointerCapture(pointerId);
    this.heldSpan = this.span();
    this.point(offsetX);
  }

  private letGo(): void {
    this.heldSpan = null;
    this.request();
  }

  private seek(x: number): void {
    void this.ports.replay.seek(timeAt(x, { width: this.canvas.clientWidth, time: this.span() }));
  }

  private curves(): (DrawnCurve & Curve)[] {
    return this.ports.state.get().plots.curves.flatMap((curve) => {
      const series = this.feed.seriesOf(curve.id);
      return series ? [{ ...curve, series }] : [];
    });
  }

  private span(): Range {
    if (this.heldSpan) return this.heldSpan;
    const { plots, time, replay } = this.ports.state.get();
    return timeRange(this.curves(), plots.span, time, replay && { min: replay.start, max: replay.end });
  }

  private draw(): void {
    const { time, replay } = this.ports.state.get();
    const context = this.canvas.getContext("2d");
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    const curves = this.curves();
    const view = { width, height, time: this.span(), ...(replay && { present: time }) };
    const pointed = this.pointed === null ? null : timeAt(this.pointed, view);
    this.showValues(curves, pointed ?? time);
    if (!context || width === 0) return;
    this.fit(context, width, height);
    drawPlot(context, curves, { ...view, cursor: pointed } satisfies PlotView, lookOf(this.canvas));
  }

  private fit(context: CanvasRenderingContext2D, width: number, height: number): void {
    const [w, h] = [Math.round(width * devicePixelRatio), Math.round(height * devicePixelRatio)];
    if (this.canvas.width !== w || this.canvas.height !== h) [this.canvas.width, this.canvas.height] = [w, h];
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
  }

  private showValues(curves: (DrawnCurve & Curve)[], time: number): void {
    setText(this.instant, `at ${formatTime(time)}`);
    for (const { id, unit, series } of curves) {
      const value = series.newestAt(time);
      const cell = this.values.get(id);
      if (cell) setText(cell, value === null ? "–" : formatValue(value, unit));
    }
  }
}

// The page's colours, which follow light and dark.
function lookOf(canvas: HTMLElement) {
  const style = getComputedStyle(canvas);
  const of = (name: string) => style.getPropertyValue(name).trim() || "grey";
  return { ink: of("--ink"), dim: of("--ink-dim"), line: of("--line"), font: `11.5px ${style.fontFamily}` };
}
