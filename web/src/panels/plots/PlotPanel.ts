// The panel of plots: values against simulated time or against each other. The curves can be saved
// as a table.
import { MOST_SAMPLES } from "../../live/Series";
import { csvOf } from "../../live/csv";
import { curveName } from "../../state/plots";
import { element } from "../../ui/element";
import { download, fileName } from "../../ui/files";
import { smallButton } from "../../ui/smallButton";
import type { MountedPanel } from "../contract/Panel";
import type { PanelPorts } from "../contract/ports";
import { PlotDrawing } from "./PlotDrawing";
import { PlotEvents } from "./PlotEvents";
import { PlotFeed } from "./PlotFeed";
import { acrossChoice, addChoice, eventsCheck, expressionForm, spanChoice } from "./PlotTools";
import type { WholeCurvePorts } from "./WholeCurves";
import { WholeCurves } from "./WholeCurves";

type Ports = Pick<PanelPorts, "state" | "topics" | "replay" | "plots"> & WholeCurvePorts;

// Collects values from the moment it is mounted, even while the panel is closed.
export function mount(ports: Ports): MountedPanel {
  const empty = element(
    "p",
    { class: "plot-empty" },
    "No curves yet. Choose a value above, or press the curve button beside a value in the inspector or in a topic.",
  );
  const feed = new PlotFeed(ports.state, ports.topics, () => drawing.request());
  const events = new PlotEvents(ports);
  const drawing = new PlotDrawing(ports, feed, events);
  ports.state.watch(
    ({ plots }) => plots.curves,
    (curves) => {
      empty.hidden = curves.length > 0;
      drawing.showLegend(curves);
    },
  );
  feed.start();
  new WholeCurves(ports, {
    onWhole: (id, curve) => feed.takeWhole(id, curve),
    onPast: (id, curve) => feed.takePast(id, curve),
    onCompared: (id, curve) => feed.takeCompared(id, curve),
  }).start();
  const save = smallButton("save", "Save as CSV", () => saveTable(ports, feed));
  const { button, form } = expressionForm(ports);
  // In a narrow panel, the tools have several lines. The button to save is never alone in one line.
  const last = element("span", { class: "plot-last" }, eventsCheck(ports), element("span", { class: "spacer" }), save);
  const plots = element("div", { class: "plot-body" }, drawing.legend, element("div", { class: "plot-place" }, drawing.place, empty));
  return {
    body: element("div", { class: "plot-panel" }, form, plots),
    tools: [addChoice(ports), button, acrossChoice(ports), spanChoice(ports), last],
    whileOpen: () => {
      const ends = [drawing.open(), events.open(() => drawing.request())];
      return () => ends.forEach((end) => end());
    },
    afterMove: () => drawing.request(),
  };
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
