// The list at the side: the robots with their states, and the other bodies of the world.
import type { RobotStatus } from "../../api/status";
import type { SceneBody, SceneDescription } from "../../api/scene";
import { robotsOf } from "../../api/scene";
import { shownPart } from "../../state/parts";
import type { State } from "../../state/State";
import { shallowEqual } from "../../state/Store";
import { element, setText } from "../../ui/element";
import { count } from "../../ui/format";
import type { PanelPorts } from "../contract/ports";
import { RobotList } from "./RobotList";
import { createRobotTools } from "./RobotTools";

type Ports = Pick<PanelPorts, "state" | "robots">;

// `pages`: links to the other pages.
export function createSceneTree(ports: Ports, pages: HTMLElement): HTMLElement {
  const heading = element("h2", {}, "Robots");
  const robots = new RobotList(ports);
  const empty = element(
    "div",
    { class: "hint" },
    element("p", {}, "No robots yet. Start the simulation with robots:"),
    element("code", {}, "gsv run WORLD --robot MODEL@x,y --behaviour wander"),
  );
  const world = element("details", { class: "world-tree" });
  const tree = element("nav", { class: "sidebar", "aria-label": "Scene" }, heading, createRobotTools(ports), robots.element, empty, world, pages);

  ports.state.watch(
    ({ setUp }) => setUp !== null,
    (hidden) => (tree.hidden = hidden),
  );
  ports.state.watch(
    ({ status, health, robotFilter, scene, driven }) => ({ robots: status?.robots, health, robotFilter, scene, driven }),
    () => robots.update(),
    shallowEqual,
  );
  ports.state.watch(
    ({ status, scene }) => ({ robots: status?.robots, scene }),
    ({ robots: statuses, scene }) => setText(heading, headingFor(statuses ?? [], stationsOf(scene))),
    shallowEqual,
  );
  ports.state.watch(
    ({ status }) => status === null || status.robots.length > 0,
    (hidden) => {
      empty.hidden = hidden;
      robots.element.hidden = !hidden;
    },
  );
  ports.state.watch(
    ({ selection }) => selection,
    (selection) => robots.showSelection(selection),
  );
  ports.state.watch(
    ({ editing }) => editing?.more ?? null,
    () => robots.update(),
  );
  ports.state.watch(
    ({ scene }) => scene,
    (scene) => showWorld(ports, world, scene),
  );
  // In edit mode, fixed objects cannot be selected.
  ports.state.watch(
    ({ editing }) => editing !== null,
    () => showWorld(ports, world, ports.state.get().scene),
  );
  ports.state.watch(chosenObjects, (chosen) => markObjects(world, chosen), shallowEqual);
  return tree;
}

function stationsOf(scene: SceneDescription | null): Set<string> {
  return new Set(robotsOf(scene).flatMap(({ name, isStation }) => (isStation ? [name] : [])));
}

// Returns a text such as "3 robots", "1 robot, 2 sensor stations", or "Robots".
function headingFor(statuses: RobotStatus[], stations: Set<string>): string {
  const fixed = statuses.filter(({ name }) => stations.has(name)).length;
  const robots = statuses.length - fixed;
  const parts = [robots > 0 ? count(robots, "robot") : "", fixed > 0 ? count(fixed, "sensor station") : ""];
  return parts.filter((part) => part !== "").join(", ") || "Robots";
}

function showWorld(ports: Ports, details: HTMLElement, scene: SceneDescription | null): void {
  const bodies = scene?.bodies.filter(({ isRobot, isAvatar }) => !isRobot && !isAvatar) ?? [];
  details.hidden = bodies.length === 0;
  details.replaceChildren(
    element("summary", {}, `World: ${count(bodies.length, "object")}`),
    element("ul", {}, ...bodies.map((body) => element("li", {}, objectEntry(ports, body)))),
  );
  markObjects(details, chosenObjects(ports.state.get()));
}

function chosenObjects({ editing, part, selection }: State): string[] {
  const shown = shownPart({ editing, part, selection });
  return [...(shown ? [shown.body] : []), ...(editing?.more ?? [])];
}

function markObjects(list: HTMLElement, chosen: readonly string[]): void {
  for (const entry of list.querySelectorAll<HTMLElement>("[data-object]")) {
    entry.setAttribute("aria-pressed", String(chosen.includes(entry.dataset.object!)));
  }
}

function objectEntry(ports: Ports, { name, isFixed }: SceneBody): string | HTMLElement {
  const { editing } = ports.state.get();
  if (editing && isFixed) return name;
  return element(
    "button",
    {
      class: "button plain small",
      type: "button",
      "data-object": name,
      "aria-pressed": "false",
      onclick: (event: MouseEvent) => ports.robots.pick(name, event.shiftKey || event.ctrlKey || event.metaKey),
    },
    name,
  );}
