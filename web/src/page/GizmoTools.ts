// The buttons that select the mode of the gizmo: move or rotate, freely or in steps.
import type { App } from "../app/App";
import type { GizmoTool } from "../state/editing";
import { checkField, choiceField } from "../ui/fields";
import { element } from "../ui/element";

const DISTANCES = [0.01, 0.05, 0.1, 0.25, 0.5, 1]; // m
const ANGLES = [1, 5, 15, 30, 45, 90]; // degrees

export function createGizmoTools(app: App): HTMLElement {
  const modes = (["move", "turn"] as const).map((mode) => modeButton(app, mode));
  const snaps = checkField("Snap", (value) => app.edits.setTool({ snaps: value }));
  const distance = choiceField("Distance", (value) => app.edits.setTool({ distance: Number(value) }));
  distance.offer(DISTANCES.map((value) => ({ value: String(value), label: `${value} m` })));
  const angle = choiceField("Angle", (value) => app.edits.setTool({ angleDeg: Number(value) }));
  angle.offer(ANGLES.map((value) => ({ value: String(value), label: `${value}°` })));
  app.store.watch(
    ({ editing }) => editing?.tool,
    (tool) => {
      if (!tool) return;
      snaps.show(tool.snaps);
      for (const { element } of [distance, angle]) element.hidden = !tool.snaps;
      distance.show(String(tool.distance));
      angle.show(String(tool.angleDeg));
    },
  );
  return element(
    "fieldset",
    { class: "gizmo-tools" },
    element("legend", {}, "Handles"),
    element("div", { class: "field-pair" }, ...modes, snaps.element, distance.element, angle.element),
  );
}

function modeButton(app: App, mode: GizmoTool["mode"]): HTMLButtonElement {
  const label = mode === "move" ? "Move" : "Turn";
  const button = element(
    "button",
    { class: "button", type: "button", title: `${label} the selection by its handles`, onclick: () => app.edits.setTool({ mode }) },
    label,
  );
  app.store.watch(
    ({ editing }) => editing?.tool.mode,
    (current) => button.setAttribute("aria-pressed", String(current === mode)),
  );
  return button;
}
