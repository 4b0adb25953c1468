// The sheet with keys and gestures.
import type { App } from "../app/App";
import { PANELS } from "../panels/registry";
import { OVERLAYS } from "../state/overlays";
import { keyOf } from "../state/shortcuts";
import { element, setText } from "../ui/element";
import { checkField } from "../ui/fields";
import { icon } from "../ui/icons";

const FIXED_KEYS = new Set(["[", "]", ",", "."]); // keys of editing and of recordings, which cannot be changed

type Line = [keys: string[], meaning: string];

const KEYS: [heading: string, lines: Line[]][] = [
  [
    "Run",
    [
      [["Space"], "Start, pause or resume"],
      [["N"], "Take one step, before the start or while paused (in a recording: go to the next recorded instant)"],
      [["W", "A", "S", "D"], "Drive the avatar, a person whom you control. The arrow keys also work. Q and E move sideways; with Shift, the avatar is faster"],
    ],
  ],
  [
    "Look",
    [
      [["T"], "Top view"],
      [["R"], "Reset view"],
      [["F"], "Follow the selected robot"],
      [["C"], "Chase the selected robot: stay behind it"],
      [["V"], "View from the robot"],
      [["O"], "Free view"],
      [["Esc"], "Deselect or close"],
      [["Ctrl K"], "Find a command, robot, topic or panel"],
      [["?"], "Show this help"],
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
    "Copy and save",
    [
      [["L"], "Copy a link to this view; in a recording, the link includes the time"],
      [["X"], "Save an image"],
      [["M"], "Start or stop recording a video of the view"],
    ],
  ],
  [
    "Edit",
    [
      [["Ctrl Z", "Ctrl Y"], "Undo or redo the last change"],
      [["Ctrl C", "Ctrl V"], "Copy or paste the selection"],
      [["Ctrl D"], "Duplicate the selection"],
      [["Delete"], "Remove the selected robot or object"],
      [["[", "]"], "Turn the selected robots and objects by 15° to the left or right"],
    ],
  ],
  [
    "Recording",
    [
      [["←", "→"], "Previous or next recorded instant (Shift: ten instants)"],
      [["Home", "End"], "Go to the start or the end"],
      [[",", "."], "Go to the previous or next event"],
    ],
  ],
];

const GESTURES: [gesture: string, meaning: string][] = [
  ["Drag", "Turn the view"],
  ["Right-drag, or drag with two fingers", "Move the view"],
  ["Mouse wheel, or pinch", "Zoom at the pointer"],
  ["Click a robot", "Select the robot"],
  ["Drag a robot or object, while editing", "Move it over the floor. Drag an arrow to move it along an axis, or a ring to turn it about an axis"],
  ["Press Place, then click the floor, while editing", "Place the selected robot or object there"],
  ["Shift and click, or Shift and drag, while editing", "Add to the selection, or select all in a rectangle"],
];

export function createHelpSheet(app: App): HTMLElement {
  const keys = KEYS.map(([heading, lines]) => section(heading, lines.map((each) => keyLine(app, each))));
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
    element("div", { class: "help-sections" }, ...keys, section("Mouse and touch", gestures, "gestures")),
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

// The setting that turns single keys off. Keys with Ctrl and arrow keys still work, because speech
// input does not produce them by accident.
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
      "To change a key, click it in the list, then press the new key. Turn single-key shortcuts off if keys are pressed by accident, for example with speech input. Arrow keys, Esc, " +
        "Delete, Home, End and keys with Ctrl still work then. This browser remembers the choice.",
    ),
  );
}

function lowered(text: string): string {
  return text.charAt(0).toLowerCase() + text.slice(1);
}

function section(heading: string, lines: Node[][], kind = "keys"): HTMLElement {
  return element(
    "section",
    { class: kind },
    heading !== "" && element("h3", {}, heading),
    element("dl", {}, ...lines.flat()),
  );
}

function keyLine(app: App, [names, meaning]: Line): Node[] {
  const isChangeable = names.length === 1 && [...names[0]!].length === 1 && !FIXED_KEYS.has(names[0]!);
  return line(isChangeable ? [keyButton(app, names[0]!, meaning)] : names.map((name) => element("kbd", {}, name)), meaning);
}

// Returns a button that shows the key. If the user presses the button and then a key, this key is
// assigned. Esc cancels.
function keyButton(app: App, original: string, meaning: string): HTMLElement {
  const key = element("kbd");
  const button = element("button", { class: "key-button", type: "button" }, key);
  let isAsking = false;
  const show = () => {
    const name = isAsking ? "Press a key…" : keyOf(original, app.store.get().changedKeys).toUpperCase();
    setText(key, name);
    const label = isAsking ? "Press the new key, or Esc" : `${name}: change the key`;
    button.setAttribute("aria-label", label);
    button.title = `${label} (${meaning})`;
  };
  const ask = (value: boolean) => {
    isAsking = value;
    show();
  };
  button.addEventListener("click", () => ask(true));
  button.addEventListener("blur", () => ask(false));
  button.addEventListener("keydown", (event) => {
    if (!isAsking || event.key === "Tab") return;
    event.preventDefault();
    event.stopPropagation();
    const isPlain = [...event.key].length === 1 && event.key !== " " && !FIXED_KEYS.has(event.key) && !event.ctrlKey && !event.altKey && !event.metaKey;
    if (isPlain) app.changeKey(original, event.key);
    if (isPlain || event.key === "Escape") ask(false);
  });
  app.store.watch(({ changedKeys }) => changedKeys, show);
  return button;
}

function line(terms: (string | Node)[], meaning: string): Node[] {
  return [element("dt", {}, ...terms), element("dd", {}, meaning)];
}
