// The buttons in the view's head: how the eye moves, and what is drawn over the world.
import type { App } from "../app/App";
import type { ViewMode } from "../state/State";
import { iconButton } from "../ui/iconButton";
import type { IconName } from "../ui/icons";
import { createOverlayMenu } from "./OverlayMenu";

export function createViewTools(app: App): HTMLElement[] {
  return [
    iconButton({ picture: "home", label: "Reset view", key: "R", onclick: () => app.resetView() }),
    iconButton({ picture: "top", label: "Top view", key: "T", onclick: () => app.topView() }),
    modeButton(app, "follow", "follow", "Follow", "F"),
    modeButton(app, "chase", "chase", "Chase", "C"),
    modeButton(app, "eye", "eye", "Robot's eye", "V"),
    createOverlayMenu(app),
  ];
}

function modeButton(app: App, mode: ViewMode, picture: IconName, label: string, key: string): HTMLElement {
  const button = iconButton({ picture, label, key, onclick: () => app.toggleViewMode(mode) });
  app.store.watch(
    ({ viewMode }) => viewMode === mode,
    (isOn) => button.setAttribute("aria-pressed", String(isOn)),
  );
  return button;
}
