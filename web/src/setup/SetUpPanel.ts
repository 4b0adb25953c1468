// The form for setting up a simulation, beside a preview of it.
import type { App } from "../app/App";
import type { RobotList, Scenario } from "../api/scenario";
import type { SetUp } from "../state/setUp";
import { pedestriansOfField, robotOfField } from "../state/setUp";
import { element, setText } from "../ui/element";
import type { IconName } from "../ui/icons";
import { icon } from "../ui/icons";
import { checkField, choiceField, choiceOrText, numberField, textField } from "../ui/fields";
import { chosenFiles, droppedFiles } from "../upload/dropped";
import { PedestrianRow } from "./PedestrianRow";
import { RobotRow } from "./RobotRow";
import { createRos2Part } from "./Ros2Part";

const BY_PATH = { choice: "A file or folder…", placeholder: "path/to/world.sdf" };

export function createSetUpPanel(app: App): HTMLElement {
  const world = choiceOrText("Environment", BY_PATH, (value) => app.setUp.change({ world: value }));
  const parameters = parameterFields(app);
  const lists = { robots: createList(app, "robots"), avatars: createList(app, "avatars") };
  const pedestrians = createPedestrianList(app);
  const ros2 = createRos2Part(app);
  const hint = element("p", { class: "hint" });
  const offers = element("div", { class: "hint offers-hint" });
  const warnings = element("ul", { class: "warnings", "aria-label": "Problems in the files" });
  const wrong = element("p", { class: "field-error", role: "alert" });
  const create = element(
    "button",
    { class: "button primary", type: "button", onclick: () => void app.setUp.create().then(showObjection) },
    "Create",
  );
  const panel = element(
    "section",
    { class: "sidebar set-up", "aria-label": "New simulation" },
    head(app),
    element("div", { class: "set-up-part" }, world.element, uploads(app)),
    element("div", { class: "set-up-part" }, element("h2", {}, "Robots"), lists.robots.element, adder(app), hint, offers),
    element("div", { class: "set-up-part avatars-part" }, element("h2", {}, "Avatars"), lists.avatars.element),
    element("div", { class: "set-up-part avatars-part" }, element("h2", {}, "Pedestrians"), pedestrians.element),
    ros2.element,
    element(
      "details",
      { class: "set-up-part" },
      element("summary", {}, "Parameters"),
      ...[...parameters.values()].map((field) => field.element),
    ),
    warnings,
    element("div", { class: "set-up-end" }, wrong, create, button("Cancel", () => app.setUp.close())),
  );

  takeDrops(app);
  app.store.watch(
    ({ setUp }) => setUp,
    (setUp) => {
      panel.hidden = setUp === null;
      if (!setUp) return;
      const { scenario } = setUp;
      world.offer([
        ...setUp.uploaded.map(({ name, path }) => ({ value: path, label: name })),
        ...setUp.worlds.map((name) => ({ value: name, label: name })),
      ]);
      world.show(scenario.world);
      for (const [key, field] of parameters) field.show(scenario[key] as never);
      lists.robots.show(setUp);
      lists.avatars.show(setUp);
      pedestrians.show(setUp);
      ros2.show(setUp);
      showWrong(setUp);
      setText(hint, hintFor(scenario));
      showOffers(offers, setUp);
      warnings.replaceChildren(...setUp.warnings.slice(0, 20).map((each) => element("li", {}, each)));
      panel.setAttribute("aria-busy", String(setUp.isBusy));
      create.disabled = setUp.isHeld;
    },
  );

  // Scroll, because the field may be outside of the visible part.
  function showObjection(): void {
    panel.querySelector(".field-error:not([hidden])")?.scrollIntoView({ block: "center" });
  }

  function showWrong({ wrong: found }: SetUp): void {
    const { field = "", sentence = "" } = found ?? {};
    const robot = robotOfField(field);
    const group = pedestriansOfField(field);
    world.refuse(field === "world" ? sentence : "");
    for (const [key, each] of parameters) each.refuse(field === key ? sentence : "");
    for (const list of ["robots", "avatars"] as const) {
      lists[list].refuse(robot?.list === list ? robot : null, sentence);
    }
    pedestrians.refuse(group, sentence);
    const isOfRos2 = field.startsWith("ros2");
    ros2.refuse(isOfRos2 ? sentence : "");
    if (parameters.has(field as keyof Scenario)) panel.querySelector("details")!.open = true;
    const hasPlace = isOfRos2 || field === "world" || robot !== null || group !== null || parameters.has(field as keyof Scenario);
    setText(wrong, hasPlace ? "" : sentence);
    wrong.hidden = hasPlace || sentence === "";
  }
  return panel;
}

function button(label: string, onclick: () => void, picture: IconName | null = null): HTMLButtonElement {
  if (picture === null) return element("button", { class: "button", type: "button", onclick }, label);
  return element(
    "button",
    { class: "button plain small", type: "button", "aria-label": label, title: label, onclick },
    icon(picture),
  );
}

function head(app: App): HTMLElement {
  const file = element("input", { type: "file", accept: ".yaml,.yml,.json", "aria-label": "Scenario file" });
  file.hidden = true;
  file.addEventListener("change", () => {
    const chosen = file.files?.[0];
    file.value = ""; // so that the same file can be chosen again
    if (chosen) void app.setUp.load(chosen);
  });
  const undo = button("Undo", () => app.setUp.undo(), "undo");
  const redo = button("Redo", () => app.setUp.redo(), "redo");
  app.store.watch(
    ({ setUp }) => setUp,
    (setUp) => {
      undo.disabled = !setUp?.past.length;
      redo.disabled = !setUp?.future.length;
    },
  );
  return element(
    "div",
    { class: "card-head" },
    element("h1", {}, "New simulation"),
    undo,
    redo,
    button("Load a scenario file", () => file.click(), "open"),
    button("Save as a scenario file", () => app.setUp.save(), "save"),
    file,
  );
}

// The input for worlds from this machine. The user chooses files here, or drops them anywhere on
// the page.
function uploads(app: App): HTMLElement {
  const chooser = (label: string, isFolder: boolean) => {
    const file = element("input", {
      type: "file",
      "aria-label": isFolder ? "World folder" : "World file",
      ...(isFolder ? { webkitdirectory: true } : { accept: ".sdf,.world,.urdf,.xml,.zip" }),
    });
    file.hidden = true;
    file.addEventListener("change", () => {
      const chosen = chosenFiles(file.files!);
      file.value = ""; // so that the same file can be chosen again
      if (chosen.length > 0) void app.setUp.drop(chosen);
    });
    return [button(label, () => file.click()), file];
  };
  return element(
    "div",
    { class: "uploads" },
    ...chooser("Upload a file…", false),
    ...chooser("Upload a folder…", true),
    element("span", { class: "dim" }, "or drop it here"),
  );
}

// Handles drops on the whole page. Otherwise, the browser would show the file instead of the page.
function takeDrops(app: App): void {
  const isTaken = ({ dataTransfer }: DragEvent) => {
    const { setUp, abilities } = app.store.get();
    return (setUp !== null || abilities.creates) && (dataTransfer?.types.includes("Files") ?? false);
  };
  const invite = (isInviting: boolean) => document.body.classList.toggle("takes-drop", isInviting);
  addEventListener("dragover", (event) => {
    event.preventDefault();
    invite(isTaken(event));
  });
  addEventListener("dragleave", ({ relatedTarget }) => {
    if (relatedTarget === null) invite(false); // the pointer has left the window
  });
  addEventListener("drop", (event) => {
    event.preventDefault();
    invite(false);
    if (isTaken(event)) void app.setUp.drop(droppedFiles(event.dataTransfer!));
  });
}

function adder(app: App): HTMLElement {
  const model = choiceField("Model to add", () => {});
  const select = model.element.querySelector("select")!;
  app.store.watch(
    ({ setUp }) => setUp?.models,
    (models) => model.offer((models ?? []).filter((each) => !each.isAvatar).map(({ name: value }) => ({ value, label: value }))),
  );
  app.store.watch(
    ({ setUp }) => setUp?.models[0]?.name ?? "",
    () => (select.selectedIndex = 0),
  );
  return element(
    "div",
    { class: "set-up-add" },
    model.element,
    button("Add robot", () => app.setUp.addRobot("robots", select.value)),
    button("Add avatar", () => app.setUp.addRobot("avatars", "avatar")),
    button("Add pedestrians", () => app.setUp.addPedestrians()),
  );
}

function parameterFields(app: App) {
  const take = (key: keyof Scenario) => (value: unknown) => app.setUp.change({ [key]: value });
  const mode = choiceField("Pace", take("mode"));
  mode.offer([
    { value: "real_time", label: "Real time: the real-time factor sets the speed" },
    { value: "lockstep", label: "Lockstep: as fast as possible, same result each time" },
  ]);
  return new Map<keyof Scenario, { element: HTMLElement; show(value: never): void; refuse(sentence: string): void }>([
    ["name", textField("Name", "chosen automatically", take("name"))],
    ["mode", mode],
    ["real_time_factor", numberField("Real-time factor (simulated seconds per second), 0 for the factor of the world file", 0, take("real_time_factor"), { least: "0" })],
    ["duration", numberField("Duration in s (0: until stopped)", 0, take("duration"), { least: "0" })],
    ["step", numberField("Step (s), 0 for the step of the world file", 0, take("step"), { least: "0" })],
    ["seed", numberField("Random seed", 0, take("seed"), { step: "1", least: "0" })],
    ["record", checkField("Record from the start", take("record"))],
  ]);
}

function createList(app: App, list: RobotList) {
  const rows: RobotRow[] = [];
  const place = element("ul", { class: "set-up-robots", "aria-label": list === "robots" ? "Robots" : "Avatars" });
  app.store.watch(
    ({ selection }) => selection,
    () => mark(),
  );
  function mark(): void {
    const { setUp, selection } = app.store.get();
    rows.forEach((row, i) => row.setSelected(selection !== null && setUp?.scenario[list][i]?.name === selection));
  }
  return {
    element: place,
    show: (setUp: SetUp) => {
      const robots = setUp.scenario[list];
      while (rows.length > robots.length) rows.pop()!.element.remove();
      robots.forEach((robot, i) => {
        const row = (rows[i] ??= new RobotRow(app, list, i));
        if (!row.element.isConnected || row.element.parentElement !== place) place.append(row.element);
        row.show(robot, setUp);
      });
      mark();
    },
    refuse: (wrong: { index: number; input: string } | null, sentence: string) => {
      rows.forEach((row, i) => {
        if (wrong?.index === i) row.refuse(wrong.input, sentence);
        else row.refuse("", "");
      });
    },
  };
}

function createPedestrianList(app: App) {
  const rows: PedestrianRow[] = [];
  const place = element("ul", { class: "set-up-robots", "aria-label": "Pedestrians" });
  return {
    element: place,
    show: ({ scenario }: SetUp) => {
      while (rows.length > scenario.pedestrians.length) rows.pop()!.element.remove();
      scenario.pedestrians.forEach((group, i) => {
        const row = (rows[i] ??= new PedestrianRow(app, i));
        if (!row.element.isConnected) place.append(row.element);
        row.show(group);
      });
    },
    refuse: (wrong: { index: number; input: string } | null, sentence: string) => {
      rows.forEach((row, i) => (wrong?.index === i ? row.refuse(wrong.input, sentence) : row.refuse("", "")));
    },
  };
}

function hintFor({ robots, avatars }: Scenario): string {
  if (robots.length + avatars.length === 0) return "No robots yet. Choose a model and press Add robot.";
  return "Drag a robot to move it. Drag the tip of its arrow to turn it. Or press Place, then click the floor.";
}

function showOffers(place: HTMLElement, { behaviours, scenario }: SetUp): void {
  place.hidden = behaviours === null || behaviours.offers.length > 0 || scenario.robots.length === 0;
  if (place.hidden || place.dataset.command === behaviours?.startCommand) return;
  place.dataset.command = behaviours?.startCommand ?? "";
  place.replaceChildren(
    element("p", {}, "No behaviours yet. Start one in a terminal; it appears here automatically:"),
    element("code", {}, behaviours?.startCommand ?? ""),
  );
}
