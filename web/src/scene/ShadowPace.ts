// Selects the frames in which shadows are drawn again. While frames are fast, these are all frames
// in which something has moved. While frames are slow, only every fourth frame is selected: drawing
// the shadows of a thousand robots takes as long as drawing the robots.

const SLOW_MS = 90;
const FRAMES_APART = 4;

export class ShadowPace {
  private isStale = false;
  private isSlow = false;
  private since = 0; // number of frames since the shadows were drawn

  // Takes the time that a frame has taken.
  frameTook(milliseconds: number): void {
    this.isSlow = milliseconds > SLOW_MS;
  }

  // Call this when a body has moved since the last frame.
  moved(): void {
    this.isStale = true;
  }

  // Returns whether shadows are due. Call this once per frame. When the motion ends, shadows are
  // due at once.
  areDue(isMoving: boolean): boolean {
    this.since += 1;
    if (!this.isStale || (this.isSlow && isMoving && this.since < FRAMES_APART)) return false;
    this.isStale = false;
    this.since = 0;
    return true;
  }
}
