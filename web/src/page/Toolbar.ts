// The bar at the top: which simulation, the buttons that run it, and the views.
import type { App } from "../app/App";
import type { Action } from "../api/SimulationApi";
import type { Panel } from "../panels/contract/Panel";
import { PANELS } from "../panels/registry";
import type { ViewMode } from "../state/State";
import { canAct, canEdit, isAllowed, mainAction } from "../state/actions";
import { shallowEqual } from "../state/Store";
import { element } from "../ui/element";
import type { IconName } from "../ui/icons";
import { icon, setIcon } from "../ui/icons";
import { createRecordButton } from "./RecordButton";
import { createOverlayMenu } from "./OverlayMenu";
import { createPaceMenu } from "./PaceMenu";
import { createPeopleMenu } from "./PeopleMenu";
import { pageLinks } from "./pageLinks";
import { createShareMenu } from "./ShareMenu";

export function createToolbar(app: App, toggleSidebar: () => void): HTMLElement {
  return element(
    "header",
    { class: "toolbar" },
    element(
      "div",
      { class: "toolbar-start" },
      sidebarButton(toggleSidebar),
      element("span", { class: "wordmark" }, "GSV"),
      simulationChoice(app),
      newButton(app),
    ),
    transport(app),
    element(
      "div",
      { class: "toolbar-views", role: "group", "aria-label": "View" },
      viewButton("home", "Reset view", "R", () => app.resetView()),
      viewButton("top", "Top view", "T", () => app.topView()),
      modeButton(app, "follow", "follow", "Follow", "F"),
      modeButton(app, "chase", "chase", "Chase", "C"),
      modeButton(app, "eye", "eye", "Robot's eye", "V"),
      element("span", { class: "divider", "aria-hidden": "true" }),
      createOverlayMenu(app),
      ...PANELS.map((panel) => panelButton(app, panel)),
      createShareMenu(app),
      createPeopleMenu(app),
      element("span", { class: "divider", "aria-hidden": "true" }),
      ...pageLinks(app),
      viewButton("help", "Help", "?", () => app.openHelp(true)),
    ),
  );
}

// A recording has its own, in the timeline.
function transport(app: App): HTMLElement {
  const group = element(
    "div",
    { class: "toolbar-transport", role: "group", "aria-label": "Run" },
    mainButton(app),
    actionButton(app, "step", "step", "Step", "Take one step (paused)"),
    createPaceMenu(app),
    actionButton(app, "stop", "stop", "Stop", "Stop for good"),
    actionButton(app, "reset", "reset", "Reset", "Reset to the start"),
    editButton(app),
    createRecordButton(app),
  );
  app.store.watch(
    ({ replay, setUp }) => replay !== null || setUp !== null,
    (isElsewhere) => (group.hidden = isElsewhere),
  );
  return group;
}

function newButton(app: App): HTMLElement {
  const label = "New simulation";
  const button = element(
    "button",
    { class: "button plain", type: "button", "aria-label": label, title: label, onclick: () => void app.setUp.open() },
    icon("add"),
  );
  app.store.watch(
    ({ abilities, setUp }) => abilities.creates && setUp === null,
    (shown) => (button.hidden = !shown),
  );
  return button;
}

// What runs is paused first.
function editButton(app: App): HTMLElement {
  const title = "Move, add and remove robots (paused)";
  const button = element(
    "button",
    { class: "button", type: "button", "aria-label": "Edit", title, onclick: () => void app.edits.toggle() },
    icon("edit"),
  );
  app.store.watch(
    (state) => ({ on: state.editing !== null, able: canEdit(state), shown: state.abilities.creates }),
    ({ on, able, shown }) => {
      button.hidden = !shown;
      button.disabled = !able;
      button.setAttribute("aria-pressed", String(on));
    },
    shallowEqual,
  );
  return button;
}

function sidebarButton(toggle: () => void): HTMLElement {
  return element(
    "button",
    {
      class: "button plain sidebar-toggle",
      type: "button",
      "aria-label": "Robots",
      title: "Robots",
      onclick: toggle,
    },
    icon("list"),
  );
}

// A name where there is one simulation, a choice where there are several.
// Also the page's heading, whatever is there to choose from.
function simulationChoice(app: App): HTMLElement {
  const place = element("div", { class: "simulation-choice" });
  app.store.watch(
    ({ simulations, simulation }) => [simulation, ...(simulations ?? []).map(({ name }) => name)],
    ([chosen, ...names]) => {
      if (!chosen) return place.replaceChildren(element("h1", { class: "unseen" }, "Viewer"));
      if (names.length < 2) return place.replaceChildren(element("h1", { title: chosen }, chosen));
      const choice = element("select", { "aria-label": "Simulation" });
      for (const name of names) choice.append(new Option(name ?? "", name ?? "", false, name === chosen));
      choice.addEventListener("change", () => app.session.join(choice.value));
      place.replaceChildren(element("h1", {}, choice));
    },
    shallowEqual,
  );
  return place;
}

const MAIN: Record<ReturnType<typeof mainAction>, { label: string; icon: IconName }> = {
  start: { label: "Start", icon: "play" },
  resume: { label: "Resume", icon: "play" },
  pause: { label: "Pause", icon: "pause" },
};

function mainButton(app: App): HTMLElement {
  const picture = icon("play");
  const label = element("span", {});
  const button = element(
    "button",
    {
      class: "button primary main-action",
      type: "button",
      "aria-keyshortcuts": "Space",
      onclick: () => app.startPauseOrResume(),
    },
    picture,
    label,
  );
  app.store.watch(
    (state) => ({ phase: state.status?.phase, enabled: canAct(state) }),
    ({ phase, enabled }) => {
      const action = mainAction(phase);
      setIcon(picture, MAIN[action].icon);
      label.textContent = MAIN[action].label;
      button.title = `${MAIN[action].label} (Space)`;
      button.disabled = !enabled || !isAllowed(phase, action);
    },
    shallowEqual,
  );
  return button;
}

function actionButton(
  app: App,
  action: Action,
  picture: IconName,
  label: string,
  title: string,
): HTMLElement {
  const button = element(
    "button",
    { class: "button", type: "button", "aria-label": label, title, onclick: () => void app.act(action) },
    icon(picture),
  );
  app.store.watch(
    (state) => canAct(state) && isAllowed(state.status?.phase, action),
    (enabled) => (button.disabled = !enabled),
  );
  return button;
}

// Without a key it has no shortcut.
function viewButton(picture: IconName, label: string, key: string, onclick: () => void): HTMLElement {
  const shortcut = key !== "" && { "aria-keyshortcuts": key };
  const title = shortcut ? `${label} (${key})` : label;
  return element(
    "button",
    { class: "button plain", type: "button", "aria-label": label, ...shortcut, title, onclick },
    icon(picture),
  );
}

function modeButton(app: App, mode: ViewMode, picture: IconName, label: string, key: string): HTMLElement {
  const button = viewButton(picture, label, key, () => app.toggleViewMode(mode));
  app.store.watch(
    ({ viewMode }) => viewMode === mode,
    (isOn) => button.setAttribute("aria-pressed", String(isOn)),
  );
  return button;
}

function panelButton(app: App, { id, title, picture, key = "", isAvailable }: Panel): HTMLElement {
  const button = viewButton(picture, title, key, () => app.panels.toggle(id));
  app.store.watch(
    ({ openPanels }) => openPanels.includes(id),
    (open) => button.setAttribute("aria-pressed", String(open)),
  );
  app.store.watch(isAvailable, (available) => (button.hidden = !available));
  return button;
}
