// Shows the selected robot: its pose, its behaviour and its sensors.
import type { RobotStatus } from "../../api/status";
import type { RobotPose } from "../../state/State";
import { agentLabel } from "../../state/actions";
import { element, setText } from "../../ui/element";
import { formatDistance, formatNumber } from "../../ui/format";
import { icon } from "../../ui/icons";
import { shallowEqual } from "../../state/Store";
import type { PanelPorts } from "../contract/ports";
import { hasJoints, jointsButton } from "../control/jointsButton";
import { plotButton } from "./plotButton";
import { createOutput } from "./Output";
import { createSensorList } from "./SensorList";
import { createWhy } from "./Why";

type Ports = Pick<PanelPorts, "state" | "topics" | "server" | "control" | "robots" | "cameras" | "plots" | "notices">;

const ROWS = [
  "Position",
  "Heading",
  "Speed",
  "Turning",
  "Behaviour",
  "Agent",
  "Driven",
  "Collisions",
  "Model",
] as const;
type Row = (typeof ROWS)[number];

// The values of each row that can be plotted.
const PLOTTED: Partial<Record<Row, string[]>> = {
  Position: ["x", "y"],
  Heading: ["yaw"],
  Speed: ["speed"],
  Turning: ["turn_rate"],
  Driven: ["distance"],
  Collisions: ["collisions"],
};

const DEGREES = 180 / Math.PI;

export function createInspector(ports: Ports): HTMLElement {
  const title = element("h2", {});
  const values = new Map<Row, HTMLElement>(ROWS.map((row) => [row, element("span", {})]));
  const list = element("dl", { class: "inspector-rows" });
  for (const [row, value] of values) {
    list.append(element("dt", {}, row), element("dd", {}, value, plotOf(ports, row)));
  }
  const detail = element("p", { class: "detail" });
  const why = createWhy(ports);
  const output = createOutput(ports);
  const joints = jointsButton(ports);
  const actions = copyButtons(ports);
  actions.prepend(joints);
  const panel = element(
    "section",
    { class: "card inspector", "aria-label": "Selected robot" },
    element("div", { class: "card-head" }, title, closeButton(ports)),
    why,
    list,
    actions,
    detail,
    output,
    createSensorList(ports),
  );
  // The output of a dead behaviour is placed directly below the reason of its death.
  const placeOutput = (isDead: boolean) => {
    const before = isDead ? why : detail;
    if (before.nextElementSibling !== output) before.after(output);
  };
  const set = (row: Row, text: string) => setText(values.get(row)!, text);

  ports.state.watch(
    ({ selection, setUp }) => (setUp ? null : selection),
    (selection) => {
      panel.hidden = selection === null;
      setText(title, selection ?? "");
    },
  );
  ports.state.watch(
    ({ selection, scene, replay }) => replay === null && hasJoints(scene?.bodies.find(({ name }) => name === selection)),
    (isShown) => (joints.hidden = !isShown),
  );
  ports.state.watch(
    ({ selectedPose }) => selectedPose,
    (pose) => showPose(pose, set),
  );
  ports.state.watch(
    ({ selection, status, driven }) => ({ robot: status?.robots.find(({ name }) => name === selection) ?? null, isDriven: driven === selection }),
    ({ robot, isDriven }) => {
      if (robot) showStatus(robot, isDriven, set);
      setText(detail, robot?.detail ?? "");
      placeOutput(robot?.agentPhase === "dead");
    },
    shallowEqual,
  );
  return panel;
}

function plotOf({ state, plots }: Ports, row: Row): HTMLElement | null {
  const keys = PLOTTED[row];
  if (!keys) return null;
  return plotButton(`Plot ${row.toLowerCase()}`, () => {
    const { selection } = state.get();
    if (selection !== null) for (const key of keys) plots.add({ kind: "robot", robot: selection }, key);
  });
}

function showPose(pose: RobotPose | null, set: (row: Row, text: string) => void): void {
  const metres = (value: number) => formatNumber(value, 2);
  set("Position", pose ? `${metres(pose.x)}, ${metres(pose.y)}, ${metres(pose.z)} m` : "…");
  set("Heading", pose ? `${formatNumber(pose.yaw * DEGREES, 1)}°` : "…");
  set("Speed", pose ? `${formatNumber(pose.speed, 2)} m/s` : "…");
  set("Turning", pose ? `${formatNumber(pose.turnRate * DEGREES, 1)}°/s` : "…");
}

function showStatus(robot: RobotStatus, isDriven: boolean, set: (row: Row, text: string) => void): void {
  set("Behaviour", robot.behaviour || "none");
  set("Agent", isDriven ? "driven from this page" : agentLabel(robot));
  set("Driven", formatDistance(robot.distance));
  set("Collisions", String(robot.collisions));
  set("Model", robot.model || "…");
}

// Returns the pose in the format of SDFormat's <pose>: metres and radians.
export function poseText({ x, y, z, roll, pitch, yaw }: RobotPose): string {
  return [x, y, z, roll, pitch, yaw].map((value) => formatNumber(value, 4)).join(" ");
}

// Returns the pose in the format of gsv's option --robot.
export function startText({ x, y, yaw }: RobotPose): string {
  return [x, y, yaw].map((value) => formatNumber(value, 4)).join(",");
}

function copyButtons({ state, notices }: Ports): HTMLElement {
  const button = (label: string, title: string, textOf: (pose: RobotPose) => string) =>
    element(
      "button",
      {
        class: "button small",
        type: "button",
        title,
        onclick: () => {
          const pose = state.get().selectedPose;
          if (pose) void notices.copy(textOf(pose), "Pose copied.");
        },
      },
      icon("copy"),
      label,
    );
  return element(
    "div",
    { class: "inspector-actions" },
    button("Copy pose", "x y z roll pitch yaw, in metres and radians, as in a <pose>", poseText),
    button("Copy as --robot", "x,y,yaw, in the form of gsv run --robot MODEL@x,y,yaw", startText),
  );
}

function closeButton({ robots }: Ports): HTMLElement {
  return element(
    "button",
    {
      class: "button plain small",
      type: "button",
      "aria-label": "Deselect",
      title: "Deselect (Esc)",
      onclick: () => robots.select(null),
    },
    icon("close"),
  );
}
