// The bar with a button for each panel, in groups.
import type { App } from "../app/App";
import type { Panel } from "../panels/contract/Panel";
import { PANEL_GROUPS } from "../panels/contract/Panel";
import { element } from "../ui/element";
import { iconButton } from "../ui/iconButton";

export function createPanelBar(app: App, panels: readonly Panel[]): HTMLElement {
  const groups = PANEL_GROUPS.map((name) => {
    const buttons = panels.filter(({ group }) => group === name).map((panel) => panelButton(app, panel));
    return element("div", { class: "bar-group", role: "group", "aria-label": name }, ...buttons);
  });
  return element("nav", { class: "panel-bar", "aria-label": "Panels" }, ...groups);
}

function panelButton(app: App, { id, title, hint, picture, key = "", isAvailable }: Panel): HTMLElement {
  const button = iconButton({ picture, label: title, title: hint, key, onclick: () => app.panels.toggle(id) });
  app.store.watch(
    ({ openPanels }) => openPanels.includes(id),
    (open) => button.setAttribute("aria-pressed", String(open)),
  );
  app.store.watch(isAvailable, (available) => (button.hidden = !available));
  return button;
}
