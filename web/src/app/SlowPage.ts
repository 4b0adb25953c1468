// Finds out why data arrives late: either this page is too slow for the data that the server sends,
// or the connection is slow. The server cannot distinguish the two cases: in both, the browser
// confirms received data late. If the page is busy, timers run late. Then the page receives many
// bytes at once, because the browser has stored the messages. Over a slow connection, the browser
// has no messages to store.

const TICK_MS = 100;
const WINDOW_MS = 8000; // a judgement uses the ticks of this period
const DECIDE_MS = 2000; // time from start() to the first judgement
// After the page was slow, it still counts as slow for this time. The reason is that the server
// reports late that the connection is good again.
const HOLD_MS = 10_000;
// Minimum sum of the ticks' delays in a busy page, as a fraction of the period.
const MIN_LATE_SHARE = 1 / 3;
const MIN_BYTES = 32 << 10; // minimum mean number of bytes that a busy page receives between two ticks

interface Tick {
  at: number; // ms
  late: number; // ms
  bytes: number; // bytes received since the previous tick
}

export class SlowPage {
  private ticks: Tick[] = [];
  private timer: ReturnType<typeof setTimeout> | undefined;
  private before = { at: 0, bytes: 0 };
  private began = 0; // ms
  private lastSlow = -Infinity; // ms

  // `received` returns the number of bytes that the page has received. `onJudged` is called with
  // each judgement between start() and stop().
  constructor(
    private readonly received: () => number,
    private readonly onJudged: (isSlow: boolean) => void,
  ) {}

  get isMeasuring(): boolean {
    return this.timer !== undefined;
  }

  start(): void {
    if (this.isMeasuring) return;
    this.ticks = [];
    this.lastSlow = -Infinity;
    this.began = performance.now();
    this.before = { at: this.began, bytes: this.received() };
    this.timer = setTimeout(() => this.tick(), TICK_MS);
  }

  stop(): void {
    clearTimeout(this.timer);
    this.timer = undefined;
  }

  private tick(): void {
    const [at, bytes] = [performance.now(), this.received()];
    this.ticks.push({ at, late: Math.max(0, at - this.before.at - TICK_MS), bytes: bytes - this.before.bytes });
    this.ticks = this.ticks.filter((tick) => at - tick.at < WINDOW_MS);
    this.before = { at, bytes };
    this.timer = setTimeout(() => this.tick(), TICK_MS);
    if (at - this.began < DECIDE_MS) return;
    if (this.isSlow()) this.lastSlow = at;
    this.onJudged(at - this.lastSlow < HOLD_MS);
  }

  private isSlow(): boolean {
    const sum = (of: (tick: Tick) => number) => this.ticks.reduce((total, tick) => total + of(tick), 0);
    const late = sum((tick) => tick.late);
    const elapsed = late + TICK_MS * this.ticks.length;
    return late / elapsed >= MIN_LATE_SHARE && sum((tick) => tick.bytes) / this.ticks.length >= MIN_BYTES;
  }
}
