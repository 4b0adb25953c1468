// The panel Diagnostics: the simulation, failed robots, warnings of the server, this page, and the
// metrics of the server.
import type { ServerFigures } from "../../api/MetricsApi";
import { Store, shallowEqual } from "../../state/Store";
import { element } from "../../ui/element";
import type { Fact } from "../../ui/facts";
import { createFacts } from "../../ui/facts";
import { count, formatSize } from "../../ui/format";
import type { MountedPanel } from "../contract/Panel";
import type { PanelPorts } from "../contract/ports";
import { DiagnosticsFeed } from "./DiagnosticsFeed";
import type { Diagnosis, Diagnostics } from "./diagnostics";
import { NO_DIAGNOSTICS, robotsWithProblems } from "./diagnostics";

const MAX_ROWS = 100;
const NOTHING_YET = "No data yet. The panel fills when the server responds.";

export function mount({ state, topics, server }: Pick<PanelPorts, "state" | "topics" | "server">): MountedPanel {
  const store = new Store<Diagnostics>(NO_DIAGNOSTICS);
  const feed = new DiagnosticsFeed(store, topics, server);
  // If the simulation changes, the data of the previous simulation is removed.
  state.watch(
    ({ simulation }) => simulation,
    () => store.set(NO_DIAGNOSTICS),
  );
  return panelOf(store, state, () => feed.start());
}

// Makes the panel for the data in the store. `start` starts to collect the data. It returns a
// function that stops collecting.
export function panelOf(store: Store<Diagnostics>, state: PanelPorts["state"], start: () => () => void): MountedPanel {
  const simulation = createFacts("Simulation", NOTHING_YET);
  const robots = createFacts("Robots", NOTHING_YET);
  const warnings = createFacts("Warnings of the server", "None.");
  const page = createFacts("This page", NOTHING_YET);
  const server = createFacts("Server", "This server reports no metrics.");
  const body = element("div", { class: "facts-body", tabindex: "0", role: "region", "aria-label": "State" });
  body.append(...[simulation, robots, warnings, page, server].map((each) => each.element));
  const show = () => {
    const diagnostics = store.get();
    simulation.show(simulationFacts(diagnostics.simulation));
    robots.show(robotFacts(diagnostics));
    page.show(pageFacts(diagnostics, Math.round(state.get().framesPerSecond)));
    server.show(serverFacts(diagnostics.server));
  };
  const whileOpen = () => {
    const ends = [
      start(),
      store.watch((diagnostics) => diagnostics, show, shallowEqual),
      state.watch(({ framesPerSecond }) => Math.round(framesPerSecond), show),
      state.watch(
        (known) => known.serverWarnings,
        (sentences) => warnings.show(sentences.map((sentence): Fact => ["", sentence])),
      ),
    ];
    return () => ends.forEach((end) => end());
  };
  return { body, whileOpen };
}

function simulationFacts(simulation: Diagnosis | null): Fact[] {
  if (!simulation) return [];
  return [["state", simulation.message, simulation.health], ...simulation.values];
}

function robotFacts({ robots }: Diagnostics): Fact[] {
  if (robots.length === 0) return [];
  const bad = robotsWithProblems(robots);
  const good = robots.length - bad.length;
  const rest: Fact[] = good > 0 ? [["", bad.length === 0 ? `${count(good, "robot")} OK.` : good === 1 ? "The other robot is OK." : `The other ${good} robots are OK.`]] : [];
  const rows = bad.slice(0, MAX_ROWS).map(({ name, message, health }): Fact => [name, message, health]);
  const cut: Fact[] = bad.length > MAX_ROWS ? [["", `${count(bad.length - MAX_ROWS, "more robot")} failed.`]] : [];
  return [...rows, ...cut, ...rest];
}

function pageFacts({ dropped }: Diagnostics, frames: number): Fact[] {
  return [
    ["frames per second", String(frames)],
    ["updates dropped for this page", dropped === null ? "not reported" : String(dropped)],
  ];
}

// The metrics' names are those in docs/monitoring.md.
function serverFacts(figures: ServerFigures | null): Fact[] {
  if (!figures) return [];
  const line = (label: string, name: string, told: (value: number) => string = String): Fact[] => {
    const value = figures.get(name);
    return value === undefined ? [] : [[label, told(value)]];
  };
  const up = figures.get("gsv_uptime_seconds") ?? 0;
  const share = (seconds: number) => `${Math.round((100 * seconds) / Math.max(1, up))} % of a core, on average`;
  return [
    ...line("viewers", "gsv_viewers"),
    ...line("connections", "gsv_connections"),
    ...line("refused connections", "gsv_connections_turned_away_total"),
    ...line("updates dropped for all viewers", "gsv_dropped_updates_total"),
    ...line("sent", "gsv_sent_bytes_total", formatSize),
    ...line("late steps of all simulations", "gsv_late_steps_total"),
    ...line("recordings", "gsv_recordings"),
    ...line("messages not recorded: disk too slow", "gsv_recording_dropped_messages_total"),
    ...line("failed calls to the broker", "gsv_broker_errors_total"),
    ...line("processor", "process_cpu_seconds_total", share),
    ...line("memory", "process_resident_memory_bytes", formatSize),
    ...line("threads", "process_threads"),
    ...line("open files", "process_open_fds", (open) => `${open} of ${figures.get("process_max_fds") ?? "?"}`),
    ...line("running for", "gsv_uptime_seconds", (seconds) => `${Math.round(seconds)} s`),
  ];
}
