// The sheet of keys and gestures.
import type { App } from "../app/App";
import { PANELS } from "../panels/registry";
import { OVERLAYS } from "../state/overlays";
import { element } from "../ui/element";
import { checkField } from "../ui/fields";
import { icon } from "../ui/icons";

type Line = [keys: string[], meaning: string];

const KEYS: [heading: string, lines: Line[]][] = [
  [
    "Run",
    [
      [["Space"], "Start, pause, resume"],
      [["N"], "One step while paused (recording: one pose on)"],
      [["W", "A", "S", "D"], "Drive the avatar (or the arrow keys; Q and E sideways, Shift faster)"],
    ],
  ],
  [
    "Look",
    [
      [["T"], "Top view"],
      [["R"], "Reset view"],
      [["F"], "Follow the selected robot"],
      [["C"], "Chase it: from behind, turning with it"],
      [["V"], "Look out of its eye"],
      [["O"], "Turn the view freely again"],
      [["Esc"], "Deselect, close"],
      [["?"], "This sheet"],
    ],
  ],
  [
    "Show",
    [
      ...OVERLAYS.map(({ key, label, hint }): Line => [[key], `${label}: ${lowered(hint)}`]),
      ...PANELS.flatMap(({ key, hint }): Line[] => (key ? [[[key], hint]] : [])),
    ],
  ],
  [
    "Take along",
    [
      [["L"], "Copy a link to this view (recording: at this instant)"],
      [["X"], "Save a picture"],
      [["M"], "Film the view, until the next press"],
    ],
  ],
  [
    "Edit",
    [
      [["Ctrl Z"], "Take back the last change (Ctrl Shift Z: do it again)"],
      [["Delete"], "Remove the selected robot or object"],
      [["[", "]"], "Turn it by 15° to the left or right"],
    ],
  ],
  [
    "Recording",
    [
      [["←", "→"], "One pose back or on (Shift: ten)"],
      [["Home", "End"], "To the start or the end"],
      [[",", "."], "To the last or next event"],
    ],
  ],
];

const GESTURES: [gesture: string, meaning: string][] = [
  ["Drag", "Turn the view"],
  ["Right drag, or two fingers", "Move the view"],
  ["Wheel, or pinch", "Zoom to the pointer"],
  ["Click a robot", "Select it"],
  ["Drag a robot or object, while editing", "Move it; its arrow's tip turns it"],
  ["Click the floor, while editing", "Put there what is selected"],
];

export function createHelpSheet(app: App): HTMLElement {
  const keys = KEYS.map(([heading, lines]) => section(heading, lines.map(keyLine)));
  const gestures = GESTURES.map(([gesture, meaning]) => line([gesture], meaning));
  const close = element(
    "button",
    { class: "button plain small", type: "button", "aria-label": "Close help", autofocus: true },
    icon("close"),
  );
  const documentation = element(
    "a",
    { class: "button", href: "docs/", target: "_blank", rel: "noopener" },
    "Open documentation",
  );
  const sheet = element(
    "dialog",
    { class: "card help", "aria-label": "Help" },
    element("div", { class: "card-head" }, element("h2", {}, "Keys and gestures"), documentation, close),
    singleKeysSetting(app),
    element("div", { class: "help-sections" }, ...keys, section("Mouse and touch", gestures)),
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

// Keys with Ctrl are the browser's kind of shortcut, and nobody says an arrow: they stay.
function singleKeysSetting(app: App): HTMLElement {
  const field = checkField("Single-key shortcuts", (isOn) => app.useSingleKeys(isOn));
  app.store.watch(
    ({ singleKeys }) => singleKeys,
    (isOn) => field.show(isOn),
  );
  return element(
    "div",
    { class: "help-setting" },
    field.element,
    element(
      "p",
      { class: "dim" },
      "Turn them off if keys act by accident, for example with speech input. Arrow keys, Esc, Delete, Home, End " +
        "and keys with Ctrl still work. This browser remembers the choice.",
    ),
  );
}

function lowered(text: string): string {
  return text.charAt(0).toLowerCase() + text.slice(1);
}

function section(heading: string, lines: Node[][]): HTMLElement {
  return element(
    "section",
    {},
    heading !== "" && element("h3", {}, heading),
    element("dl", {}, ...lines.flat()),
  );
}

function keyLine([names, meaning]: Line): Node[] {
  return line(
    names.map((name) => element("kbd", {}, name)),
    meaning,
  );
}

function line(terms: (string | Node)[], meaning: string): Node[] {
  return [element("dt", {}, ...terms), element("dd", {}, meaning)];
}
