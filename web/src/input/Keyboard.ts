// The page's keys. They are quiet while somebody types or chooses from a list, and while a sheet is
// open; a focused button keeps Space and Enter for itself.
import type { App } from "../app/App";
import type { ReplayControl } from "../app/ReplayControl";

const MANY_POSES = 10; // of a step with Shift

export interface Key {
  key: string;
  ctrlKey: boolean;
  altKey: boolean;
  metaKey: boolean;
  shiftKey?: boolean;
}

export type Command =
  "start-pause-resume" | "step" | "top-view" | "reset-view" | "follow" | "deselect" | "help";

const COMMANDS: Record<string, Command> = {
  " ": "start-pause-resume",
  n: "step",
  t: "top-view",
  r: "reset-view",
  f: "follow",
  escape: "deselect",
  "?": "help",
};

export function commandOf({ key, ctrlKey, altKey, metaKey }: Key): Command | null {
  if (ctrlKey || altKey || metaKey) return null;
  return COMMANDS[key.toLowerCase()] ?? null;
}

// What only a recording's keys ask for: held, they repeat.
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

// Whether keys belong to the element that has the focus. The timeline's slider leaves them to the page.
export function isTyping(target: EventTarget | null): boolean {
  if (!(target instanceof Element)) return false;
  return target.closest("input:not([type=range]), textarea, select, [contenteditable], dialog") !== null;
}

export function listenForKeys(app: App): void {
  addEventListener("keydown", (event) => {
    if (isTyping(event.target)) return;
    const move = app.store.get().replay && replayCommandOf(event);
    if (move) {
      event.preventDefault();
      move(app.replay);
      return;
    }
    if (event.repeat) return;
    const command = commandOf(event);
    if (!command) return;
    const isOnButton = event.target instanceof Element && event.target.closest("button, summary") !== null;
    if (isOnButton && event.key === " ") return;
    event.preventDefault();
    run(app, command);
  });
}

function run(app: App, command: Command): void {
  switch (command) {
    case "start-pause-resume":
      return app.startPauseOrResume();
    case "step":
      return app.stepOnce();
    case "top-view":
      return app.topView();
    case "reset-view":
      return app.resetView();
    case "follow":
      return app.toggleFollowing();
    case "deselect":
      return app.select(null);
    case "help":
      return app.openHelp(true);
  }
}
