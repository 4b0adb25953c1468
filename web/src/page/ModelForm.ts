// The form that adds a robot, an avatar, an object, or a copy of an object of the world.
import { EMPTY_SCENARIO, newRobot } from "../api/scenario";
import type { Behaviours } from "../api/SetUpApi";
import type { App } from "../app/App";
import type { Editing } from "../state/editing";
import { copiesOf } from "../state/editing";
import type { State } from "../state/State";
import { shallowEqual } from "../state/Store";
import { element } from "../ui/element";
import type { Option } from "../ui/fields";
import { choiceField, textField } from "../ui/fields";

// In the list, a value that begins with this prefix is an object. The value of a robot is the name
// of its model.
const OBJECT = "object ";
const COPY = "copy ";

// `onAdd` is called when the user adds something.
export function createModelForm(app: App, onAdd: () => void): HTMLElement {
  const model = choiceField("Model", () => offerBehaviour());
  const behaviour = choiceField("Behaviour", () => {});
  let driveText = "";
  const drive = textField("Drive", "default: drive of the model, else guessed from its wheels", (text) => drive.show((driveText = text)));
  const [modelSelect, behaviourSelect] = [model, behaviour].map((each) => each.element.querySelector("select")!);
  const add = element("button", { class: "button", type: "button" }, "Add");
  add.addEventListener("click", () => {
    onAdd();
    void addChosen(app, modelSelect!.value, behaviourSelect!.value, driveText);
  });
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
    ({ editing }) => editing === null || editing.isBusy || editing.models.length + editing.objects.length === 0,
    (isOff) => (add.disabled = isOff),
  );
  return element(
    "div",
    { class: "model-form" },
    element("div", { class: "field-pair" }, model.element, behaviour.element),
    drive.element,
    element("div", { class: "edit-buttons" }, add),
  );
}

function isRobot(choice: string): boolean {
  return !choice.startsWith(OBJECT) && !choice.startsWith(COPY);
}

function modelsOf({ editing, scene }: State): Option[] {
  if (!editing) return [];
  return [
    ...modelsBy(editing, false).map((name) => ({ value: name, label: name, group: "Robots" })),
    ...editing.objects.map((name) => ({ value: OBJECT + name, label: name, group: "Objects" })),
    ...modelsBy(editing, true).map((name) => ({ value: name, label: name, group: "Avatars (people whom viewers control)" })),
    ...copiesOf(scene).map((name) => ({ value: COPY + name, label: `like ${name}`, group: "Add another one like this" })),
  ];
}

// Returns the names of the models of avatars if `isAvatar` is true, otherwise of all other robots.
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
