// A panel: something that is opened and closed below the view, such as the log.
//
// It is one entry in registry.ts, which the toolbar, the keys and the help sheet go by, and one module that
// is fetched when the panel is opened for the first time.
import type { State } from "../../state/State";
import type { IconName } from "../../ui/icons";
import type { PanelPorts } from "./ports";

export interface Panel {
  id: string; // in the store, as the element's class, and where layouts are kept: it stays
  title: string;
  hint: string; // what it shows, for the help sheet
  picture: IconName;
  key?: string; // the single key that opens and closes it, in upper case
  // Whether server and simulation have what it shows, and the viewer has permission for it. Until then it
  // is not offered.
  isAvailable(state: State): boolean;
  load(): Promise<PanelModule>;
}

export interface PanelModule {
  // Called once, when the panel is opened for the first time.
  mount(ports: PanelPorts): MountedPanel;
}

export interface MountedPanel {
  body: HTMLElement;
  tools?: HTMLElement[]; // controls beside the title
  // Called whenever the panel is opened; the function that it gives, when it is closed. What is read only
  // in between (topics, the store) costs nothing while the panel is closed.
  whileOpen?(): () => void;
}

export function isOpen({ id, isAvailable }: Panel, state: State): boolean {
  return state.openPanels.includes(id) && isAvailable(state);
}
