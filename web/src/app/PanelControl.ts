// Opens and closes panels, by their ids in panels/registry.ts.
import type { State } from "../state/State";
import type { Store } from "../state/Store";

export class PanelControl {
  constructor(private readonly store: Store<State>) {}

  open(id: string): void {
    this.store.set(({ openPanels }) => (openPanels.includes(id) ? {} : { openPanels: [...openPanels, id] }));
  }

  close(id: string): void {
    this.store.set(({ openPanels }) => ({ openPanels: openPanels.filter((each) => each !== id) }));
  }

  toggle(id: string): void {
    if (this.store.get().openPanels.includes(id)) this.close(id);
    else this.open(id);
  }
}
