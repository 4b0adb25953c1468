// The commands of the command palette that are also in the toolbar, the panel Edit, the timeline or
// the menus. A command whose name ends with "…" opens the menu in which the user continues.
import type { App } from "../app/App";
import { canNote } from "../app/NotesControl";
import { SPEEDS } from "../app/ReplayControl";
import { PANELS } from "../panels/registry";
import { canAct, canEdit, isAllowed, mainAction } from "../state/actions";
import { EDIT_PANEL, chosenOf } from "../state/editing";
import { POINT_COLOURS, TRAIL_COLOURS } from "../state/overlays";
import { asker, mayAct } from "../state/people";
import { spanOf } from "../state/timeline";
import { FACTORS } from "./PaceMenu";
import { offeredPages } from "./pageLinks";
import { controlWish } from "./PeopleMenu";

// An entry of the command palette.
export interface Command {
  group: string; // "Panel", "Robot"
  label: string;
  key?: string; // the keyboard shortcut of the command
  run(): void;
}

const TURN = Math.PI / 12;

class Commands {
  readonly all: Command[] = [];

  constructor(private readonly group: string) {}

  add(isPossible: boolean, label: string, run: () => unknown, key?: string): void {
    if (isPossible) this.all.push({ group: this.group, label, run: () => void run(), ...(key && { key }) });
  }
}

export function controlCommands(app: App): Command[] {
  const groups = [runCommands, editCommands, playbackCommands, viewerCommands, lookCommands, arrangeCommands, pageCommands];
  return groups.flatMap((commands) => commands(app));
}

function runCommands(app: App): Command[] {
  const state = app.store.get();
  const { status, replay, recording, connection, people, abilities, setUp } = state;
  const commands = new Commands("Run");
  const may = canAct(state);
  const main = mainAction(status?.phase);
  const can = (action: Parameters<typeof isAllowed>[1]) => replay === null && may && isAllowed(status?.phase, action);
  commands.add(replay !== null, "Play or pause the recording", () => app.startPauseOrResume(), "Space");
  commands.add(can(main), `${main.charAt(0).toUpperCase()}${main.slice(1)}`, () => app.startPauseOrResume(), "Space");
  commands.add(can("step"), "Take one step", () => app.stepOnce(), "N");
  commands.add(can("step"), "Take several steps…", () => app.openMenu("pace"));
  commands.add(can("stop"), "Stop", () => app.act("stop"));
  commands.add(can("reset"), "Reset", () => app.act("reset"));
  if (replay === null && may && status?.mode === "real_time") {
    for (const factor of FACTORS) commands.add(factor !== status.targetFactor, `Set the speed to ${factor}×`, () => app.setFactor(factor));
    commands.add(true, "Set another speed…", () => app.openMenu("pace"));
  }
  const canRecord = replay === null && recording !== null && connection.phase === "open" && mayAct(people);
  commands.add(canRecord, recording?.isOn ? "End the recording" : "Record", () => app.records.press());
  commands.add(canEdit(state), state.editing ? "End editing" : "Edit", () => app.edits.toggle());
  commands.add(abilities.creates && setUp === null, "New simulation", () => app.setUp.open());
  for (const { name } of state.simulations ?? []) {
    commands.add(setUp === null && name !== state.simulation, `Show the simulation ${name}`, () => app.session.join(name));
  }
  return commands.all;
}

function editCommands(app: App): Command[] {
  const state = app.store.get();
  const { editing, setUp, replay, simulation, abilities, placing } = state;
  const { editActions } = app;
  const commands = new Commands("Edit");
  const canSave = replay === null && abilities.creates && simulation !== null;
  commands.add(canSave, "Save world", () => editActions.saveWorld(false));
  commands.add(canSave, "Save scenario", () => editActions.saveWorld(true));
  if (!editing && !setUp) return commands.all;
  const isChosen = chosenOf(state) !== null;
  commands.add(setUp !== null || (editing!.undo.length > 0 && !editing!.isBusy), "Undo", () => editActions.undo(), "Ctrl Z");
  commands.add(setUp !== null || (editing!.redo.length > 0 && !editing!.isBusy), "Redo", () => editActions.redo(), "Ctrl Y");
  commands.add(isChosen, placing ? "End placing" : "Place", () => app.pointing.setPlacing(!placing));
  commands.add(isChosen, "Remove", () => editActions.remove(), "Delete");
  if (!editing) return commands.all;
  commands.add(isChosen, "Copy", () => editActions.copy(), "Ctrl C");
  commands.add(app.edits.hasCopies, "Paste", () => editActions.paste(), "Ctrl V");
  commands.add(isChosen, "Duplicate", () => editActions.duplicate(), "Ctrl D");
  commands.add(isChosen, "Turn left", () => editActions.turn(TURN), "[");
  commands.add(isChosen, "Turn right", () => editActions.turn(-TURN), "]");
  const addFrom = (menu: "shape" | "model") => {
    app.panels.open(EDIT_PANEL);
    app.openMenu(menu);
  };
  commands.add(true, "Add a shape…", () => addFrom("shape"));
  commands.add(true, "Add a robot or an object…", () => addFrom("model"));
  const { mode, snaps } = editing.tool;
  commands.add(mode !== "move", "Move by the handles", () => app.edits.setTool({ mode: "move" }));
  commands.add(mode !== "turn", "Turn by the handles", () => app.edits.setTool({ mode: "turn" }));
  commands.add(true, snaps ? "Snap: off" : "Snap: on", () => app.edits.setTool({ snaps: !snaps }));
  return commands.all;
}

function playbackCommands(app: App): Command[] {
  const state = app.store.get();
  const { replay, kept, time, connection, comparison, inPast, abilities, setUp } = state;
  const commands = new Commands("Recording");
  if (setUp !== null) return [];
  const canPlay = replay !== null && connection.phase === "open";
  commands.add(canPlay, "Go to the start", () => app.replay.toStart(), "Home");
  commands.add(canPlay, "Previous recorded instant", () => app.replay.step(-1), "←");
  commands.add(canPlay, "Next recorded instant", () => app.replay.step(1), "→");
  commands.add(canPlay, "Go to the end", () => app.replay.toEnd(), "End");
  commands.add(canPlay, "Previous event", () => app.replay.toEvent(-1), ",");
  commands.add(canPlay, "Next event", () => app.replay.toEvent(1), ".");
  for (const speed of SPEEDS) commands.add(canPlay && replay?.speed !== speed, `Set the speed to ${speed}×`, () => app.replay.setSpeed(speed));
  commands.add(canPlay, replay?.loop ? "Loop: off" : "Loop: on", () => app.replay.toggleLoop());
  commands.add(spanOf(replay, kept, time) !== null, "Go to time…", () => app.openMenu("time"));
  commands.add(inPast, "Live", () => app.past.goLive());
  commands.add(spanOf(replay, kept, time) !== null && canNote(state), "Notes…", () => app.openMenu("notes"));
  commands.add(replay !== null && (abilities.recordings || abilities.recording !== ""), "Compare with…", () => app.openMenu("compare"));
  commands.add(comparison !== null, "Stop comparing", () => app.compare.end());
  const difference = comparison?.difference?.time;
  commands.add(difference != null, "Go to the first difference", () => difference != null && app.past.lookAt(difference));
  return commands.all;
}

function viewerCommands(app: App): Command[] {
  const { people } = app.store.get();
  const commands = new Commands("Viewers");
  const wish = controlWish(people);
  if (wish) commands.add(true, wish.label, () => app.people.want(wish.wants));
  commands.add(asker(people) !== null, "Give control", () => app.people.answer(true));
  commands.add(asker(people) !== null, "Keep control", () => app.people.answer(false));
  commands.add(people.viewers.length > 0, "Show the viewers…", () => app.openMenu("viewers"));
  return commands.all;
}

function lookCommands(app: App): Command[] {
  const { overlayColours, drawnBy, whyNotBrowser } = app.store.get();
  const colours = new Commands("Colour");
  for (const [points, name] of Object.entries(POINT_COLOURS) as [keyof typeof POINT_COLOURS, string][]) {
    colours.add(points !== overlayColours.points, `Colour points by ${name}`, () => app.colourOverlays({ points }));
  }
  for (const [trails, name] of Object.entries(TRAIL_COLOURS) as [keyof typeof TRAIL_COLOURS, string][]) {
    colours.add(trails !== overlayColours.trails, `Colour trails by ${name}`, () => app.colourOverlays({ trails }));
  }
  const drawing = new Commands("Drawing");
  drawing.add(drawnBy === "browser", "Let the server draw the view", () => app.drawBy("server"));
  drawing.add(drawnBy === "server" && whyNotBrowser === "", "Let this browser draw the view", () => app.drawBy("browser"));
  return [...colours.all, ...drawing.all];
}

function arrangeCommands(app: App): Command[] {
  const { layouts, openPanels } = app.store.get();
  const commands = new Commands("Arrange");
  commands.add(true, "Save the layout…", () => app.openMenu("layout"));
  commands.add(true, "Export layout", () => app.layouts.exportFile());
  commands.add(true, "Import layout…", () => app.openMenu("layout"));
  for (const { name } of layouts) commands.add(true, `Delete layout ${name}`, () => app.layouts.remove(name));
  for (const { id, title } of PANELS.filter(({ id }) => openPanels.includes(id))) {
    commands.add(true, `Close ${title.toLowerCase()}`, () => app.panels.close(id));
  }
  return commands.all;
}

function pageCommands(app: App): Command[] {
  const state = app.store.get();
  const pages = new Commands("Page");
  for (const { label, href } of offeredPages(state)) pages.add(true, label, () => location.assign(href));
  const help = new Commands("Help");
  help.add(true, "Keys and gestures", () => app.openHelp(true), "?");
  help.add(true, "Open documentation", () => open("docs/", "_blank", "noopener"));
  help.add(true, state.singleKeys ? "Single-key shortcuts: off" : "Single-key shortcuts: on", () => app.useSingleKeys(!state.singleKeys));
  return [...pages.all, ...help.all];
}
