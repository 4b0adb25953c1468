// Chooses whether the browser or the server draws the view. The server draws it if the browser has no WebGL or
// is slow. If a person chooses, that choice is kept.
import type { Store } from "../state/Store";
import type { Drawer, State } from "../state/State";

export interface ChoiceOptions {
  canDraw: boolean; // the browser has WebGL
  inSoftware: boolean; // no graphics card draws
  chosen: string | null; // by hand, earlier or in the address
}

const SLOW_FPS = 10;
const SLOW_SECONDS = 5; // in a row

export class ViewChoice {
  private slowSeconds = 0;
  private isByHand: boolean;
  private serverFails = false;

  constructor(
    private readonly store: Store<State>,
    private readonly options: ChoiceOptions,
    private readonly use: (drawer: Drawer) => void,
  ) {
    this.isByHand = options.chosen === "browser" || options.chosen === "server";
  }

  start(): void {
    const { canDraw, chosen } = this.options;
    this.set(!canDraw || chosen === "server" ? "server" : "browser");
  }

  // Called about once per second while frames are drawn.
  frameRate(framesPerSecond: number): void {
    if (this.store.get().drawnBy === "server" || this.isByHand || this.serverFails || !this.options.inSoftware) return;
    this.slowSeconds = framesPerSecond > 0 && framesPerSecond < SLOW_FPS ? this.slowSeconds + 1 : 0;
    if (this.slowSeconds >= SLOW_SECONDS) this.set("server");
  }

  // The user's choice. Null if there is no choice.
  get other(): Drawer | null {
    if (this.store.get().drawnBy === "browser") return "server";
    return this.options.canDraw ? "browser" : null;
  }

  choose(drawer: Drawer): void {
    this.isByHand = true;
    this.serverFails = false;
    this.set(drawer);
  }

  // The server draws no images. Returns false if the browser cannot draw either.
  serverFailed(): boolean {
    this.serverFails = true;
    if (!this.options.canDraw) return false;
    this.set("browser");
    return true;
  }

  private set(drawer: Drawer): void {
    this.slowSeconds = 0;
    this.store.set({ drawnBy: drawer });
    this.use(drawer);
  }
}
