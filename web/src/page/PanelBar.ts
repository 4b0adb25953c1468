// The bar with a button for each panel.
import type { App } from "../app/App";
import type { Panel } from "../panels/contract/Panel";
import { element } from "../ui/element";
import { iconButton } from "../ui/iconButton";

export function createPanelBar(app: App, panels: readonly Panel[]): HTMLElement {
  return element("nav", { class: "panel-bar", "aria-label": "Panels" }, ...panels.map((panel) => panelButton(app, panel)));
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
