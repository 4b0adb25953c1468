// The buttons above the view: camera modes and overlays.
import type { App } from "../app/App";
import type { State, ViewMode } from "../state/State";
import type { IconButton } from "../ui/iconButton";
import { iconButton } from "../ui/iconButton";
import type { IconName } from "../ui/icons";
import { createOverlayMenu } from "./OverlayMenu";

export function createViewTools(app: App): HTMLElement[] {
  return [
    iconButton({ picture: "home", label: "Reset view", word: "Reset", key: "R", onclick: () => app.resetView() }),
    iconButton({ picture: "top", label: "Top view", word: "Top", key: "T", onclick: () => app.topView() }),
    toggleButton(
      app,
      { picture: "map", label: "Map", title: "Show the world as a map: from above, north up" },
      ({ mapMode }) => mapMode,
      (isOn) => app.setMap(isOn),
    ),
    toggleButton(
      app,
      { picture: "ruler", label: "Measure", title: "Measure between two points" },
      ({ ruler }) => ruler !== null,
      (isOn) => app.pointing.setMeasuring(isOn),
    ),
    modeButton(app, "follow", "follow", "Follow", "F"),
    modeButton(app, "chase", "chase", "Chase", "C"),
    modeButton(app, "eye", "eye", "Robot's eye", "V", "Eye"),
    createOverlayMenu(app),
  ];
}

function toggleButton(
  app: App,
  look: Pick<IconButton, "picture" | "label" | "title">,
  isOn: (state: State) => boolean,
  set: (isOn: boolean) => void,
): HTMLElement {
  const button = iconButton({ ...look, onclick: () => set(!isOn(app.store.get())) });
  app.store.watch(isOn, (on) => button.setAttribute("aria-pressed", String(on)));
  return button;
}

function modeButton(app: App, mode: ViewMode, picture: IconName, label: string, key: string, word = label): HTMLElement {
  const button = iconButton({ picture, label, word, key, onclick: () => app.toggleViewMode(mode) });
  app.store.watch(
    ({ viewMode }) => viewMode === mode,
    (isOn) => button.setAttribute("aria-pressed", String(isOn)),
  );
  return button;
}
