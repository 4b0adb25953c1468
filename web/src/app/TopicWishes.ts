// Among very many sensors a server lists the topics of the first ones by itself, and those of another
// robot when it is asked for them (docs/formats/live.md). Asks for the robots whose sensors the page
// listens to in vain.
import type { SimulationApi } from "../api/SimulationApi";
import type { State } from "../state/State";
import type { Store } from "../state/Store";

// What was subscribed just now may be listed by itself within this time.
const LISTED_MS = 300;

export class TopicWishes {
  private timer: ReturnType<typeof setTimeout> | undefined;

  // `missing` gives the topics that are subscribed and not listed.
  constructor(
    private readonly api: Pick<SimulationApi, "listTopics">,
    private readonly store: Store<State>,
    private readonly missing: () => string[],
  ) {}

  // Something was subscribed, or the connection is new.
  lookSoon(): void {
    this.timer ??= setTimeout(() => {
      this.timer = undefined;
      this.ask();
    }, LISTED_MS);
  }

  private ask(): void {
    const { simulation, scene } = this.store.get();
    if (simulation === null || !scene) return;
    const missing = new Set(this.missing());
    if (missing.size === 0) return;
    for (const { name, sensors } of scene.bodies) {
      if (!missing.has(`/gsv/beams/${name}`) && !sensors.some(({ topic }) => missing.has(topic))) continue;
      // Without an answer nothing comes on these topics; a new connection asks again.
      this.api.listTopics(simulation, name).catch(() => {});
    }
  }
}
