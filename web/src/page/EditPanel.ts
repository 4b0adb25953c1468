// The panel for adding, rotating and removing robots and objects of a paused simulation.
import type { App } from "../app/App";
import type { State } from "../state/State";
import type { Panel } from "../panels/contract/Panel";
import { EDIT_PANEL, allChosen, chosenOf } from "../state/editing";
import { element, setText } from "../ui/element";
import type { IconName } from "../ui/icons";
import { icon } from "../ui/icons";
import type { Menu } from "../ui/menu";
import { createWordedMenu } from "../ui/menu";
import { createGizmoTools } from "./GizmoTools";
import { createModelForm } from "./ModelForm";
import { createShapeForm } from "./ShapeForm";

const TURN = Math.PI / 12;

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
  const place = button("Place", () => app.pointing.setPlacing(!app.store.get().placing));
  place.title = "Place the selection by a click on the floor";
  const duplicate = button("Duplicate", () => app.editActions.duplicate());
  duplicate.title = "Duplicate the selection (Ctrl D)";
  const remove = button("Remove", () => app.editActions.remove());
  remove.title = "Remove the selection (Delete)";
  const turns = [
    pictureButton("Turn left", "turnLeft", () => app.editActions.turn(TURN)),
    pictureButton("Turn right", "turnRight", () => app.editActions.turn(-TURN)),
  ];
  const undo = pictureButton("Undo", "undo", () => app.editActions.undo());
  const redo = pictureButton("Redo", "redo", () => app.editActions.redo());
  const hint = element("p", { class: "hint" });
  const shape: Menu = createWordedMenu(
    { label: "Shape", picture: "add", word: "Shape", title: "Add a box, a cylinder, a sphere or a wall" },
    createShapeForm(app, () => shape.close()),
  );
  const model: Menu = createWordedMenu(
    { label: "Robot or object", picture: "add", word: "Robot or object", title: "Add a robot, an avatar or an object" },
    createModelForm(app, () => model.close()),
  );
  app.store.watch(
    ({ editing }) => editing !== null,
    (isOn) => isOn || [shape, model].forEach((menu) => menu.close()),
  );
  app.menus.set("shape", shape.open);
  app.menus.set("model", model.open);
  const panel = element(
    "div",
    { class: "edit-body" },
    element("div", { class: "edit-menus" }, shape.element, model.element),
    element("div", { class: "edit-buttons" }, undo, redo, ...turns, place, duplicate, remove, saveMenu(app)),
    createGizmoTools(app),
    hint,
  );

  app.store.watch(
    ({ editing }) => editing,
    (editing) => {
      if (!editing) return;
      name(undo, "Undo", editing.undo.at(-1), editing.isBusy);
      name(redo, "Redo", editing.redo.at(-1), editing.isBusy);
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

// The menu for saving. It explains what each file contains, and which programs read it.
function saveMenu(app: App): HTMLElement {
  const line = (label: string, explanation: string, withScenario: boolean) => {
    const save = button(label, () => {
      menu.close();
      void app.editActions.saveWorld(withScenario);
    });
    return element("div", { class: "save-line" }, save, element("p", { class: "dim" }, explanation));
  };
  const menu: Menu = createWordedMenu(
    { label: "Save", picture: "save", word: "Save", title: "Save the edited world as a file" },
    line("Save world", "An SDFormat file of all bodies at their present poses, for Gazebo and GSV.", false),
    line("Save scenario", "The same file, and a scenario (YAML) with the behaviours of the robots. Run the scenario with gsv run.", true),
  );
  return menu.element;
}

// Returns a hint about what the user can do next.
function hintOf(state: State): string {
  const { placing, editing } = state;
  const all = allChosen(state);
  if (placing) return `Click the floor to place ${all[0]} there.`;
  if (editing?.wall) return `Click the floor where the wall ${editing.wall.from ? "ends" : "begins"}.`;
  if (all.length > 1) return `${all.length} bodies are selected. Drag the arrows of ${all[0]} to move them all.`;
  if (all.length === 1) return `${all[0]} is selected. Drag its arrows, or press Place and click the floor.`;
  return "Click a robot or an object to select it, or drag it over the floor. Select several with Shift.";
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
