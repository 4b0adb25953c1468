// Counts the frames drawn in the last second, and reports them about once per second.
const WINDOW_MS = 1000;

export class FrameRate {
  private since = { ms: 0, frames: 0 };

  constructor(private readonly tell: (framesPerSecond: number) => void) {}

  // `frames` is the number of frames drawn so far.
  count(frames: number, nowMs: number): void {
    const { ms, frames: then } = this.since;
    if (nowMs - ms < WINDOW_MS) return;
    this.tell(((frames - then) * 1000) / (nowMs - ms));
    this.since = { ms: nowMs, frames };
  }
}
