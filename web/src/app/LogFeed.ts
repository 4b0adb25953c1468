// Collects the lines of /rosout: of what runs as they come, from when the panel is first opened; of a
// recording all at once.
import type { SimulationApi } from "../api/SimulationApi";
import type { LogMessage } from "../protocol/messages";
import { seconds } from "../protocol/messages";
import { NO_LOG, withLine } from "../state/log";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { shallowEqual } from "../state/Store";
import { notify } from "./notices";
import type { Session } from "./Session";

const TOPIC = "/rosout";

export class LogFeed {
  private end: (() => void) | null = null;
  private heard: string | null = null; // the simulation whose lines are there
  private wasReplay = false;

  constructor(
    private readonly store: Store<State>,
    private readonly session: Pick<Session, "subscribe">,
    private readonly api: Pick<SimulationApi, "log">,
  ) {}

  start(): void {
    this.store.watch(
      ({ simulation, replay, log, scene }) => ({
        simulation,
        isReplay: replay !== null,
        isOpen: log.open,
        isThere: scene !== null,
      }),
      (now) => this.listen(now.simulation, now.isReplay, now.isOpen && now.isThere),
      shallowEqual,
    );
  }

  private listen(simulation: string | null, isReplay: boolean, isWanted: boolean): void {
    if (simulation !== this.heard || isReplay !== this.wasReplay) this.forget();
    if (!isWanted || simulation === null || this.heard !== null) return;
    this.heard = simulation;
    this.wasReplay = isReplay;
    if (isReplay) void this.fetch(simulation);
    else this.end = this.session.subscribe<LogMessage>(TOPIC, (message) => this.take(message));
  }

  private take({ stamp, level, name, msg }: LogMessage): void {
    const line = { time: seconds(stamp), level, name, text: msg };
    this.store.set(({ log }) => ({ log: { ...log, lines: withLine(log.lines, line) } }));
  }

  private async fetch(simulation: string): Promise<void> {
    try {
      const lines = await this.api.log(simulation);
      if (this.heard !== simulation) return;
      this.store.set(({ log }) => ({ log: { ...log, lines } }));
    } catch (error) {
      notify(this.store, "error", `The log cannot be read: ${(error as Error).message}`);
    }
  }

  private forget(): void {
    this.end?.();
    this.end = null;
    this.heard = null;
    if (this.store.get().log.lines.length > 0) {
      this.store.set(({ log }) => ({ log: { ...log, lines: NO_LOG.lines } }));
    }
  }
}
