// The sheet of keys and gestures.
import type { App } from "../app/App";
import { element } from "../ui/element";
import { icon } from "../ui/icons";

const KEYS: [keys: string[], meaning: string][] = [
  [["Space"], "Start, pause, resume"],
  [["N"], "One step while paused (recording: one pose on)"],
  [["T"], "Top view"],
  [["R"], "Reset view"],
  [["F"], "Follow the selected robot"],
  [["Esc"], "Deselect, close"],
  [["W", "A", "S", "D"], "Drive the avatar (or the arrow keys; Q and E sideways, Shift faster)"],
  [["←", "→"], "Recording: one pose back or on (Shift: ten)"],
  [["Home", "End"], "Recording: to the start or the end"],
  [[",", "."], "Recording: to the last or next event"],
  [["?"], "This sheet"],
];

const GESTURES: [gesture: string, meaning: string][] = [
  ["Drag", "Turn the view"],
  ["Right drag, or two fingers", "Move the view"],
  ["Wheel, or pinch", "Zoom to the pointer"],
  ["Click a robot", "Select it"],
];

export function createHelpSheet(app: App): HTMLElement {
  const keys = KEYS.flatMap(([names, meaning]) => [
    element("dt", {}, ...names.map((name) => element("kbd", {}, name))),
    element("dd", {}, meaning),
  ]);
  const gestures = GESTURES.flatMap(([gesture, meaning]) => [
    element("dt", {}, gesture),
    element("dd", {}, meaning),
  ]);
  const close = element(
    "button",
    { class: "button plain small", type: "button", "aria-label": "Close help" },
    icon("close"),
  );
  const sheet = element(
    "dialog",
    { class: "card help", "aria-label": "Help" },
    element("div", { class: "card-head" }, element("h2", {}, "Keys and gestures"), close),
    element("dl", {}, ...keys, ...gestures),
  );
  close.addEventListener("click", () => sheet.close());
  sheet.addEventListener("close", () => app.openHelp(false));
  sheet.addEventListener("click", (event) => event.target === sheet && sheet.close());
  app.store.watch(
    ({ helpOpen }) => helpOpen,
    (open) => {
      if (open && !sheet.open) sheet.showModal();
      if (!open && sheet.open) sheet.close();
    },
  );
  return sheet;
}
