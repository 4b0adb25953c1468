// The panel for adding, rotating and removing robots and objects of a paused simulation.
import type { App } from "../app/App";
import type { Behaviours } from "../api/SetUpApi";
import type { State } from "../state/State";
import { shallowEqual } from "../state/Store";
import type { Panel } from "../panels/contract/Panel";
import type { Editing } from "../state/editing";
import { EDIT_PANEL, allChosen, chosenOf, copiesOf } from "../state/editing";
import { EMPTY_SCENARIO, newRobot } from "../api/scenario";
import type { Option } from "../ui/fields";
import { choiceField, textField } from "../ui/fields";
import { element, setText } from "../ui/element";
import type { IconName } from "../ui/icons";
import { icon } from "../ui/icons";
import { createGizmoTools } from "./GizmoTools";
import { createShapeForm } from "./ShapeForm";

const TURN = Math.PI / 12;

// In the list, values that begin with this prefix are objects. The value of a robot is its model.
const OBJECT = "object ";
const COPY = "copy ";

// The panel is open while editing is on. Closing the panel ends editing.
export function editPanel(app: App): Panel {
  app.store.watch(
    ({ editing }) => editing !== null,
    (isOn) => (isOn ? app.panels.open(EDIT_PANEL) : app.panels.close(EDIT_PANEL)),
  );
  app.store.watch(
    ({ openPanels }) => openPanels.includes(EDIT_PANEL),
    (isOpen) => !isOpen && app.store.get().editing && void app.edits.toggle(),
  );
  return {
    id: EDIT_PANEL,
    title: "Edit",
    hint: "Move, add and remove robots and objects",
    picture: "edit",
    group: "Control",
    place: "top-side",
    isAvailable: ({ editing }) => editing !== null,
    absence: "Press Edit at the top to edit the simulation.",
    load: async () => ({ mount: () => ({ body: createEditPanel(app) }) }),
  };
}

function createEditPanel(app: App): HTMLElement {
  const model = choiceField("Model", () => offerBehaviour());
  const behaviour = choiceField("Behaviour", () => {});
  const drive = textField("Drive", "as its model says, else guessed", (text) => (driveText = text));
  let driveText = "";
  const [modelSelect, behaviourSelect] = [model, behaviour].map((each) => each.element.querySelector("select")!);
  const add = button("Add", () => void addChosen(app, modelSelect!.value, behaviourSelect!.value, driveText));
  const place = button("Place", () => app.pointing.setPlacing(!app.store.get().placing));
  place.title = "Place the selection by a click on the floor";
  const duplicate = button("Duplicate", () => app.editActions.duplicate());
  duplicate.title = "Duplicate the selection (Ctrl D)";
  const remove = button("Remove", () => app.editActions.remove());
  const turns = [
    pictureButton("Turn left", "turnLeft", () => app.editActions.turn(TURN)),
    pictureButton("Turn right", "turnRight", () => app.editActions.turn(-TURN)),
  ];
  const undo = pictureButton("Undo", "undo", () => app.editActions.undo());
  const redo = pictureButton("Redo", "redo", () => app.editActions.redo());
  const hint = element("p", { class: "hint" });
  const panel = element(
    "div",
    { class: "edit-body" },
    element("div", { class: "field-pair" }, model.element, behaviour.element, add),
    element("div", { class: "field-pair" }, drive.element),
    element("div", { class: "edit-buttons" }, undo, redo, ...turns, place, duplicate, remove),
    hint,
    createGizmoTools(app),
    createShapeForm(app),
    element(
      "div",
      { class: "edit-buttons edit-save" },
      saveButton("Save world", "Save the world as it stands now as SDFormat", () => app.editActions.saveWorld(false)),
      saveButton("Save scenario", "Save the world, and a scenario of it with the behaviours", () => app.editActions.saveWorld(true)),
    ),
  );
  const offerBehaviour = () => {
    behaviourSelect!.disabled = !isRobot(modelSelect!.value);
    drive.element.hidden = behaviourSelect!.disabled;
  };

  app.store.watch(
    modelsOf,
    (models) => {
      const before = modelSelect!.value;
      model.offer(models);
      modelSelect!.value = before;
      if (modelSelect!.selectedIndex < 0) modelSelect!.selectedIndex = 0;
      offerBehaviour();
    },
    (a, b) => a.length === b.length && a.every((option, i) => shallowEqual(option, b[i])),
  );
  app.store.watch(
    ({ editing }) => editing?.behaviours ?? null,
    (behaviours) => {
      behaviour.offer(optionsOf(behaviours));
      behaviourSelect!.selectedIndex = 0;
    },
  );
  app.store.watch(
    ({ editing }) => editing,
    (editing) => {
      if (!editing) return;
      name(undo, "Undo", editing.undo.at(-1), editing.isBusy);
      name(redo, "Redo", editing.redo.at(-1), editing.isBusy);
      add.disabled = editing.isBusy || editing.models.length + editing.objects.length === 0;
    },
  );
  app.store.watch(
    ({ placing }) => placing,
    (placing) => place.setAttribute("aria-pressed", String(placing)),
  );
  app.store.watch(hintOf, (text) => setText(hint, text));
  app.store.watch(chosenOf, (chosen) => {
    for (const each of [remove, place, duplicate, ...turns]) each.disabled = chosen === null;
  });
  return panel;
}

// Returns a hint about what the user can do next.
function hintOf(state: State): string {
  const { placing, editing } = state;
  const all = allChosen(state);
  if (placing) return `Click the floor to place ${all[0]} there.`;
  if (editing?.wall) return `Click the floor where the wall ${editing.wall.from ? "ends" : "begins"}.`;
  if (all.length > 1) return `${all.length} bodies are chosen. Drag the arrows of ${all[0]} to move them all.`;
  if (all.length === 1) return `${all[0]} is chosen. Drag its arrows, or press Place and click the floor.`;
  return "Click a robot or an object to choose it, or drag it over the floor. Choose several with Shift.";
}

function saveButton(label: string, title: string, save: () => Promise<void>): HTMLButtonElement {
  const saves = button(label, () => void save());
  saves.title = title;
  return saves;
}

function button(label: string, onclick: () => void): HTMLButtonElement {
  return element("button", { class: "button", type: "button", onclick }, label);
}

function pictureButton(label: string, picture: IconName, onclick: () => void): HTMLButtonElement {
  return element("button", { class: "button", type: "button", "aria-label": label, title: label, onclick }, icon(picture));
}

function name(button: HTMLButtonElement, verb: string, edit: string | undefined, isBusy: boolean): void {
  button.disabled = edit === undefined || isBusy;
  button.title = edit === undefined ? verb : `${verb}: ${edit}`;
}

function isRobot(choice: string): boolean {
  return !choice.startsWith(OBJECT) && !choice.startsWith(COPY);
}

function modelsOf({ editing, scene }: State): Option[] {
  if (!editing) return [];
  return [
    ...modelsBy(editing, false).map((name) => ({ value: name, label: name, group: "Robots" })),
    ...editing.objects.map((name) => ({ value: OBJECT + name, label: name, group: "Objects" })),
    ...modelsBy(editing, true).map((name) => ({ value: name, label: name, group: "Avatars, which people drive" })),
    ...copiesOf(scene).map((name) => ({ value: COPY + name, label: `like ${name}`, group: "Add another one like this" })),
  ];
}

// Returns the names of the models of avatars, or of the other robots.
function modelsBy({ models }: Editing, isAvatar: boolean): string[] {
  return models.filter((model) => model.isAvatar === isAvatar).map(({ name }) => name);
}

function optionsOf(behaviours: Behaviours | null) {
  const names = [...new Set((behaviours?.offers ?? []).map((offer) => offer.name))].sort();
  return [{ value: "", label: "None" }, ...names.map((value) => ({ value, label: value }))];
}

async function addChosen(app: App, choice: string, behaviour: string, drive: string): Promise<void> {
  if (choice.startsWith(OBJECT)) {
    await app.edits.addObject({ name: "", model: choice.slice(OBJECT.length), place: null });
  } else if (choice.startsWith(COPY)) {
    await app.edits.addObject({ name: "", copy_of: choice.slice(COPY.length), place: null });
  } else {
    await addRobot(app, choice, behaviour, drive);
  }
}

async function addRobot(app: App, model: string, behaviour: string, drive: string): Promise<void> {
  const models = app.store.get().editing?.models ?? [];
  const isAvatar = models.some((each) => each.name === model && each.isAvatar);
  const wishes = isAvatar ? {} : { behaviour, drive };
  const robot = { ...newRobot(EMPTY_SCENARIO, model), name: "", ...wishes };
  await app.edits.add(robot, isAvatar);
}
