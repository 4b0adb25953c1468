// A panel beside the view, such as the log.
//
// It has one entry in registry.ts, which the panel bar, the keys and the help sheet use, and one
// module that is fetched when the panel is first opened.
import type { State } from "../../state/State";
import type { IconName } from "../../ui/icons";
import type { PanelPorts } from "./ports";

// The groups of the buttons that open panels, in their order.
export const PANEL_GROUPS = ["Look", "Control", "Data", "Health"] as const;
export type PanelGroup = (typeof PANEL_GROUPS)[number];

export interface Panel {
  id: string; // in the store, as the element's class, and in saved layouts and links: it stays
  title: string;
  hint: string; // what it shows, for the help sheet
  picture: IconName;
  group: PanelGroup;
  key?: string; // the single key that opens and closes it, in upper case
  // Whether server and simulation provide its data, and the viewer has permission. Otherwise the
  // panel is not offered, and if it is open it shows `absence`.
  isAvailable(state: State): boolean;
  absence?: string; // why there is nothing to show
  // The place where it opens: beside the view, below it (default), or above the panels beside the
  // view.
  place?: "side" | "below" | "top-side";
  load(): Promise<PanelModule>;
}

export interface PanelModule {
  // Called once, when the panel is first opened.
  mount(ports: PanelPorts): MountedPanel;
}

export interface MountedPanel {
  body: HTMLElement;
  tools?: HTMLElement[]; // controls above the body
  // Called whenever the panel comes into sight. The returned function is called when it is closed
  // or hidden behind another tab. Data that is read only in between (topics, the store) costs
  // nothing at other times.
  whileOpen?(): () => void;
}
