// Draws a frame on request, so that a page without changes costs nothing. The next frame begins
// when the previous frame is drawn completely. If it began when the previous frame was submitted, a
// click would wait for all pending frames.

// If the time between two frames is longer, it is not the drawing time. For example, another tab
// was in front.
const LONGEST_FRAME_MS = 10_000;
// If a frame takes longer than this (without a graphics card, for example), the loop pauses between
// frames, so that the page reacts to the user and the simulation gets CPU time.
const EXHAUSTING_MS = 120;
const SHORTEST_REST_MS = 80;
const LONGEST_REST_MS = 400;
// If a frame takes longer than this and the user clicks, the next frame begins ANSWER_MS later, so
// that the page can react to the click first.
const SLOW_MS = 50;
const ANSWER_MS = 120;

// Finds out whether the submitted frame is drawn. Call mark() after the frame is submitted, and
// then poll isReached().
export interface Fence {
  mark(): void;
  isReached(): boolean;
}

const AT_ONCE: Fence = { mark: () => {}, isReached: () => true };

export class RenderLoop {
  frames = 0;
  private scheduled = false;
  private resting: ReturnType<typeof setTimeout> | undefined;
  private beganMs: number | null = null; // start of the frame that is being drawn
  private isWanted = false; // whether another frame is requested
  private isSlow = false; // whether the last frame was slow
  private heldUntilMs = -Infinity;
  private awaitedUntilMs = -Infinity;
  private isUrgent = false; // whether the next frame follows without a pause

  // `draw` returns true if the next frame will differ from this frame. Then the next frame is drawn
  // as well. `onFrameTook` gets the time until a frame was drawn.
  constructor(
    private readonly draw: (nowMs: number) => boolean,
    private readonly onFrameTook: (milliseconds: number) => void,
    private readonly fence = AT_ONCE,
  ) {}

  // Whether a frame is being drawn or requested.
  get isBusy(): boolean {
    return this.isWanted || this.beganMs !== null;
  }

  request(): void {
    this.isWanted = true;
    if (this.resting === undefined) this.schedule();
  }

  // Delays the next frame if frames are slow, so that the page can react first. Call this when the
  // user has pressed something.
  holdBack(): void {
    if (this.isSlow || this.beganMs !== null) this.heldUntilMs = performance.now() + ANSWER_MS;
  }

  // Draws nothing for this time, or until hurry(), because the content is about to be replaced.
  await(milliseconds: number): void {
    this.awaitedUntilMs = performance.now() + milliseconds;
  }

  // Draws the next frame as soon as possible.
  hurry(): void {
    this.awaitedUntilMs = -Infinity;
    this.isUrgent = true;
    clearTimeout(this.resting);
    this.resting = undefined;
    this.request();
  }

  private schedule(): void {
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame((now) => {
      this.scheduled = false;
      this.frame(now);
    });
  }

  private frame(now: number): void {
    if (this.beganMs !== null) {
      const took = now - this.beganMs;
      if (took < LONGEST_FRAME_MS && !this.fence.isReached()) return this.schedule();
      this.beganMs = null;
      this.isSlow = took > SLOW_MS;
      if (took < LONGEST_FRAME_MS) this.onFrameTook(took);
      if (took > EXHAUSTING_MS && took < LONGEST_FRAME_MS && !this.isUrgent) return this.rest(took);
    }
    if (!this.isWanted) return;
    const timeMs = performance.now();
    if (timeMs < this.awaitedUntilMs || (this.isSlow && timeMs < this.heldUntilMs)) return this.schedule();
    this.frames += 1;
    this.beganMs = now;
    this.isUrgent = false;
    this.isWanted = false; // reset before drawing, because drawing may request another frame
    this.isWanted = this.draw(performance.now()) || this.isWanted;
    this.fence.mark();
    this.schedule();
  }

  private rest(took: number): void {
    this.resting = setTimeout(
      () => {
        this.resting = undefined;
        if (this.isWanted) this.schedule();
      },
      Math.min(LONGEST_REST_MS, Math.max(SHORTEST_REST_MS, took / 2)),
    );
  }
}
