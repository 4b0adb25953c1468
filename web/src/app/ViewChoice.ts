// Chooses whether the browser or the server draws the view. By default, the server draws it if the
// browser has no WebGL or is slow. The user's choice has priority, and is stored.
import type { Store } from "../state/Store";
import type { Drawer, State } from "../state/State";

export interface ChoiceOptions {
  canDraw: boolean; // whether the browser has WebGL
  inSoftware: boolean; // whether the browser draws without a graphics card
  chosen: string | null; // the user's choice, stored earlier or in the address
}

const SLOW_FPS = 10;
const SLOW_SECONDS = 5; // number of consecutive slow seconds after which the server draws

const NO_WEBGL = "This browser has no WebGL, so the server draws the view. Everything else works as usual.";
const SLOW = `This browser draws fewer than ${SLOW_FPS} images per second, so the server draws the view now. To change this, click “drawn by the server” in the status bar.`;

export class ViewChoice {
  private slowSeconds = 0;
  private isByHand: boolean;
  private serverFails = false;

  constructor(
    private readonly store: Store<State>,
    private readonly options: ChoiceOptions,
    private readonly use: (drawer: Drawer) => void,
    private readonly explain: (sentence: string) => void, // called when the server draws without the user's choice
  ) {
    this.isByHand = options.chosen === "browser" || options.chosen === "server";
  }

  start(): void {
    const { canDraw, chosen } = this.options;
    this.set(!canDraw || chosen === "server" ? "server" : "browser");
    if (!canDraw && chosen !== "server") this.explain(NO_WEBGL);
  }

  // Called about once per second while frames are drawn.
  frameRate(framesPerSecond: number): void {
    if (this.store.get().drawnBy === "server" || this.isByHand || this.serverFails || !this.options.inSoftware) return;
    this.slowSeconds = framesPerSecond > 0 && framesPerSecond < SLOW_FPS ? this.slowSeconds + 1 : 0;
    if (this.slowSeconds < SLOW_SECONDS) return;
    this.set("server");
    this.explain(SLOW);
  }

  // The drawer to which the user can change; null if there is no choice.
  get other(): Drawer | null {
    if (this.store.get().drawnBy === "browser") return "server";
    return this.options.canDraw ? "browser" : null;
  }

  choose(drawer: Drawer): void {
    this.isByHand = true;
    this.serverFails = false;
    this.set(drawer);
  }

  // Called if the server draws no images. Returns false if the browser cannot draw either.
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
