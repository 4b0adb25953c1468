// Computes messages and bytes per second from counters that only increase.
export interface Count {
  messages: number;
  bytes: number;
}

// The rates of one topic.
export interface Traffic {
  rate: number; // messages a second of wall-clock time
  bytesPerSecond: number;
}

const WINDOW_MS = 3000;

export class Rates {
  private readonly samples: { atMs: number; counts: ReadonlyMap<string, Count> }[] = [];

  // Adds the current counters. Returns the rates over the time since the oldest stored sample.
  update(counts: ReadonlyMap<string, Count>, nowMs: number): Map<string, Traffic> {
    const copy = new Map([...counts].map(([topic, { messages, bytes }]) => [topic, { messages, bytes }]));
    this.samples.push({ atMs: nowMs, counts: copy });
    while (this.samples.length > 2 && nowMs - this.samples[1]!.atMs >= WINDOW_MS) this.samples.shift();
    const oldest = this.samples[0]!;
    const seconds = (nowMs - oldest.atMs) / 1000;
    const traffic = new Map<string, Traffic>();
    if (seconds <= 0) return traffic;
    for (const [topic, { messages, bytes }] of copy) {
      const before = oldest.counts.get(topic) ?? { messages: 0, bytes: 0 };
      const rate = Math.max(0, messages - before.messages) / seconds;
      traffic.set(topic, { rate, bytesPerSecond: Math.max(0, bytes - before.bytes) / seconds });
    }
    return traffic;
  }

  clear(): void {
    this.samples.length = 0;
  }
}
