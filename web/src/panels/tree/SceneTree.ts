// The list at the side: the robots and how they are doing, and what else is in the world.
import type { RobotStatus } from "../../api/status";
import type { SceneBody, SceneDescription } from "../../api/scene";
import { robotsOf } from "../../api/scene";
import { agentLabel } from "../../state/actions";
import { shallowEqual } from "../../state/Store";
import { element, setAttribute, setText } from "../../ui/element";
import { count, formatDistance } from "../../ui/format";
import type { PanelPorts } from "../contract/ports";

type Ports = Pick<PanelPorts, "state" | "robots">;

// `pages`: what leads to the other pages.
export function createSceneTree(ports: Ports, pages: HTMLElement): HTMLElement {
  const heading = element("h2", {}, "Robots");
  const robots = element("ul", { class: "robots", "aria-label": "Robots" });
  const empty = element(
    "div",
    { class: "hint" },
    element("p", {}, "No robots yet. Start the simulation with robots:"),
    element("code", {}, "gsv run WORLD --robot MODEL@x,y --behaviour wander"),
  );
  const world = element("details", { class: "world-tree" });
  const tree = element("nav", { class: "sidebar", "aria-label": "Scene" }, heading, robots, empty, world, pages);

  ports.state.watch(
    ({ setUp }) => setUp !== null,
    (hidden) => (tree.hidden = hidden),
  );
  const rows = new Map<string, RobotRow>();
  ports.state.watch(
    ({ status }) => status?.robots ?? [],
    (statuses) => {
      setText(heading, headingFor(statuses, stationsOf(ports)));
      updateRows(ports, robots, rows, statuses);
    },
    (a, b) => a.length === b.length && a.every((robot, i) => shallowEqual(robot, b[i])),
  );
  ports.state.watch(
    ({ status }) => status === null || status.robots.length > 0,
    (hidden) => (empty.hidden = hidden),
  );
  ports.state.watch(
    ({ selection }) => selection,
    (selection, before) => {
      // Only these two: with a thousand rows a browser would look at the style of each anew.
      if (before) rows.get(before)?.setSelected(false);
      if (selection) rows.get(selection)?.setSelected(true);
      if (selection) rows.get(selection)?.item.scrollIntoView({ block: "nearest" });
    },
  );
  ports.state.watch(
    ({ scene }) => scene,
    (scene) => {
      showWorld(ports, world, scene);
      const statuses = ports.state.get().status?.robots ?? [];
      setText(heading, headingFor(statuses, stationsOf(ports)));
      updateRows(ports, robots, rows, statuses); // who is an avatar or a station
    },
  );
  ports.state.watch(
    ({ editing }) => `${editing !== null} ${editing?.chosen}`,
    () => showWorld(ports, world, ports.state.get().scene),
  );
  return tree;
}

function stationsOf(ports: Ports): Set<string> {
  return new Set(robotsOf(ports.state.get().scene).flatMap(({ name, isStation }) => (isStation ? [name] : [])));
}

// "3 robots", "1 robot, 2 stations", "Robots".
function headingFor(statuses: RobotStatus[], stations: Set<string>): string {
  const fixed = statuses.filter(({ name }) => stations.has(name)).length;
  const robots = statuses.length - fixed;
  const parts = [robots > 0 ? count(robots, "robot") : "", fixed > 0 ? count(fixed, "station") : ""];
  return parts.filter((part) => part !== "").join(", ") || "Robots";
}

type Kind = "robot" | "avatar" | "station";

// One robot. A row that is out of sight (and so not laid out, style/panels.css) is written when it comes
// into sight: a thousand rows that change five times a second would keep the page from answering.
class RobotRow {
  readonly item: HTMLLIElement;
  private latest: { robot: RobotStatus; kind: Kind } | null = null;
  private isInSight = true; // until the browser says otherwise
  private readonly button: HTMLButtonElement;
  private readonly dot = element("span", { class: "dot" });
  private readonly name = element("span", { class: "robot-name" });
  private readonly behaviour = element("span", { class: "robot-behaviour" });
  private readonly distance = element("span", { class: "number" });
  private readonly collisions = element("span", { class: "number collisions" });

  constructor(
    private readonly ports: Ports,
    robot: string,
  ) {
    this.button = element(
      "button",
      { class: "robot", type: "button", "data-robot": robot, onclick: () => ports.robots.select(robot) },
      this.dot,
      this.name,
      this.distance,
      this.behaviour,
      this.collisions,
    );
    this.button.addEventListener("dblclick", () => ports.robots.follow());
    this.item = element("li", {}, this.button);
    this.item.addEventListener("contentvisibilityautostatechange", (event) => {
      this.isInSight = !(event as ContentVisibilityAutoStateChangeEvent).skipped;
      this.write();
    });
    this.setSelected(ports.state.get().selection === robot);
  }

  update(robot: RobotStatus, kind: Kind): void {
    this.latest = { robot, kind };
    this.write();
  }

  setSelected(selected: boolean): void {
    this.button.setAttribute("aria-pressed", String(selected));
  }

  private write(): void {
    if (!this.latest || !this.isInSight) return;
    const { robot, kind } = this.latest;
    const label = agentLabel(robot);
    setAttribute(this.dot, "data-phase", robot.agentPhase);
    setAttribute(this.dot, "title", label);
    setText(this.name, robot.name);
    const avatar = this.ports.state.get().replay ? "avatar" : "avatar · W A S D"; // what was recorded stays so
    const behaviour = `${robot.behaviour || "no behaviour"} · ${label}`;
    const station = robot.behaviour ? `station · ${behaviour}` : "station";
    setText(this.behaviour, kind === "avatar" ? avatar : kind === "station" ? station : behaviour);
    setText(this.distance, kind === "station" ? "" : formatDistance(robot.distance));
    setText(this.collisions, robot.collisions > 0 ? count(robot.collisions, "collision") : "");
    setAttribute(this.button, "title", robot.detail);
  }
}

function updateRows(ports: Ports, list: HTMLElement, rows: Map<string, RobotRow>, statuses: RobotStatus[]): void {
  const names = new Set(statuses.map(({ name }) => name));
  const avatars = new Set(
    robotsOf(ports.state.get().scene).flatMap(({ name, isAvatar }) => (isAvatar ? [name] : [])),
  );
  const stations = stationsOf(ports);
  for (const [name, row] of [...rows]) {
    if (names.has(name)) continue;
    row.item.remove();
    rows.delete(name);
  }
  for (const status of statuses) {
    let row = rows.get(status.name);
    if (!row) {
      row = new RobotRow(ports, status.name);
      rows.set(status.name, row);
      list.append(row.item);
    }
    const kind = avatars.has(status.name) ? "avatar" : stations.has(status.name) ? "station" : "robot";
    row.update(status, kind);
  }
}

function showWorld(ports: Ports, details: HTMLElement, scene: SceneDescription | null): void {
  const bodies = scene?.bodies.filter(({ isRobot, isAvatar }) => !isRobot && !isAvatar) ?? [];
  details.hidden = bodies.length === 0;
  details.replaceChildren(
    element("summary", {}, `World: ${count(bodies.length, "object")}`),
    element("ul", {}, ...bodies.map((body) => element("li", {}, objectEntry(ports, body)))),
  );
}

// While one edits, what can be moved can be chosen here.
function objectEntry(ports: Ports, { name, isFixed }: SceneBody): string | HTMLElement {
  const { editing } = ports.state.get();
  if (!editing || isFixed) return name;
  const entry = element(
    "button",
    { class: "button plain small", type: "button", "data-object": name, onclick: () => ports.robots.pick(name) },
    name,
  );
  entry.setAttribute("aria-pressed", String(editing.chosen === name));
  return entry;
}
