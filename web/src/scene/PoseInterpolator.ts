// Turns updates that arrive now and then into poses for every frame: shows the recent past, a little
// more than one update ago, between the two updates around that instant.
//
// Poses are lists of seven numbers (x y z qx qy qz qw). Times are wall-clock milliseconds; simulated
// time may run at any factor.

const LONGEST_HISTORY = 32;
const FIRST_INTERVAL_MS = 40;
const SHORTEST_DELAY_MS = 40;
const LONGEST_DELAY_MS = 300;
// The delay in intervals: above one, so that the next update is there before it is needed.
const DELAY_INTERVALS = 1.6;
// How much of an arrival's jitter is believed.
const JITTER_TRUST = 0.15;

export interface PoseSample {
  step: number;
  stamp: number; // s, simulated
  poses: Float64Array;
}

interface TimedSample extends PoseSample {
  shownAtMs: number; // on the smoothed time line of arrivals
}

export class PoseInterpolator {
  private samples: TimedSample[] = [];
  private intervalMs = FIRST_INTERVAL_MS;
  private lastArrivalMs = -Infinity;

  clear(): void {
    this.samples = [];
    this.lastArrivalMs = -Infinity;
  }

  // An older step than the last (a reset) or another number of poses starts a new history.
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

  // The poses at that simulated instant, if it is among the recent ones.
  at(stamp: number): Float64Array | null {
    return this.samples.findLast((sample) => sample.stamp === stamp)?.poses ?? null;
  }

  // How long ago what is shown happened.
  get delayMs(): number {
    return Math.min(LONGEST_DELAY_MS, Math.max(SHORTEST_DELAY_MS, DELAY_INTERVALS * this.intervalMs));
  }

  // Writes the poses to show at `nowMs`; false when there are none yet.
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

  // Whether what `read` gives stays the same until the next update arrives.
  isSettled(nowMs: number): boolean {
    const last = this.samples.at(-1);
    return !last || nowMs - this.delayMs >= last.shownAtMs;
  }

  private placeInTime(previous: TimedSample | undefined, nowMs: number): number {
    if (!previous) return nowMs;
    const gap = nowMs - this.lastArrivalMs;
    if (gap > LONGEST_DELAY_MS) {
      // After a pause: move from where it stood, over one interval.
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

// The normalised straight line between two unit quaternions, the short way round: between two
// updates the angle is small, where it agrees with the great arc.
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
