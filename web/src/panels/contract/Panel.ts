// A panel: something that is opened and closed beside the view, such as the log.
//
// It is one entry in registry.ts, which the panel bar, the keys and the help sheet go by, and one module that
// is fetched when the panel is opened for the first time.
import type { State } from "../../state/State";
import type { IconName } from "../../ui/icons";
import type { PanelPorts } from "./ports";

export interface Panel {
  id: string; // in the store, as the element's class, and in saved layouts and links: it stays
  title: string;
  hint: string; // what it shows, for the help sheet
  picture: IconName;
  key?: string; // the single key that opens and closes it, in upper case
  // Whether server and simulation have what it shows, and the viewer has permission for it. Until then it
  // is not offered, and where it is open it shows `absence`.
  isAvailable(state: State): boolean;
  absence?: string; // why there is nothing to show
  // Where it opens: beside the view, below it (default), or above those beside the view.
  place?: "side" | "below" | "top-side";
  load(): Promise<PanelModule>;
}

export interface PanelModule {
  // Called once, when the panel is opened for the first time.
  mount(ports: PanelPorts): MountedPanel;
}

export interface MountedPanel {
  body: HTMLElement;
  tools?: HTMLElement[]; // controls above the body
  // Called whenever the panel comes into sight; the function that it gives, when it is closed or goes behind
  // another tab. What is read only in between (topics, the store) costs nothing otherwise.
  whileOpen?(): () => void;
}
