// What changes who stands in a simulation that stands still.
import type { App } from "../app/App";
import type { Behaviours } from "../api/SetUpApi";
import { EMPTY_SCENARIO, newRobot } from "../state/scenario";
import { choiceField } from "../setup/fields";
import { element, setText } from "../ui/element";
import type { IconName } from "../ui/icons";
import { icon } from "../ui/icons";

export function createEditPanel(app: App): HTMLElement {
  const model = choiceField("Model", () => {});
  const behaviour = choiceField("Behaviour", () => {});
  const [modelSelect, behaviourSelect] = [model, behaviour].map((each) => each.element.querySelector("select")!);
  const add = button("Add", () => void addRobot(app, modelSelect!.value, behaviourSelect!.value));
  const remove = button("Remove", () => app.removeSelected());
  const undo = pictureButton("Undo", "undo", () => app.undo());
  const redo = pictureButton("Redo", "redo", () => app.redo());
  const hint = element("p", { class: "hint" });
  const panel = element(
    "section",
    { class: "card edit", "aria-label": "Edit" },
    element("div", { class: "field-pair" }, model.element, behaviour.element, add),
    element("div", { class: "edit-buttons" }, undo, redo, remove),
    hint,
  );

  app.store.watch(
    ({ editing }) => editing?.models,
    (models) => {
      model.offer((models ?? []).map(({ name }) => ({ value: name, label: name })));
      modelSelect!.selectedIndex = 0;
    },
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
      panel.hidden = editing === null;
      if (!editing) return;
      name(undo, "Undo", editing.undo.at(-1), editing.isBusy);
      name(redo, "Redo", editing.redo.at(-1), editing.isBusy);
      add.disabled = editing.isBusy || editing.models.length === 0;
    },
  );
  app.store.watch(
    ({ selection }) => selection,
    (selection) => {
      remove.disabled = selection === null;
      setText(
        hint,
        selection === null
          ? "Drag what can move. Click a robot to choose it, then the floor to put it there."
          : `Click the floor to put ${selection} there; drag its arrow's tip to turn it.`,
      );
    },
  );
  return panel;
}

function button(label: string, onclick: () => void): HTMLButtonElement {
  return element("button", { class: "button", type: "button", onclick }, label);
}

function pictureButton(label: string, picture: IconName, onclick: () => void): HTMLButtonElement {
  return element("button", { class: "button", type: "button", "aria-label": label, onclick }, icon(picture));
}

function name(button: HTMLButtonElement, verb: string, edit: string | undefined, isBusy: boolean): void {
  button.disabled = edit === undefined || isBusy;
  button.title = edit === undefined ? verb : `${verb}: ${edit}`;
}

function optionsOf(behaviours: Behaviours | null) {
  const names = [...new Set((behaviours?.offers ?? []).map((offer) => offer.name))].sort();
  return [{ value: "", label: "None" }, ...names.map((value) => ({ value, label: value }))];
}

async function addRobot(app: App, model: string, behaviour: string): Promise<void> {
  const models = app.store.get().editing?.models ?? [];
  const isAvatar = models.some((each) => each.name === model && each.isAvatar);
  const robot = { ...newRobot(EMPTY_SCENARIO, model), name: "", behaviour: isAvatar ? "" : behaviour };
  await app.edits.add(robot, isAvatar);
}
