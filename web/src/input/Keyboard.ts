// The keys of the page. They have no effect while the user types or chooses from a list, or while a
// dialog is open. A focused button handles Space and Enter itself.
import type { App } from "../app/App";
import type { ReplayControl } from "../app/ReplayControl";
import { PANELS } from "../panels/registry";
import { OVERLAYS } from "../state/overlays";
import type { ChangedKeys } from "../state/shortcuts";
import { originalKey } from "../state/shortcuts";

// With Shift, an arrow key moves a recording by this number of recorded instants.
const MANY_POSES = 10;

// The part of a keyboard event that determines the command.
export interface Key {
  key: string;
  ctrlKey: boolean;
  altKey: boolean;
  metaKey: boolean;
  shiftKey?: boolean;
}

// The keys in lower case, with their actions.
const COMMANDS: Record<string, (app: App) => unknown> = {
  " ": (app) => app.startPauseOrResume(),
  n: (app) => app.stepOnce(),
  t: (app) => app.topView(),
  r: (app) => app.resetView(),
  f: (app) => app.toggleViewMode("follow"),
  c: (app) => app.toggleViewMode("chase"),
  v: (app) => app.toggleViewMode("eye"),
  o: (app) => app.orbit(),
  l: (app) => app.copyLink(),
  x: (app) => void app.savePicture(),
  m: (app) => app.film(),
  escape: (app) => app.escape(),
  "?": (app) => app.openHelp(true),
};
for (const { key, name } of OVERLAYS) COMMANDS[key.toLowerCase()] = (app) => app.toggle(name);
for (const { id, key, isAvailable } of PANELS) {
  if (key) COMMANDS[key.toLowerCase()] = (app) => isAvailable(app.store.get()) && app.panels.toggle(id);
}

export function commandOf({ key, ctrlKey, altKey, metaKey }: Key): ((app: App) => unknown) | null {
  if (ctrlKey || altKey || metaKey) return null;
  return Object.hasOwn(COMMANDS, key.toLowerCase()) ? COMMANDS[key.toLowerCase()]! : null;
}

const TURN = Math.PI / 12;

// The keys for undo and redo, and for rotating, copying and removing the selection.
export function editCommandOf({ key, ctrlKey, metaKey, altKey, shiftKey }: Key): ((app: App) => unknown) | null {
  if (altKey) return null;
  if (!ctrlKey && !metaKey) {
    if (key === "[") return (app) => app.editActions.turn(TURN);
    if (key === "]") return (app) => app.editActions.turn(-TURN);
    return key === "Delete" ? (app) => app.editActions.remove() : null;
  }
  const lower = key.toLowerCase();
  if (lower === "c") return (app) => app.editActions.copy();
  if (lower === "v") return (app) => app.editActions.paste();
  if (lower === "d") return (app) => app.editActions.duplicate();
  if (lower === "y" || (lower === "z" && shiftKey)) return (app) => app.editActions.redo();
  return lower === "z" ? (app) => app.editActions.undo() : null;
}

// The keys of recordings. They repeat while they are held.
export function replayCommandOf(event: Key): ((replay: ReplayControl) => void) | null {
  if (event.ctrlKey || event.altKey || event.metaKey) return null;
  const poses = event.shiftKey ? MANY_POSES : 1;
  switch (event.key) {
    case "ArrowLeft":
      return (replay) => replay.step(-poses);
    case "ArrowRight":
      return (replay) => replay.step(poses);
    case "Home":
      return (replay) => replay.toStart();
    case "End":
      return (replay) => replay.toEnd();
    case ",":
      return (replay) => replay.toEvent(-1);
    case ".":
      return (replay) => replay.toEvent(1);
    default:
      return null;
  }
}

// The user may have assigned another key to a command. If this key is pressed, returns the event as
// if the user had pressed the command's default key.
function asOriginal(event: Key, changed: ChangedKeys): Key {
  const { key, ctrlKey, altKey, metaKey } = event;
  return { key: isSingleKey(event) ? originalKey(key, changed) : key, ctrlKey, altKey, metaKey };
}

// Whether the key is a letter, digit, punctuation or Space, without Ctrl or Alt.
export function isSingleKey({ key, ctrlKey, altKey, metaKey }: Key): boolean {
  return [...key].length === 1 && !ctrlKey && !altKey && !metaKey;
}

// Whether the focused element handles keys itself. Two kinds of elements are exceptions: the
// timeline's slider, and a field of a dialog that was just closed and still has the focus for a
// moment.
export function isTyping(target: EventTarget | null): boolean {
  if (!(target instanceof Element)) return false;
  if (target.closest("dialog:not([open])")) return false;
  return target.closest("input:not([type=range]), textarea, select, [contenteditable], dialog") !== null;
}

// Whether the key is Ctrl K (Cmd K). This key always works, regardless of the focus.
export function isPaletteKey({ key, ctrlKey, metaKey, altKey, shiftKey }: Key): boolean {
  return key.toLowerCase() === "k" && (ctrlKey || metaKey) && !altKey && !shiftKey;
}

export function listenForKeys(app: App, page: Pick<Window, "addEventListener"> = window): void {
  page.addEventListener("keydown", (event) => {
    if (isPaletteKey(event)) {
      event.preventDefault();
      app.openPalette(!app.store.get().paletteOpen);
      return;
    }
    if (isTyping(event.target)) return;
    if (isSingleKey(event) && !app.store.get().singleKeys) return;
    const move = app.store.get().replay && replayCommandOf(event);
    if (move) {
      event.preventDefault();
      move(app.replay);
      return;
    }
    if (event.repeat) return;
    const { setUp, editing } = app.store.get();
    const command = ((setUp || editing) && editCommandOf(event)) || commandOf(asOriginal(event, app.store.get().changedKeys));
    if (!command) return;
    const isOnButton = event.target instanceof Element && event.target.closest("button, summary") !== null;
    if (isOnButton && event.key === " ") return;
    event.preventDefault();
    command(app);
  });
  // A button that was clicked with the mouse loses the focus. Otherwise Space would press the
  // button again instead of starting or pausing the simulation. Buttons in a dialog keep the focus:
  // keys are not commands there, and such a button may wait for a key.
  page.addEventListener("click", ({ detail, target }) => {
    if (detail > 0 && target instanceof Element && !target.closest("dialog")) target.closest("button")?.blur();
  });
}
