// Collects how things are while the panel is open: /diagnostics of the stream, the server's figures, and
// how many updates this page was too slow for.
import type { MetricsApi } from "../api/MetricsApi";
import type { DiagnosticArrayMessage } from "../protocol/messages";
import type { Diagnosis, Diagnostics, Health } from "../state/diagnostics";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { shallowEqual } from "../state/Store";
import type { Session } from "./Session";

const TOPIC = "/diagnostics";
const POLL_MS = 2000;
const HEALTH: readonly Health[] = ["ok", "warning", "error"];

export class DiagnosticsFeed {
  private end = () => {};
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly store: Store<State>,
    private readonly session: Pick<Session, "subscribe" | "parameter">,
    private readonly metrics: Pick<MetricsApi, "figures">,
  ) {}

  start(): void {
    this.store.watch(
      ({ simulation, scene, diagnostics }) => ({ simulation, isWanted: diagnostics.open, isThere: scene !== null }),
      ({ isWanted, isThere }) => {
        this.end();
        const listens = isWanted && isThere;
        this.end = listens ? this.session.subscribe<DiagnosticArrayMessage>(TOPIC, (message) => this.take(message)) : () => {};
        clearTimeout(this.timer);
        if (isWanted) void this.follow();
      },
      shallowEqual,
    );
  }

  private take({ status }: DiagnosticArrayMessage): void {
    const [simulation = null, ...robots] = status.map(
      ({ name, level, message, values }): Diagnosis => ({
        name,
        health: HEALTH[Number(level)] ?? "error",
        message,
        values: values.map(({ key, value }) => [key, value]),
      }),
    );
    this.patch({ simulation, robots });
  }

  private async follow(): Promise<void> {
    await this.load();
    clearTimeout(this.timer);
    if (this.store.get().diagnostics.open) this.timer = setTimeout(() => void this.follow(), POLL_MS);
  }

  async load(): Promise<void> {
    const [server, dropped] = await Promise.all([
      this.metrics.figures().catch(() => null),
      this.session.parameter("/gsv/dropped_updates"),
    ]);
    this.patch({ server, dropped: typeof dropped === "number" ? dropped : null });
  }

  private patch(change: Partial<Diagnostics>): void {
    this.store.set(({ diagnostics }) => ({ diagnostics: { ...diagnostics, ...change } }));
  }
}
