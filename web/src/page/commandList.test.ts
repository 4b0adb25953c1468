// @vitest-environment jsdom
// Compares the palette with the buttons of the toolbar, above the view, of the panel Edit, of the
// timeline and of the status bar, and with the keys of the help sheet. A new button or key needs a
// command.
import { expect, test, vi } from "vitest";
import type { App } from "../app/App";
import { FIRST_EDITING } from "../state/editing";
import type { State } from "../state/State";
import { body, scene } from "../scene/testScene";
import { commandsOf } from "./commandList";
import { createDrawerSwitch } from "./DrawerSwitch";
import { editPanel } from "./EditPanel";
import { createHelpSheet } from "./HelpSheet";
import { createControlQuestion } from "./PeopleMenu";
import { robotStatus, simulationStatus, testApp } from "./testApp";
import { createTimeline } from "./Timeline";
import { createToolbar } from "./Toolbar";
import { createViewTools } from "./ViewTools";

const STATUS = simulationStatus("paused", { robots: [robotStatus("pebble")] });
const PERSON = { number: 1, name: "Ada", simulation: "house", holds: false, asks: 0, passesIn: 0 };
const ADA = { ...PERSON, holds: true };
const BO = { ...PERSON, number: 2, name: "Bo", asks: 1, passesIn: 10 };
const REPLAY = { start: 0, end: 80, speed: 1, loop: false };
const ABILITIES = { creates: true, records: true, recordings: true, recording: "" };
const BASE: Partial<State> = { status: STATUS, scene: scene({ bodies: [body("pebble"), body("crate", { isRobot: false })] }), abilities: ABILITIES, drawnBy: "browser", isLive: true };

const STATES: Record<string, Partial<State>> = {
  "a paused simulation": { ...BASE, recording: { isOn: false, path: "", bytes: 0, droppedMessages: 0 }, kept: { start: 0, end: 60 }, people: { you: 1, viewers: [PERSON] } },
  "a running simulation": { ...BASE, status: simulationStatus("running"), people: { you: 1, viewers: [ADA, BO] }, drawnBy: "server" },
  editing: { ...BASE, openPanels: ["edit"], selection: "pebble", editing: { ...FIRST_EDITING, undo: ["move"], redo: ["turn"] }, layouts: [{ name: "mine", text: "view" }] },
  "a recording": { ...BASE, isLive: false, replay: REPLAY, abilities: { ...ABILITIES, recording: "run" } },
  "the past of a run": { ...BASE, replay: REPLAY, inPast: true },
  expectations: { ...BASE, expectations: [{ name: "stays", yaml: "", where: "", verdict: "pending", margin: null, time: 0, detail: "", bodies: [], places: [], boxes: [] }] },
  "a comparison": {
    ...BASE,
    replay: REPLAY,
    abilities: { ...ABILITIES, recording: "run" },
    comparison: { recording: "other", simulation: "house", scene: null, difference: { isEqual: false, time: 4, text: "" }, problem: "" },
  },
};

// Buttons whose command has another name in the palette. The value is this name. Null: the button
// needs no command of its own. It belongs to a menu that another command opens, or to the palette.
const OTHER_NAMES: Record<string, string | null> = {
  Step: "Take one step",
  "Speed and steps": "Set another speed…",
  "Take steps": "Take several steps…",
  Find: null,
  Robots: null, // opens the list of robots, whose entries are in the palette
  Layout: "Save the layout…",
  Save: null, // this button is in the menu of layouts and in the panel Edit
  "Import layout": "Import layout…",
  Share: null,
  Help: "Keys and gestures",
  Overlays: null,
  Viewers: "Show the viewers…",
  "Viewers 2": "Show the viewers…",
  Shape: "Add a shape…",
  "Add shape": "Add a shape…",
  "Draw wall": "Add a shape…",
  "Robot or object": "Add a robot or an object…",
  Add: "Add a robot or an object…",
  Move: "Move by the handles",
  Turn: "Turn by the handles",
  Loop: "Loop: on",
  Play: "Play or pause the recording",
  Notes: "Notes…",
  "Compare with…": "Compare with…",
  "drawn by the browser": "Let the server draw the view",
  "drawn by the server": "Let this browser draw the view",
};

function appIn(state: Partial<State>) {
  const made = testApp({ ...state, editing: null });
  if (state.editing) made.store.set({ editing: state.editing }); // a new App ends editing
  return made;
}

function nameOf(button: HTMLElement): string {
  return (button.getAttribute("aria-label") ?? textOf(button)).trim();
}

// The text without the key beside it.
function textOf(button: HTMLElement): string {
  return [...button.childNodes].filter((node) => node.nodeName !== "KBD").map((node) => node.textContent).join("");
}

async function page(app: App): Promise<HTMLElement> {
  const edit = await editPanel(app).load();
  const place = document.createElement("div");
  const parts = [createToolbar(app, () => {}), ...createViewTools(app), createTimeline(app), createDrawerSwitch(app.store, app), createControlQuestion(app)];
  if (app.store.get().editing) parts.push((edit.mount as () => { body: HTMLElement })().body);
  place.append(...parts);
  return place;
}

// The names of the buttons and links that can be pressed, also those in closed menus. Buttons that
// are already on (aria-pressed) are left out.
function offered(place: HTMLElement): string[] {
  const isHidden = (each: HTMLElement) => {
    const hidden = each.closest("[hidden]");
    return hidden !== null && !hidden.classList.contains("menu-sheet");
  };
  const sheetIsHidden = (each: HTMLElement) => each.closest(".menu")?.closest("[hidden]") != null;
  return [...place.querySelectorAll<HTMLElement>("button, a")]
    .filter((each) => !(each as HTMLButtonElement).disabled && each.getAttribute("aria-pressed") !== "true" && !isHidden(each) && !sheetIsHidden(each))
    .map(nameOf)
    .filter((name) => !name.startsWith("Add at ") && !/^\d+:\d\d/.test(name)); // no form of the menu Notes, no marks of the timeline
}

// Toggles of overlays are commands that show or hide them.
function isInPalette(name: string, labels: readonly string[]): boolean {
  const other = name in OTHER_NAMES ? OTHER_NAMES[name]! : name;
  if (other === null) return true;
  if (/^[\d.]+×$/.test(other)) return labels.some((label) => label.startsWith("Set the speed to ")); // but not to the present speed
  const wanted = [other, `Show ${other}`, `Hide ${other}`].map((each) => each.toLowerCase());
  return labels.some((label) => wanted.includes(label.toLowerCase()));
}

test.each(Object.keys(STATES))("the palette has a command for each button: %s", async (name) => {
  const { app } = appIn(STATES[name]!);
  const labels = commandsOf(app).map(({ label }) => label);
  const buttons = offered(await page(app));
  expect(buttons.length).toBeGreaterThan(15);
  expect(buttons.filter((button) => !isInPalette(button, labels))).toEqual([]);
});

test("the palette has a command for each key of the help sheet", () => {
  const { app } = appIn(BASE);
  const keys = [...createHelpSheet(app).querySelectorAll(".keys kbd")].map(({ textContent }) => textContent!.toUpperCase());
  const known = new Set(Object.values(STATES).flatMap((state) => {
    const { app } = appIn(state);
    vi.spyOn(app.edits, "hasCopies", "get").mockReturnValue(true);
    return commandsOf(app).flatMap(({ key }) => (key ? [key.toUpperCase()] : []));
  }));
  // Driving and cancelling are no commands, and Ctrl K opens the palette.
  const others = ["W", "A", "S", "D", "ESC", "CTRL K"];
  expect(keys.length).toBeGreaterThan(40);
  expect(keys.filter((key) => !known.has(key) && !others.includes(key))).toEqual([]);
});

test("a command opens its menu, and another one acts", async () => {
  const { app, store } = appIn(STATES.editing!);
  const place = await page(app);
  document.body.replaceChildren(place);
  const run = (label: string) => commandsOf(app).find((command) => command.label === label)!.run();
  run("Add a shape…");
  expect(place.querySelector('[aria-label="Shape"][aria-expanded="true"]')).not.toBeNull();
  const undo = vi.spyOn(app.editActions, "undo").mockImplementation(() => {});
  run("Undo");
  expect(undo).toHaveBeenCalled();
  run("Place");
  expect(store.get().placing).toBe(true);
  run("Colour points by height");
  expect(store.get().overlayColours.points).toBe("height");
});
