// Draws a frame when somebody asked for one: a page on which nothing changes costs nothing.

// A longer gap is not a slow frame but a page that had nothing to draw.
const LONGEST_FRAME_MS = 1000;
// Without a graphics card a frame may keep the whole machine busy: then the loop rests between two
// frames, for the buttons' sake and the simulation's.
const EXHAUSTING_MS = 150;
const LONGEST_REST_MS = 400;

export class RenderLoop {
  frames = 0;
  private scheduled = 0;
  private resting: ReturnType<typeof setTimeout> | undefined;
  private lastMs = -Infinity;
  private continued = false;

  // `draw` tells whether the next frame will differ, so that it is drawn as well.
  constructor(
    private readonly draw: (nowMs: number) => boolean,
    private readonly onFrameTook: (milliseconds: number) => void,
  ) {}

  request(): void {
    if (this.scheduled || this.resting !== undefined) return;
    this.scheduled = requestAnimationFrame((now) => this.frame(now));
  }

  private frame(now: number): void {
    this.scheduled = 0;
    this.frames += 1;
    const took = now - this.lastMs;
    if (this.continued && took < LONGEST_FRAME_MS) this.onFrameTook(took);
    this.lastMs = now;
    this.continued = this.draw(performance.now());
    if (!this.continued) return;
    if (took > EXHAUSTING_MS && took < LONGEST_FRAME_MS) this.rest(took);
    else this.request();
  }

  private rest(took: number): void {
    this.resting = setTimeout(
      () => {
        this.resting = undefined;
        this.request();
      },
      Math.min(LONGEST_REST_MS, took / 2),
    );
  }
}
