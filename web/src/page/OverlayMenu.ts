// The menu of overlays in the view. It also explains the colours of points and trails.
import type { App } from "../app/App";
import type { OverlayColours } from "../state/overlays";
import { OVERLAYS, POINT_COLOURS, TRAIL_COLOURS } from "../state/overlays";
import { element } from "../ui/element";
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
  const colours = element(
    "div",
    { class: "overlay-colours" },
    choice(app, "points", "Colour points by", POINT_COLOURS),
    choice(app, "trails", "Colour trails by", TRAIL_COLOURS),
  );
  return createMenu("Overlays", "layers", ...items, colours).element;
}

function choice<Kind extends keyof OverlayColours>(
  app: App,
  kind: Kind,
  label: string,
  names: Readonly<Record<OverlayColours[Kind], string>>,
): HTMLElement {
  const values = Object.keys(names) as OverlayColours[Kind][];
  const select = element("select", {}, ...values.map((value) => new Option(names[value], value)));
  select.addEventListener("change", () => app.colourOverlays({ [kind]: select.value }));
  app.store.watch(
    ({ overlayColours }) => overlayColours[kind],
    (value) => (select.value = value),
  );
  return element("label", { class: "overlay-colour" }, label, select);
}
