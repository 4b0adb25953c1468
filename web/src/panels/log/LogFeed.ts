// Collects the lines of /rosout. The lines of a running simulation are collected as they arrive.
// The lines of a recording are read all at once.
import type { LogMessage } from "../../protocol/messages";
import { seconds } from "../../protocol/messages";
import type { Store } from "../../state/Store";
import { shallowEqual } from "../../state/Store";
import type { PanelPorts } from "../contract/ports";
import type { Log } from "./log";
import { NO_LOG, withLine } from "./log";

const TOPIC = "/rosout";

export type LogPorts = Pick<PanelPorts, "state" | "topics" | "notices"> & {
  server: Pick<PanelPorts["server"], "log">;
};

export class LogFeed {
  private end: (() => void) | null = null;
  private heard: string | null = null; // the simulation whose lines are stored
  private wasReplay = false;

  constructor(
    private readonly store: Store<Log>,
    private readonly ports: LogPorts,
  ) {}

  start(): void {
    this.ports.state.watch(
      ({ simulation, replay, scene }) => ({ simulation, isReplay: replay !== null, isThere: scene !== null }),
      ({ simulation, isReplay, isThere }) => this.listen(simulation, isReplay, isThere),
      shallowEqual,
    );
  }

  private listen(simulation: string | null, isReplay: boolean, isThere: boolean): void {
    if (simulation !== this.heard || isReplay !== this.wasReplay) this.forget();
    if (!isThere || simulation === null || this.heard !== null) return;
    this.heard = simulation;
    this.wasReplay = isReplay;
    if (isReplay) void this.fetch(simulation);
    else this.end = this.ports.topics.subscribe<LogMessage>(TOPIC, (message) => this.take(message));
  }

  private take({ stamp, level, name, msg }: LogMessage): void {
    const line = { time: seconds(stamp), level, name, text: msg };
    // After a reset, the simulated time starts again. The lines of the earlier run are removed.
    const isReset = name === "gsv" && msg === "reset";
    this.store.set(({ lines }) => ({ lines: withLine(isReset ? NO_LOG.lines : lines, line) }));
  }

  private async fetch(simulation: string): Promise<void> {
    try {
      const lines = await this.ports.server.log(simulation);
      if (this.heard === simulation) this.store.set({ lines });
    } catch (error) {
      this.ports.notices.notify("error", `Cannot read the log: ${(error as Error).message}`);
    }
  }

  private forget(): void {
    this.end?.();
    this.end = null;
    this.heard = null;
    this.store.set({ lines: NO_LOG.lines });
  }
}
