// A panel beside the view, such as the log.
//
// A panel has one entry in registry.ts and one module. The panel bar, the keys and the help sheet
// use the entry. The module is fetched when the panel is first opened.
import type { State } from "../../state/State";
import type { IconName } from "../../ui/icons";
import type { PanelPorts } from "./ports";

// The groups of the buttons that open panels, in their order.
export const PANEL_GROUPS = ["Look", "Control", "Data", "Health"] as const;
export type PanelGroup = (typeof PANEL_GROUPS)[number];

export interface Panel {
  id: string; // used in the store, as the element's class, and in saved layouts and links, so it must not change
  title: string;
  hint: string; // description of the panel for the help sheet
  picture: IconName;
  group: PanelGroup;
  key?: string; // the single key that opens and closes it, in upper case
  // Whether the server and the simulation provide the panel's data, and the viewer has permission.
  // If not, the panel is not offered. If it is already open, it shows `absence`.
  isAvailable(state: State): boolean;
  absence?: string; // the reason why there is nothing to show
  // Where the panel opens: beside the view, below it (default), or above the panels beside the
  // view.
  place?: "side" | "below" | "top-side";
  load(): Promise<PanelModule>;
}

// The module of a panel, which is fetched when the panel is first opened.
export interface PanelModule {
  // Called once, when the panel is first opened.
  mount(ports: PanelPorts): MountedPanel;
}

// A panel that was opened: its elements.
export interface MountedPanel {
  body: HTMLElement;
  tools?: HTMLElement[]; // controls above the body
  // Called whenever the panel becomes visible. The returned function is called when the panel is
  // closed or hidden behind another tab. Read data (topics, the store) only between these two
  // calls, so that a hidden panel costs nothing.
  whileOpen?(): () => void;
  // Called after the panel has moved to another window. A canvas that was in a window that is closed
  // can draw nothing more, so a panel must replace its canvases.
  afterMove?(): void;
}
