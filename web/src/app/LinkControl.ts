// Makes links to the present view, and shows what the page's address refers to.
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import type { LinkedView, Viewpoint } from "../state/link";
import { hashOf, linkedView } from "../state/link";

export interface Place {
  viewpoint: Viewpoint;
}

// The functions of the page that a link needs.
export interface LinkedPage {
  select(robot: string): void;
  pause(): Promise<void>;
  seek(time: number): Promise<void>; // s, simulated: of a recording, or of the past of a run
}

export interface LinkedLayouts {
  readonly linkText: string | null;
  showText(text: string, what: string): boolean;
}

export class LinkControl {
  private wanted: LinkedView | null = null;
  private instant: number | null = null; // s, simulated: to go to when it can be done

  constructor(
    private readonly store: Store<State>,
    private readonly page: LinkedPage,
    private readonly place: () => Place | null, // null where there is no 3D view
    private readonly layouts: LinkedLayouts | null = null,
  ) {}

  // Shows what the address refers to, as soon as it is available, and again after each change of
  // the address.
  start(window: Window): void {
    const read = () => {
      this.wanted = linkedView(window.location.hash);
      this.show();
    };
    window.addEventListener("hashchange", () => {
      read();
      const { layout } = linkedView(window.location.hash);
      if (layout !== null) this.layouts?.showText(layout, "The layout in the link");
    });
    this.store.watch(
      ({ scene, status, view }) => scene !== null && status !== null && view !== "starting",
      () => this.show(),
    );
    this.store.watch(
      ({ replay, kept }) => replay !== null || kept !== null,
      () => void this.goToInstant(),
    );
    read();
  }

  // Returns the address of the present view. `page` is the address of the page itself.
  linkTo(page: string): string {
    const { simulations, simulation, replay, time, selection, viewMode, shown, abilities } = this.store.get();
    const url = new URL(page);
    if (simulation !== null && (simulations?.length ?? 0) > 1) url.searchParams.set("simulation", simulation);
    // Everyone who opens the link of a recording has their own replay.
    if (replay && abilities.recording !== "") url.searchParams.set("recording", abilities.recording);
    const viewpoint = this.place()?.viewpoint ?? null;
    url.hash = hashOf({ time: replay ? time : null, viewpoint, selection, viewMode, shown, layout: this.layouts?.linkText ?? null });
    return url.href;
  }

  private show(): void {
    const { store } = this;
    const { scene, status, view } = store.get();
    if (!this.wanted || !scene || !status || view === "starting") return;
    const { time, viewpoint, selection, viewMode, shown } = this.wanted;
    this.wanted = null;
    this.instant = time;
    if (shown) store.set({ shown });
    if (selection !== null && scene.bodies.some(({ name }) => name === selection)) this.page.select(selection);
    if (viewMode && store.get().selection !== null) store.set({ viewMode });
    const place = this.place();
    if (viewpoint && place) place.viewpoint = viewpoint;
    void this.goToInstant();
  }

  // The page may learn only later that it shows a recording. Going to an instant pauses the replay.
  private async goToInstant(): Promise<void> {
    const { replay, kept, status } = this.store.get();
    const time = this.instant;
    if (time === null || (!replay && !kept)) return;
    this.instant = null;
    // A time before or after the kept part of a run is ignored.
    if (!replay && kept && (time < kept.start || time > kept.end)) return;
    if (replay && status?.phase === "running") await this.page.pause();
    await this.page.seek(time);
  }
}
