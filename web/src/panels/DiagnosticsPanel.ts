// How things are: the simulation, the robots that are unwell, what the server complained of, this page
// and the server. Good news is short.
import type { ServerFigures } from "../api/MetricsApi";
import type { App } from "../app/App";
import type { Diagnosis, Diagnostics } from "../state/diagnostics";
import { unwell } from "../state/diagnostics";
import { shallowEqual } from "../state/Store";
import { element, setText } from "../ui/element";
import { count, formatSize } from "../ui/format";
import { icon } from "../ui/icons";

const MOST_ROWS = 100;

type Line = [label: string, value: string];

export function createDiagnosticsPanel(app: App): HTMLElement {
  const simulation = part("Simulation");
  const robots = part("Robots");
  const complaints = part("Complaints");
  const page = part("This page");
  const server = part("Server");
  const body = element("div", { class: "diagnostics-body", tabindex: "0", role: "region", "aria-label": "How things are" });
  body.append(simulation.element, robots.element, complaints.element, page.element, server.element);
  const panel = element(
    "section",
    { class: "diagnostics", "aria-label": "Diagnostics" },
    element("div", { class: "log-head" }, element("h2", {}, "Diagnostics"), element("span", { class: "spacer" }), closeButton(app)),
    body,
  );
  app.store.watch(
    ({ diagnostics, framesPerSecond }) => ({ diagnostics, frames: Math.round(framesPerSecond) }),
    ({ diagnostics, frames }) => {
      panel.hidden = !diagnostics.open;
      if (!diagnostics.open) return;
      simulation.show(simulationLines(diagnostics.simulation));
      robots.show(robotLines(diagnostics));
      complaints.show(diagnostics.complaints.map((sentence): Line => ["", sentence]), "None.");
      page.show(pageLines(diagnostics, frames));
      server.show(serverLines(diagnostics.server), "It tells no figures.");
    },
    shallowEqual,
  );
  return panel;
}

// A list under a heading; what has not changed is left as it is.
function part(title: string) {
  const list = element("dl", { class: "diagnostics-lines" });
  const empty = element("p", { class: "dim" });
  let shown = "";
  return {
    element: element("div", { class: "diagnostics-part" }, element("h3", {}, title), list, empty),
    show(lines: readonly (Line | [...Line, health: string])[], otherwise = "Nothing is known yet."): void {
      setText(empty, otherwise);
      empty.hidden = lines.length > 0;
      list.hidden = lines.length === 0;
      const text = JSON.stringify(lines);
      if (text === shown) return;
      shown = text;
      list.replaceChildren(...lines.flatMap(([label, value, health = ""]) => [
        element("dt", { class: health }, label),
        element("dd", {}, value),
      ]));
    },
  };
}

function simulationLines(simulation: Diagnosis | null): (Line | [...Line, string])[] {
  if (!simulation) return [];
  return [["state", simulation.message, simulation.health], ...simulation.values];
}

function robotLines({ robots }: Diagnostics): (Line | [...Line, string])[] {
  if (robots.length === 0) return [];
  const bad = unwell(robots);
  const good = robots.length - bad.length;
  const rest: Line[] = good > 0 ? [["", bad.length === 0 ? `${count(good, "robot")} well.` : `${good} more well.`]] : [];
  const rows = bad.slice(0, MOST_ROWS).map(({ name, message, health }): [...Line, string] => [name, message, health]);
  const cut: Line[] = bad.length > MOST_ROWS ? [["", `${bad.length - MOST_ROWS} more unwell.`]] : [];
  return [...rows, ...cut, ...rest];
}

function pageLines({ dropped }: Diagnostics, frames: number): Line[] {
  return [
    ["pictures a second", String(frames)],
    ["updates dropped for this page", dropped === null ? "not told" : String(dropped)],
  ];
}

// By the names of docs/monitoring.md.
function serverLines(figures: ServerFigures | null): Line[] {
  if (!figures) return [];
  const line = (label: string, name: string, told: (value: number) => string = String): Line[] => {
    const value = figures.get(name);
    return value === undefined ? [] : [[label, told(value)]];
  };
  const up = figures.get("gsv_uptime_seconds") ?? 0;
  const share = (seconds: number) => `${Math.round((100 * seconds) / Math.max(1, up))} % of a core, on average`;
  return [
    ...line("viewers", "gsv_viewers"),
    ...line("connections", "gsv_connections"),
    ...line("connections turned away", "gsv_connections_turned_away_total"),
    ...line("updates dropped for all viewers", "gsv_dropped_updates_total"),
    ...line("sent", "gsv_sent_bytes_total", formatSize),
    ...line("late steps of all simulations", "gsv_late_steps_total"),
    ...line("recordings", "gsv_recordings"),
    ...line("messages that the disk was too slow for", "gsv_recording_dropped_messages_total"),
    ...line("failed calls to the broker", "gsv_broker_errors_total"),
    ...line("processor", "process_cpu_seconds_total", share),
    ...line("memory", "process_resident_memory_bytes", formatSize),
    ...line("threads", "process_threads"),
    ...line("open files", "process_open_fds", (open) => `${open} of ${figures.get("process_max_fds") ?? "?"}`),
    ...line("up for", "gsv_uptime_seconds", (seconds) => `${Math.round(seconds)} s`),
  ];
}

function closeButton(app: App): HTMLElement {
  const attributes = { class: "button plain small", type: "button", title: "Close diagnostics (H)" };
  const close = () => app.openDiagnostics(false);
  return element("button", { ...attributes, "aria-label": "Close diagnostics", onclick: close }, icon("close"));
}
