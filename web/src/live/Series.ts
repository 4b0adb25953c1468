// The values of one curve, ordered by simulated time. Only the newest MOST_SAMPLES values are
// stored. At one value per second, these are the values of five hours. At the 30 values per second
// of poses, they are the values of eleven minutes.

export const MOST_SAMPLES = 20_000;
const FIRST_CAPACITY = 512;

export class Series {
  private times = new Float64Array(FIRST_CAPACITY);
  private values = new Float64Array(FIRST_CAPACITY);
  private from = 0;
  private to = 0;

  get length(): number {
    return this.to - this.from;
  }

  timeAt(index: number): number {
    return this.times[this.from + index]!;
  }

  valueAt(index: number): number {
    return this.values[this.from + index]!;
  }

  // Adds a value. If there is already a value for this instant, it is replaced. If the instant is
  // before the newest one, the value is inserted in the order of time.
  push(time: number, value: number): void {
    if (this.to === this.times.length) this.makeRoom();
    let at = this.to;
    if (this.length > 0 && time <= this.times[this.to - 1]!) {
      at = this.from + this.firstFrom(time);
      if (this.times[at] === time) {
        this.values[at] = value;
        return;
      }
      for (const list of [this.times, this.values]) list.copyWithin(at + 1, at, this.to);
    }
    this.times[at] = time;
    this.values[at] = value;
    this.to += 1;
    if (this.length > MOST_SAMPLES) this.from += 1;
  }

  clear(): void {
    this.from = this.to = 0;
  }

  // Returns the index of the first sample at or after `time`; `length` if there is none.
  firstFrom(time: number): number {
    let [low, high] = [0, this.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.timeAt(middle) < time) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  // Returns the newest value at or before `time`; null if there is none.
  newestAt(time: number): number | null {
    const after = this.firstFrom(time);
    if (after < this.length && this.timeAt(after) === time) return this.valueAt(after);
    return after > 0 ? this.valueAt(after - 1) : null;
  }

  private makeRoom(): void {
    const { from, to } = this;
    const isFull = this.times.length >= 2 * MOST_SAMPLES;
    const capacity = isFull ? this.times.length : Math.min(2 * MOST_SAMPLES, 2 * this.times.length);
    const moved = (list: Float64Array) => {
      const target = new Float64Array(capacity);
      target.set(list.subarray(from, to));
      return target;
    };
    this.times = moved(this.times);
    this.values = moved(this.values);
    this.from = 0;
    this.to = to - from;
  }
}
