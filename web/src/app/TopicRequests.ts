// If there are very many sensors, a server lists only the topics of the first sensors. It lists the
// topics of other robots on request (docs/formats/live.md). If the page subscribes to a sensor
// whose topic is not listed, this class requests the topics of the sensor's robot.
import type { SimulationApi } from "../api/SimulationApi";
import type { State } from "../state/State";
import type { Store } from "../state/Store";

// Within this time, the server may still list the topic of a new subscription without a request.
const LISTED_MS = 300;

export class TopicRequests {
  private timer: ReturnType<typeof setTimeout> | undefined;

  // `missing` returns the topics that are subscribed to but not listed.
  constructor(
    private readonly api: Pick<SimulationApi, "listTopics">,
    private readonly store: Store<State>,
    private readonly missing: () => string[],
  ) {}

  // Call this after a new subscription or a new connection.
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
      // A robot without sensors has no topics of readings or beams to list.
      if (sensors.length === 0) continue;
      if (!missing.has(`/gsv/beams/${name}`) && !sensors.some(({ topic }) => missing.has(topic))) continue;
      // If there is no answer, these topics have no messages. A new connection requests them again.
      this.api.listTopics(simulation, name).catch(() => {});
    }
  }
}
