// Collects the events that plots mark. For a recording, these are all events. For a running
// simulation, they are the new events and the hundred events before them.
import type { RecordedEvent } from "../../api/replay";
import type { LifecycleEventMessage } from "../../protocol/messages";
import { seconds } from "../../protocol/messages";
import type { Mark } from "../../plot/TimeCharts";
import type { PanelPorts } from "../contract/ports";

const TOPIC = "/gsv/events";
const MAX_KEPT = 500;
const BAD = new Set(["agent_dead", "agent_unresponsive", "failed", "expectation_violated"]);

export class PlotEvents {
  private live: RecordedEvent[] = [];
  private simulation: string | null = null;

  constructor(private readonly ports: Pick<PanelPorts, "state" | "topics">) {}

  // Collects events until the returned function is called.
  open(onChange: () => void): () => void {
    return this.ports.topics.subscribe<LifecycleEventMessage>(TOPIC, ({ stamp, event, robot, detail }) => {
      this.take({ time: seconds(stamp), event, robot, detail });
      onChange();
    });
  }

  marks(): Mark[] {
    const { replay, events, simulation } = this.ports.state.get();
    const shown = replay ? events : simulation === this.simulation ? this.live : [];
    return shown.map(({ time, event, robot, detail }) => ({
      time,
      label: [event.replaceAll("_", " "), robot, detail].filter((text) => text !== "").join(" "),
      isBad: BAD.has(event),
    }));
  }

  // Adds an event, unless it is already in the list, because a new subscription repeats earlier
  // events. A reset or another simulation starts a new list.
  private take(event: RecordedEvent): void {
    const { simulation } = this.ports.state.get();
    if (simulation !== this.simulation || event.event === "reset") this.live = [];
    this.simulation = simulation;
    const isThere = this.live.some((each) => each.time === event.time && each.event === event.event && each.robot === event.robot && each.detail === event.detail);
    if (!isThere) this.live = [...this.live, event].slice(-MAX_KEPT);
  }
}
