// The selected robot: where it is, what it does, what it senses with.
import type { App } from "../app/App";
import type { RobotStatus } from "../api/status";
import type { RobotPose } from "../state/State";
import { element, setText } from "../ui/element";
import { formatDistance, formatNumber } from "../ui/format";
import { icon } from "../ui/icons";
import { agentLabel } from "./SceneTree";

const ROWS = ["Position", "Heading", "Speed", "Behaviour", "Agent", "Driven", "Collisions", "Model"] as const;
type Row = (typeof ROWS)[number];

export function createInspector(app: App): HTMLElement {
  const title = element("h2", {});
  const values = new Map<Row, HTMLElement>(ROWS.map((row) => [row, element("dd", {})]));
  const list = element("dl", {});
  for (const [row, value] of values) list.append(element("dt", {}, row), value);
  const sensors = element("ul", { class: "sensors", "aria-label": "Sensors" });
  const detail = element("p", { class: "detail" });
  const panel = element(
    "section",
    { class: "card inspector", "aria-label": "Selected robot" },
    element("div", { class: "card-head" }, title, copyButton(app), closeButton(app)),
    list,
    detail,
    sensors,
  );
  const set = (row: Row, text: string) => setText(values.get(row)!, text);

  app.store.watch(
    ({ selection }) => selection,
    (selection) => {
      panel.hidden = selection === null;
      setText(title, selection ?? "");
    },
  );
  app.store.watch(
    ({ selectedPose }) => selectedPose,
    (pose) => showPose(pose, set),
  );
  app.store.watch(
    ({ selection, status }) => status?.robots.find(({ name }) => name === selection) ?? null,
    (robot) => {
      if (robot) showStatus(robot, set);
      setText(detail, robot?.detail ?? "");
    },
  );
  app.store.watch(
    ({ selection, scene }) => scene?.bodies.find(({ name }) => name === selection) ?? null,
    (body) => {
      const items = (body?.sensors ?? []).map(({ name, type }) =>
        element("li", {}, element("span", {}, name), element("span", { class: "dim" }, type)),
      );
      sensors.replaceChildren(...items);
    },
  );
  return panel;
}

function showPose(pose: RobotPose | null, set: (row: Row, text: string) => void): void {
  const metres = (value: number) => formatNumber(value, 2);
  set("Position", pose ? `${metres(pose.x)}, ${metres(pose.y)}, ${metres(pose.z)} m` : "…");
  set("Heading", pose ? `${formatNumber((pose.yaw * 180) / Math.PI, 1)}°` : "…");
  set("Speed", pose ? `${formatNumber(pose.speed, 2)} m/s` : "…");
}

function showStatus(robot: RobotStatus, set: (row: Row, text: string) => void): void {
  set("Behaviour", robot.behaviour || "none");
  set("Agent", agentLabel(robot));
  set("Driven", formatDistance(robot.distance));
  set("Collisions", String(robot.collisions));
  set("Model", robot.model || "…");
}

// The pose as gsv's --robot option takes it: x,y,yaw.
function copyButton(app: App): HTMLElement {
  const copy = () => {
    const pose = app.store.get().selectedPose;
    if (!pose) return;
    const text = [pose.x, pose.y, pose.yaw].map((value) => formatNumber(value, 4)).join(",");
    void navigator.clipboard?.writeText(text);
  };
  return element(
    "button",
    {
      class: "button plain small",
      type: "button",
      "aria-label": "Copy pose",
      title: "Copy pose as x,y,yaw",
      onclick: copy,
    },
    icon("copy"),
  );
}

function closeButton(app: App): HTMLElement {
  return element(
    "button",
    {
      class: "button plain small",
      type: "button",
      "aria-label": "Deselect",
      title: "Deselect (Esc)",
      onclick: () => app.select(null),
    },
    icon("close"),
  );
}
