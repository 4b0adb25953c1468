// The output of the selected robot's behaviour: its standard output and errors. The output is read
// only while the list is open.
import type { OutputLine } from "../../api/health";
import type { LogMessage } from "../../protocol/messages";
import { seconds } from "../../protocol/messages";
import { shallowEqual } from "../../state/Store";
import { element } from "../../ui/element";
import { formatTime } from "../../ui/format";
import type { PanelPorts } from "../contract/ports";

type Ports = Pick<PanelPorts, "state" | "topics" | "server">;

const TOPIC = "/gsv/output";
const MOST_LINES = 200;
const WARNING = 30;
const ERROR = 40;

export function createOutput(ports: Ports): HTMLElement {
  const lines = element("div", { class: "output-lines", role: "log", "aria-label": "Output", tabindex: "0" });
  const details = element("details", { class: "output", open: true }, element("summary", {}, "Output"), lines);
  const reader = new OutputReader(ports, lines, (isEmpty) => (details.hidden = isEmpty));
  ports.state.watch(
    ({ simulation, selection, connection }) => ({ simulation, selection, isOpen: connection.phase === "open" }),
    () => reader.read(),
    shallowEqual,
  );
  return details;
}

class OutputReader {
  private robot: string | null = null;
  private newest = -Infinity; // simulated time of the newest requested line, s
  private end = () => {};

  constructor(
    private readonly ports: Ports,
    private readonly place: HTMLElement,
    private readonly onEmpty: (isEmpty: boolean) => void,
  ) {}

  read(): void {
    const { simulation, selection, connection } = this.ports.state.get();
    // If the connection is lost, the lines that are shown stay.
    if (connection.phase !== "open" && this.robot === selection) return;
    this.end();
    this.end = () => {};
    this.robot = selection;
    this.newest = -Infinity;
    this.place.replaceChildren();
    this.onEmpty(true);
    if (simulation === null || selection === null) return;
    void this.begin(simulation, selection);
  }

  // Reads the last lines, and then each new line.
  private async begin(simulation: string, robot: string): Promise<void> {
    let isCurrent = true;
    this.end = () => (isCurrent = false);
    const past = await this.past(simulation, robot);
    if (!isCurrent) return;
    for (const line of past) this.add(line);
    this.newest = past.at(-1)?.time ?? -Infinity;
    this.end = this.ports.topics.subscribe<LogMessage>(TOPIC, (message) => this.take(message));
  }

  private async past(simulation: string, robot: string): Promise<OutputLine[]> {
    const { health, replay } = this.ports.state.get();
    if (health === null || replay) return []; // a recording contains no output of behaviours
    try {
      return await this.ports.server.output(simulation, robot);
    } catch {
      return []; // a new subscription of the topic also delivers the last lines
    }
  }

  private take({ stamp, level, name, msg }: LogMessage): void {
    const time = seconds(stamp);
    // After a reset, the simulated time starts again. A line may be a little newer than the clock.
    if (this.ports.state.get().time < this.newest - 1) this.newest = -Infinity;
    const robot = this.ports.state.get().status?.robots.find((each) => each.name === this.robot);
    const behaviour = robot?.behaviour.split(" ")[0]; // the behaviour's name without its options
    if ((name === this.robot || (behaviour && name === behaviour)) && time > this.newest) this.add({ time, level, text: msg });
  }

  private add({ time, level, text }: OutputLine): void {
    const { scrollTop, clientHeight, scrollHeight } = this.place;
    const wasAtEnd = scrollTop + clientHeight >= scrollHeight - 20;
    const kind = level >= ERROR ? "error" : level >= WARNING ? "warning" : "";
    this.place.append(element("div", { class: kind, title: formatTime(time) }, text));
    if (this.place.childElementCount > MOST_LINES) this.place.firstElementChild!.remove();
    if (wasAtEnd) this.place.scrollTop = this.place.scrollHeight;
    this.onEmpty(false);
  }
}
