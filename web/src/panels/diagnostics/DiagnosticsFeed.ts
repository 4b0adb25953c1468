// Collects diagnostics: the topic /diagnostics, the server's metrics, and the number of updates
// dropped for this page. start() begins to collect, and returns a function that ends this.
import type { DiagnosticArrayMessage } from "../../protocol/messages";
import type { TopicSource } from "../../protocol/SharedTopics";
import type { Store } from "../../state/Store";
import type { ServerPort } from "../contract/ports";
import type { Diagnosis, Diagnostics, Health } from "./diagnostics";

const TOPIC = "/diagnostics";
const POLL_MS = 2000;
const HEALTH: readonly Health[] = ["ok", "warning", "error"];

export class DiagnosticsFeed {
  private isOn = false;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly store: Store<Diagnostics>,
    private readonly topics: TopicSource,
    private readonly server: Pick<ServerPort, "figures" | "parameter">,
  ) {}

  start(): () => void {
    this.isOn = true;
    const end = this.topics.subscribe<DiagnosticArrayMessage>(TOPIC, (message) => this.take(message));
    void this.follow();
    return () => {
      this.isOn = false;
      clearTimeout(this.timer);
      end();
    };
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
    this.store.set({ simulation, robots });
  }

  private async follow(): Promise<void> {
    await this.load();
    clearTimeout(this.timer);
    if (this.isOn) this.timer = setTimeout(() => void this.follow(), POLL_MS);
  }

  async load(): Promise<void> {
    const [server, dropped] = await Promise.all([
      this.server.figures().catch(() => null),
      this.server.parameter("/gsv/dropped_updates"),
    ]);
    this.store.set({ server, dropped: typeof dropped === "number" ? dropped : null });
  }
}
