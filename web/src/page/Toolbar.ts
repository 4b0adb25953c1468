// The bar at the top: the simulation's name, the buttons that control it, layouts, sharing, and the
// other pages.
import type { App } from "../app/App";
import type { Action } from "../api/SimulationApi";
import { canAct, canEdit, isAllowed, mainAction } from "../state/actions";
import { shallowEqual } from "../state/Store";
import { element } from "../ui/element";
import type { IconName } from "../ui/icons";
import { iconButton } from "../ui/iconButton";
import { icon, setIcon } from "../ui/icons";
import { createRecordButton } from "./RecordButton";
import { createLayoutMenu } from "./LayoutMenu";
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
      { class: "toolbar-views" },
      findButton(app),
      createLayoutMenu(app),
      createShareMenu(app),
      createPeopleMenu(app),
      element("span", { class: "divider", "aria-hidden": "true" }),
      ...pageLinks(app),
      iconButton({ picture: "help", label: "Help", key: "?", onclick: () => app.openHelp(true) }),
    ),
  );
}

// The buttons for running. A recording has its own buttons in the timeline.
function transport(app: App): HTMLElement {
  const group = element(
    "div",
    { class: "toolbar-transport", role: "group", "aria-label": "Run" },
    mainButton(app),
    actionButton(app, "step", "step", "Step", "Take one step (before the start, or while paused)"),
    createPaceMenu(app),
    actionButton(app, "stop", "stop", "Stop", "Stop the simulation; after that, only Reset is possible"),
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

function findButton(app: App): HTMLElement {
  return iconButton({ picture: "find", label: "Find", title: "Find a command, robot, topic or panel (Ctrl K)", onclick: () => app.openPalette(true) });
}

function newButton(app: App): HTMLElement {
  const label = "New simulation";
  const button = iconButton({ picture: "add", label, word: "New", onclick: () => void app.setUp.open() });
  app.store.watch(
    ({ abilities, setUp }) => abilities.creates && setUp === null,
    (shown) => (button.hidden = !shown),
  );
  return button;
}

// A press on this button pauses a running simulation before editing begins.
function editButton(app: App): HTMLElement {
  const title = "Move, add and remove robots and objects. A running simulation pauses";
  const button = iconButton({ picture: "edit", label: "Edit", title, onclick: () => void app.edits.toggle() });
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
  const button = iconButton({ picture: "list", label: "Robots", onclick: toggle });
  button.classList.add("sidebar-toggle");
  return button;
}

// The simulation's name. If there are several simulations, it is a list of their names. It is also
// the heading of the page.
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

function actionButton(app: App, action: Action, picture: IconName, label: string, title: string): HTMLElement {
  const button = iconButton({ picture, label, title, onclick: () => void app.act(action) });
  app.store.watch(
    (state) => canAct(state) && isAllowed(state.status?.phase, action),
    (enabled) => (button.disabled = !enabled),
  );
  return button;
}
