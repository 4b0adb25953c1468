// Writes the present view to the page's address, and reads it from there:
// #t=12.5&view=X,Y,Z,X,Y,Z&select=NAME&mode=chase&show=beams,grid&layout=drive. All parts are
// optional. If a part is missing, the page behaves in this respect as if there were no link.
import type { OverlayName, Shown } from "./overlays";
import { OVERLAY_NAMES } from "./overlays";
import type { ViewMode } from "./State";

// The position and the target of the camera: x y z each, in metres.
export type Viewpoint = [number, number, number, number, number, number];

export interface LinkedView {
  time: number | null; // simulated time of a recording, s
  viewpoint: Viewpoint | null;
  selection: string | null;
  viewMode: ViewMode | null;
  shown: Shown | null;
  layout: string | null; // name of a preset, or a text of state/layout.ts; not checked
}

const MODES: readonly ViewMode[] = ["orbit", "follow", "chase", "eye"];
const FARTHEST = 1e6; // m

export function hashOf({ time, viewpoint, selection, viewMode, shown, layout }: LinkedView): string {
  const parts: string[] = [];
  if (time !== null) parts.push(`t=${short(time, 6)}`);
  if (viewpoint) parts.push(`view=${viewpoint.map((value) => short(value, 3)).join(",")}`);
  if (selection !== null) parts.push(`select=${encodeURIComponent(selection)}`);
  if (viewMode !== null && viewMode !== "orbit") parts.push(`mode=${viewMode}`);
  if (shown) parts.push(`show=${OVERLAY_NAMES.filter((name) => shown[name]).join(",")}`);
  if (layout !== null) parts.push(`layout=${layout}`); // the text contains no characters that need escaping
  return `#${parts.join("&")}`;
}

// Reads the view in an address. Invalid parts are ignored, because a link is untrusted.
export function linkedView(hash: string): LinkedView {
  const parts = new URLSearchParams(hash.replace(/^#/, ""));
  const time = parts.get("t");
  const mode = MODES.find((each) => each === parts.get("mode"));
  return {
    time: time !== null && time !== "" && Number.isFinite(Number(time)) ? Number(time) : null,
    viewpoint: viewpointOf(parts.get("view")),
    selection: parts.get("select") || null,
    viewMode: mode ?? null,
    shown: shownOf(parts.get("show")),
    layout: parts.get("layout") || null,
  };
}

function short(value: number, digits: number): string {
  return String(Number(value.toFixed(digits)));
}

function viewpointOf(text: string | null): Viewpoint | null {
  const numbers = (text ?? "").split(",").map((part) => (part === "" ? NaN : Number(part)));
  const isView = numbers.length === 6 && numbers.every((each) => Math.abs(each) < FARTHEST);
  if (!isView) return null;
  const [x, y, z, tx, ty, tz] = numbers as Viewpoint;
  return Math.hypot(x - tx, y - ty, z - tz) > 1e-3 ? [x, y, z, tx, ty, tz] : null;
}

function shownOf(text: string | null): Shown | null {
  if (text === null) return null;
  const names = text.split(",");
  return Object.fromEntries(OVERLAY_NAMES.map((name) => [name, names.includes(name)])) as Record<
    OverlayName,
    boolean
  >;
}
