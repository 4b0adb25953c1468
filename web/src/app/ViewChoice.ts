// Chooses whether the browser or the server draws the view. By default, the server draws it if the
// browser has no WebGL or is slow. The user's choice has priority, and is stored. While the browser
// has lost WebGL, the server draws even if the user has chosen the browser.
import type { Store } from "../state/Store";
import type { Drawer, State } from "../state/State";

export interface ChoiceOptions {
  canDraw: boolean; // whether the browser has WebGL
  inSoftware: boolean; // whether the browser draws without a graphics card
  chosen: string | null; // the user's choice, stored earlier or in the address
}

const SLOW_FPS = 10;
const SLOW_SECONDS = 5; // number of consecutive slow seconds after which the server draws

const LOST_MS = 3000; // the browser usually restores WebGL within this time

const NO_WEBGL = "This browser has no WebGL, so the server draws the view. Everything else works as usual.";
const SLOW = `This browser draws fewer than ${SLOW_FPS} images per second, so the server draws the view now. To change this, click “drawn by the server” in the status bar.`;
const LOST =
  "The browser has lost the graphics card, so the server draws the view now. The browser draws it again when the graphics card is back; if it does not come back, reload the page.";
const RESTORED = "The graphics card is back, so the browser draws the view again.";

export class ViewChoice {
  private slowSeconds = 0;
  private hasGraphics = true; // false while the browser has lost WebGL
  private lossTimer: ReturnType<typeof setTimeout> | undefined;
  private isForLoss = false; // whether the server draws because the browser has lost WebGL
  private isByHand: boolean;
  private serverFails = false;

  constructor(
    private readonly store: Store<State>,
    private readonly options: ChoiceOptions,
    private readonly use: (drawer: Drawer) => void,
    private readonly explain: (sentence: string) => void, // called with the reason if something else than the user decides who draws
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

  // Called when the browser has lost WebGL, and when WebGL is back.
  graphics(isThere: boolean): void {
    this.hasGraphics = isThere;
    this.store.set({ whyNotBrowser: this.whyNotBrowser });
    this.followGraphics();
    if (!isThere || !this.isForLoss) return;
    this.isForLoss = false;
    this.set("browser");
    this.explain(RESTORED);
  }

  choose(drawer: Drawer): void {
    this.isByHand = true;
    this.isForLoss = false;
    this.serverFails = false;
    this.set(drawer);
  }

  // Called if the server draws no images. Returns false if the browser cannot draw either.
  serverFailed(): boolean {
    this.serverFails = true;
    this.isForLoss = false;
    if (!this.options.canDraw) return false;
    this.set("browser");
    return true;
  }

  // Lets the server draw after serverFailed(). The user's choice stays as it is.
  askServerAgain(): void {
    this.serverFails = false;
    this.set("server");
  }

  private set(drawer: Drawer): void {
    this.slowSeconds = 0;
    this.store.set({ drawnBy: drawer, whyNotBrowser: this.whyNotBrowser });
    this.use(drawer);
    this.followGraphics();
  }

  private get whyNotBrowser(): string {
    if (!this.options.canDraw) return "This browser has no WebGL, so the server draws the view";
    return this.hasGraphics ? "" : "The browser has lost the graphics card, so the server draws the view";
  }

  // If WebGL is lost while the browser draws the view, the server draws it after LOST_MS.
  private followGraphics(): void {
    clearTimeout(this.lossTimer);
    const isLost = () => !this.hasGraphics && this.store.get().drawnBy === "browser" && !this.serverFails;
    if (!isLost()) return;
    this.lossTimer = setTimeout(() => {
      if (!isLost()) return;
      this.isForLoss = true;
      this.set("server");
      this.explain(LOST);
    }, LOST_MS);
  }
}
