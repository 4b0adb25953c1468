// Shows /gsv/status: the state of the simulation and of each robot, and what the page knows about
// the server.
import type { RobotStatus, SimulationStatus } from "../../api/status";
import { statusFromMessage } from "../../api/status";
import type { SimulationStatusMessage } from "../../protocol/messages";
import type { State } from "../../state/State";
import { agentLabel, phaseLabel } from "../../state/actions";
import { holderOf } from "../../state/people";
import { shallowEqual } from "../../state/Store";
import { element, setText } from "../../ui/element";
import type { Fact } from "../../ui/facts";
import { createFacts } from "../../ui/facts";
import { formatDistance, formatFactor, formatTime } from "../../ui/format";
import type { MountedPanel } from "../contract/Panel";
import type { PanelPorts } from "../contract/ports";

type Ports = Pick<PanelPorts, "state" | "topics" | "robots">;

const TOPIC = "/gsv/status";
const MOST_ROWS = 200;

export function mount({ state, topics, robots }: Ports): MountedPanel {
  const simulation = createFacts("Simulation", `Waiting for ${TOPIC}.`);
  const server = createFacts("Server", "Not connected. The page reconnects automatically.");
  const table = new RobotTable((robot) => robots.select(robot));
  const facts = element("div", { class: "facts-body" }, simulation.element, server.element);
  const show = (status: SimulationStatus | null) => {
    simulation.show(status ? simulationFacts(status) : []);
    table.show(status?.robots ?? []);
  };
  // If the simulation changes, the data of the previous simulation is removed.
  state.watch(
    (known) => known.simulation,
    () => show(null),
  );
  const whileOpen = () => {
    const ends = [
      topics.subscribe<SimulationStatusMessage>(TOPIC, (message) => show(statusFromMessage(message))),
      state.watch(serverFacts, (lines) => server.show(lines), sameFacts),
    ];
    return () => ends.forEach((end) => end());
  };
  return { body: element("div", {}, facts, table.element), whileOpen };
}

function simulationFacts(status: SimulationStatus): Fact[] {
  const { phase, mode, time, step, realTimeFactor, targetFactor, lateSteps, waitingFor } = status;
  return [
    ["state", phaseLabel(phase), phase === "failed" ? "error" : ""],
    ["mode", mode === "lockstep" ? "lockstep" : "real time"],
    ["simulated time", formatTime(time)],
    ["step", String(step)],
    ["actual real-time factor", formatFactor(realTimeFactor)],
    ["target real-time factor", mode === "lockstep" ? "none" : formatFactor(targetFactor)],
    ["late steps", String(lateSteps), lateSteps > 0 ? "warning" : ""],
    ["waiting for", waitingFor || "nobody", waitingFor ? "warning" : ""],
  ];
}

function serverFacts({ connection, simulations, people, recording }: State): Fact[] {
  if (connection.phase !== "open") return [];
  const known = (label: string, value: string | undefined): Fact[] => (value === undefined ? [] : [[label, value]]);
  return [
    ["address", location.host],
    ...known("simulations", simulations?.map(({ name }) => name).join(", ")),
    ["viewers", String(people.viewers.length)],
    ["in control", holderOf(people)?.name ?? "nobody"],
    ...known("recording to", recording?.isOn ? recording.path : undefined),
  ];
}

function sameFacts(a: readonly Fact[], b: readonly Fact[]): boolean {
  return a.length === b.length && a.every((fact, i) => shallowEqual(fact, b[i]));
}

const COLUMNS = ["Robot", "Model", "Behaviour", "Agent", "Driven", "Collisions", "Detail"] as const;

class RobotTable {
  readonly element: HTMLElement;
  private readonly rows: { row: HTMLElement; name: HTMLElement; cells: HTMLElement[] }[] = [];
  private readonly body = element("tbody");
  private readonly rest = element("p", { class: "dim" });

  constructor(private readonly select: (robot: string) => void) {
    const head = element("tr", {}, ...COLUMNS.map((title) => element("th", { scope: "col" }, title)));
    const table = element("table", {}, element("thead", {}, head), this.body);
    this.element = element(
      "div",
      { class: "panel-table", tabindex: "0", role: "region", "aria-label": "Robot status" },
      table,
      this.rest,
    );
    this.show([]);
  }

  show(robots: readonly RobotStatus[]): void {
    this.element.hidden = robots.length === 0;
    const shown = robots.slice(0, MOST_ROWS);
    for (const { row } of this.rows.splice(shown.length)) row.remove();
    shown.forEach((robot, i) => {
      const { name, cells } = (this.rows[i] ??= this.newRow());
      setText(name, robot.name);
      const { model, behaviour, distance, collisions, detail } = robot;
      const texts = [model, behaviour || "none", agentLabel(robot), formatDistance(distance), String(collisions), detail];
      texts.forEach((text, column) => setText(cells[column]!, text));
    });
    setText(this.rest, robots.length > MOST_ROWS ? `${robots.length - MOST_ROWS} more robots.` : "");
  }

  private newRow() {
    const name = element("button", { class: "button plain small", type: "button", title: "Select this robot" });
    name.addEventListener("click", () => this.select(name.textContent ?? ""));
    const cells = COLUMNS.slice(1).map(() => element("td"));
    const row = element("tr", {}, element("th", { scope: "row" }, name), ...cells);
    this.body.append(row);
    return { row, name, cells };
  }
}
