// Opens and closes panels. The ids of the panels are in panels/registry.ts.
import type { State } from "../state/State";
import type { Store } from "../state/Store";

// The part of the page that contains the panels.
export interface PanelHost {
  isInSight(id: string): boolean; // false if the panel is closed or behind another tab
  reveal(id: string): void;
  enlarge(id: string): void; // maximises the part of a panel if it is small
  restoreSize(): boolean; // ends Maximise; returns true if a part was maximised
}

export class PanelControl {
  host: PanelHost | null = null;

  constructor(private readonly store: Store<State>) {}

  // Opens a panel. If it is behind another tab, brings it to the front.
  open(id: string): void {
    this.store.set(({ openPanels }) => (openPanels.includes(id) ? {} : { openPanels: [...openPanels, id] }));
    this.host?.reveal(id);
  }

  close(id: string): void {
    this.store.set(({ openPanels }) => ({ openPanels: openPanels.filter((each) => each !== id) }));
  }

  toggle(id: string): void {
    const isSeen = this.host?.isInSight(id) ?? true;
    if (this.store.get().openPanels.includes(id) && isSeen) this.close(id);
    else this.open(id);
  }
}
