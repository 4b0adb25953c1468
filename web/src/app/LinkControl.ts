// Makes links to the present view. If the page's address contains a simulation, a time or a view,
// opens them.
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import type { LinkedView, Viewpoint } from "../state/link";
import { hashOf, linkedView } from "../state/link";

// The camera that a link contains.
export interface Place {
  viewpoint: Viewpoint;
}

// The functions of the page that a link uses.
export interface LinkedPage {
  select(robot: string): void;
  pause(): Promise<void>;
  seek(time: number): Promise<void>; // simulated time, s: of a recording, or of the stored past of a run
}

// The functions for layouts that a link uses.
export interface LinkedLayouts {
  readonly linkText: string | null;
  showText(text: string, what: string): boolean;
}

export class LinkControl {
  private wanted: LinkedView | null = null;
  private instant: number | null = null; // simulated time, s, to which the page goes as soon as possible

  constructor(
    private readonly store: Store<State>,
    private readonly page: LinkedPage,
    private readonly place: () => Place | null, // null if there is no 3D view
    private readonly layouts: LinkedLayouts | null = null,
  ) {}

  // Shows the content of the page's address as soon as it is available. Does this again after each
  // change of the address.
  start(window: Window): void {
    const read = () => {
      this.wanted = linkedView(window.location.hash);
      this.show();
    };
    window.addEventListener("hashchange", () => {
      read();
      const { layout } = linkedView(window.location.hash);
      if (layout !== null) this.layouts?.showText(layout, "The layout in the page's address");
    });
    this.store.watch(
      ({ scene, status, view }) => scene !== null && status !== null && view !== "starting",
      // The 3D view watches the scene, too, and moves its camera for a new world. The view of the
      // link counts, so it is applied after all watchers have received the scene.
      () => queueMicrotask(() => this.show()),
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
    // The link contains the recording and not this page's replay. Each page that opens the link
    // gets its own replay.
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

  // Goes to the instant in the address, and pauses the replay. It may take some time until the page
  // knows that it shows a recording.
  private async goToInstant(): Promise<void> {
    const { replay, kept, status } = this.store.get();
    const time = this.instant;
    if (time === null || (!replay && !kept)) return;
    this.instant = null;
    // A time outside of the stored part of a run's past is ignored.
    if (!replay && kept && (time < kept.start || time > kept.end)) return;
    if (replay && status?.phase === "running") await this.page.pause();
    await this.page.seek(time);
  }
}
