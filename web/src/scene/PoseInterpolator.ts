// Computes poses for every frame from updates that arrive irregularly. The displayed instant is
// slightly more than one update ago. Its poses are interpolated between two updates.
//
// Poses are lists of seven numbers (x y z qx qy qz qw). Times are wall-clock milliseconds;
// simulated time may run at any factor.

const LONGEST_HISTORY = 32;
const FIRST_INTERVAL_MS = 40;
const SHORTEST_DELAY_MS = 40;
const LONGEST_DELAY_MS = 300;
// The delay as a multiple of the interval. It is larger than one, so that the next update arrives
// before it is needed.
const DELAY_INTERVALS = 1.6;
// The weight of a new arrival time in the estimate of the interval.
const JITTER_TRUST = 0.15;

// The poses in one update.
export interface PoseSample {
  step: number;
  stamp: number; // s, simulated
  poses: Float64Array;
}

interface TimedSample extends PoseSample {
  shownAtMs: number; // time of arrival, corrected for irregular delays of the network
}

export class PoseInterpolator {
  private samples: TimedSample[] = [];
  private intervalMs = FIRST_INTERVAL_MS;
  private lastArrivalMs = -Infinity;

  clear(): void {
    this.samples = [];
    this.lastArrivalMs = -Infinity;
  }

  // Adds a sample. A sample with an earlier time (after a reset), or with another number of poses,
  // starts a new history.
  push(sample: PoseSample, nowMs: number): void {
    const last = this.samples.at(-1);
    if (last && (sample.step < last.step || sample.poses.length !== last.poses.length)) this.clear();
    const previous = this.samples.at(-1);
    this.samples.push({ ...sample, shownAtMs: this.placeInTime(previous, nowMs) });
    if (this.samples.length > LONGEST_HISTORY) this.samples.shift();
    this.lastArrivalMs = nowMs;
  }

  get latest(): PoseSample | null {
    return this.samples.at(-1) ?? null;
  }

  // Returns the poses at this simulated instant, if it is recent.
  at(stamp: number): Float64Array | null {
    return this.samples.findLast((sample) => sample.stamp === stamp)?.poses ?? null;
  }

  // The age of the displayed poses.
  get delayMs(): number {
    return Math.min(LONGEST_DELAY_MS, Math.max(SHORTEST_DELAY_MS, DELAY_INTERVALS * this.intervalMs));
  }

  // Writes the poses to show at `nowMs`. Returns false if there are none yet.
  read(nowMs: number, out: Float64Array): boolean {
    const last = this.samples.at(-1);
    if (!last || last.poses.length !== out.length) return false;
    const time = nowMs - this.delayMs;
    let after = this.samples.length - 1;
    while (after > 0 && (this.samples[after - 1] as TimedSample).shownAtMs > time) after -= 1;
    const to = this.samples[after] as TimedSample;
    const from = this.samples[after - 1];
    if (!from || time >= to.shownAtMs) {
      out.set(to.poses);
      return true;
    }
    const share = (time - from.shownAtMs) / (to.shownAtMs - from.shownAtMs);
    interpolatePoses(from.poses, to.poses, Math.min(1, Math.max(0, share)), out);
    return true;
  }

  // Writes the poses at a simulated time, or the nearest known ones. Returns false if there are
  // none yet.
  readAt(stamp: number, out: Float64Array): boolean {
    const last = this.samples.at(-1);
    if (!last || last.poses.length !== out.length) return false;
    // An edit in a paused simulation adds a sample with the same time. Of such samples, the newest
    // is used.
    const after = this.samples.findIndex((sample) => sample.stamp > stamp);
    const to = this.samples[after];
    const from = this.samples[after - 1];
    if (to && from) interpolatePoses(from.poses, to.poses, (stamp - from.stamp) / (to.stamp - from.stamp), out);
    else out.set((to ?? last).poses);
    return true;
  }

  // Whether `read` returns the same poses until the next update arrives.
  isSettled(nowMs: number): boolean {
    const last = this.samples.at(-1);
    return !last || nowMs - this.delayMs >= last.shownAtMs;
  }

  private placeInTime(previous: TimedSample | undefined, nowMs: number): number {
    if (!previous) return nowMs;
    const gap = nowMs - this.lastArrivalMs;
    if (gap > LONGEST_DELAY_MS) {
      // After a pause, the displayed poses move from the old to the new poses within one interval.
      previous.shownAtMs = nowMs - this.intervalMs;
      return nowMs;
    }
    this.intervalMs += 0.1 * (gap - this.intervalMs);
    const expected = previous.shownAtMs + this.intervalMs;
    const smoothed = expected + JITTER_TRUST * (nowMs - expected);
    return Math.max(previous.shownAtMs + 1, smoothed);
  }
}

function interpolatePoses(from: Float64Array, to: Float64Array, share: number, out: Float64Array): void {
  for (let i = 0; i < out.length; i += 7) {
    for (let k = i; k < i + 3; k++) out[k] = from[k]! + share * (to[k]! - from[k]!);
    interpolateRotation(from, to, share, out, i + 3);
  }
}

// Interpolates linearly between two unit quaternions, on the shorter arc, and normalises the
// result. The angle between two updates is small, so the result is close to the result of slerp.
function interpolateRotation(
  from: Float64Array,
  to: Float64Array,
  share: number,
  out: Float64Array,
  at: number,
): void {
  let dot = 0;
  for (let k = at; k < at + 4; k++) dot += from[k]! * to[k]!;
  const sign = dot < 0 ? -1 : 1;
  let squared = 0;
  for (let k = at; k < at + 4; k++) {
    const value = from[k]! + share * (sign * to[k]! - from[k]!);
    out[k] = value;
    squared += value * value;
  }
  const scale = squared > 0 ? 1 / Math.sqrt(squared) : 1;
  for (let k = at; k < at + 4; k++) out[k] = out[k]! * scale;
}
