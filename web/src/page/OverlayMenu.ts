// The menu of overlays in the view.
import type { App } from "../app/App";
import { OVERLAYS } from "../state/overlays";
import { createMenu, menuItem } from "../ui/menu";

export function createOverlayMenu(app: App): HTMLElement {
  const items = OVERLAYS.map(({ name, label, key, hint }) => {
    const item = menuItem(label, key, hint, () => app.toggle(name));
    app.store.watch(
      ({ shown }) => shown[name],
      (shown) => item.setAttribute("aria-pressed", String(shown)),
    );
    return item;
  });
  return createMenu("Overlays", "layers", ...items).element;
}
