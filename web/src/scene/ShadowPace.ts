// Which frames draw shadows anew: all where something moved, as long as frames are fast. Shadows of a
// thousand robots cost as much as the robots: where frames are slow, only every fourth does.

const SLOW_MS = 90;
const FRAMES_APART = 4;

export class ShadowPace {
  private isStale = false;
  private isSlow = false;
  private since = 0; // frames

  // Told how long a frame took.
  frameTook(milliseconds: number): void {
    this.isSlow = milliseconds > SLOW_MS;
  }

  // Something stands elsewhere than in the last frame.
  moved(): void {
    this.isStale = true;
  }

  // Asked once a frame. What has come to rest has its shadow at once.
  areDue(isMoving: boolean): boolean {
    this.since += 1;
    if (!this.isStale || (this.isSlow && isMoving && this.since < FRAMES_APART)) return false;
    this.isStale = false;
    this.since = 0;
    return true;
  }
}
