// The result of the ruler, in a bar below the view, and the scale bar of the map, over the view.
import type { App } from "../app/App";
import type { Point } from "../state/State";
import { element, setText } from "../ui/element";
import { formatNumber } from "../ui/format";
import { icon } from "../ui/icons";

const DEGREES = 180 / Math.PI;
const BAR_PX = 120; // maximum length

export interface Measured {
  distance: number; // m
  dx: number;
  dy: number;
  dz: number;
  angleDeg: number; // direction of the line in the floor's plane, counter-clockwise from x
}

export function measure(from: Point, to: Point): Measured {
  const [dx, dy, dz] = [to.x - from.x, to.y - from.y, to.z - from.z];
  return { distance: Math.hypot(dx, dy, dz), dx, dy, dz, angleDeg: Math.atan2(dy, dx) * DEGREES };
}

// The bar has the same height during the whole measurement, so that the view does not move between
// the clicks.
export function createMeasureBar(app: App): HTMLElement {
  const text = element("p", { class: "dim" });
  const values = element("dl", { class: "number" });
  const close = element(
    "button",
    { class: "button plain small", type: "button", "aria-label": "End measuring", title: "End measuring (Esc)", onclick: () => app.pointing.setMeasuring(false) },
    icon("close"),
  );
  const bar = element("section", { class: "measure-bar", "aria-label": "Ruler", "aria-live": "polite" }, element("h2", {}, "Ruler"), text, values, close);
  app.store.watch(
    ({ ruler }) => ruler,
    (ruler) => {
      bar.hidden = ruler === null;
      const [from, to] = ruler ?? [];
      setText(text, !from ? "Click the first point." : !to ? "Click the second point." : "");
      text.hidden = to !== undefined;
      values.hidden = to === undefined;
      values.replaceChildren(...(from && to ? rowsOf(measure(from, to)) : []));
    },
  );
  return bar;
}

function rowsOf({ distance, dx, dy, dz, angleDeg }: Measured): HTMLElement[] {
  const metres = (value: number) => `${formatNumber(value, 3)} m`;
  const rows = { Distance: metres(distance), dx: metres(dx), dy: metres(dy), dz: metres(dz), Angle: `${formatNumber(angleDeg, 1)}°` };
  return Object.entries(rows).map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value)));
}

// Returns the length in metres that the scale bar shows: 1, 2 or 5 times a power of ten. It is the
// largest such length whose bar is at most BAR_PX wide.
export function barLength(metresPerPixel: number): number {
  const longest = BAR_PX * metresPerPixel;
  const power = 10 ** Math.floor(Math.log10(longest));
  return ([5, 2].find((each) => each * power <= longest) ?? 1) * power;
}

export interface ScaleBar {
  element: HTMLElement;
  show(metresPerPixel: number): void;
}

// The scale bar is shown only on a map, because only a map has the same scale everywhere.
export function createScaleBar(app: App): ScaleBar {
  const bar = element("div", { class: "scale-line" });
  const label = element("span", {});
  const place = element("div", { class: "scale-bar", role: "img" }, element("span", { class: "north", "aria-hidden": "true" }, "N ↑"), bar, label);
  let shown = 0;
  app.store.watch(
    ({ mapMode }) => mapMode,
    (mapMode) => (place.hidden = !mapMode),
  );
  return {
    element: place,
    show: (metresPerPixel) => {
      if (!app.store.get().mapMode || !(metresPerPixel > 0) || metresPerPixel === shown) return;
      shown = metresPerPixel;
      const length = barLength(metresPerPixel);
      const text = length >= 1 ? `${length} m` : `${Number((100 * length).toPrecision(1))} cm`;
      bar.style.width = `${length / metresPerPixel}px`;
      setText(label, text);
      place.setAttribute("aria-label", `Map, north up. The scale bar stands for ${text}.`);
    },
  };
}
