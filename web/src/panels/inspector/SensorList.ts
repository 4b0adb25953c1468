// The sensors of the selected robot with their readings. Their topics are subscribed only while the
// list is open.
import type { SceneBody, SceneSensor } from "../../api/scene";
import type { LiveValue } from "../../live/values";
import { valuesOf } from "../../live/values";
import { shallowEqual } from "../../state/Store";
import { element, setText } from "../../ui/element";
import { formatValue } from "../../ui/format";
import { icon } from "../../ui/icons";
import type { PanelPorts } from "../contract/ports";
import { plotButton } from "./plotButton";

type Ports = Pick<PanelPorts, "state" | "topics" | "cameras" | "plots">;

const UPDATE_MS = 200; // period of updates, so that numbers can be read
const LARGE_TYPES = ["depth_camera"]; // sensor types whose readings are point clouds

export function createSensorList(ports: Ports): HTMLElement {
  const list = element("ul", { class: "sensors", "aria-label": "Sensors" });
  const summary = element("summary", {}, "Sensors");
  const details = element("details", { class: "sensor-list", open: true }, summary, list);
  const readings = new Readings(ports);

  let isOpen = details.open;

  const refresh = () => {
    const { selection, scene } = ports.state.get();
    const body = scene?.bodies.find(({ name }) => name === selection) ?? null;
    details.hidden = !body || body.sensors.length === 0;
    setText(summary, `Sensors (${body?.sensors.length ?? 0})`);
    list.replaceChildren(...readings.show(body, isOpen));
  };
  details.addEventListener("toggle", () => {
    // browsers also report this event for a list that was open from the start
    if (details.open === isOpen) return;
    isOpen = details.open;
    refresh();
  });
  ports.state.watch(({ selection, scene }) => ({ selection, scene }), refresh, shallowEqual);
  return details;
}

// Whether the list may subscribe to the sensor without a request by the user. Images and point
// clouds are too large for this.
export function isLight({ overlay, type }: SceneSensor): boolean {
  return overlay !== "picture" && !LARGE_TYPES.includes(type);
}

class Readings {
  private rows: SensorRow[] = [];
  private ends: (() => void)[] = [];
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly ports: Ports) {}

  // If `isOpen`, subscribes to the sensors of the body, and ends the previous subscriptions.
  // Returns the rows.
  show(body: SceneBody | null, isOpen: boolean): HTMLElement[] {
    for (const end of this.ends) end();
    clearTimeout(this.timer);
    this.timer = undefined;
    this.rows = (body?.sensors ?? []).map((sensor) => new SensorRow(this.ports, body!.name, sensor));
    this.ends = (isOpen ? this.rows : [])
      .filter(({ sensor }) => isLight(sensor))
      .map((row) =>
        this.ports.topics.subscribe<unknown>(row.sensor.topic, (message) => {
          row.newest = message;
          this.timer ??= setTimeout(() => this.write(), UPDATE_MS);
        }),
      );
    return this.rows.map(({ item }) => item);
  }

  private write(): void {
    this.timer = undefined;
    for (const row of this.rows) row.write();
  }
}

class SensorRow {
  readonly item: HTMLLIElement;
  newest: unknown = null; // the newest message, which is not shown yet
  private readonly values = element("dl", { class: "values" });
  private readonly cells = new Map<string, HTMLElement>();

  constructor(
    private readonly ports: Ports,
    private readonly robot: string,
    readonly sensor: SceneSensor,
  ) {
    const head = element(
      "div",
      { class: "sensor-head" },
      element("span", { class: "sensor-name" }, sensor.name),
      element("span", { class: "dim" }, sensor.type.replaceAll("_", " ")),
      sensor.overlay === "picture" && this.pictureButton(),
    );
    this.item = element("li", { "data-sensor": sensor.name }, head, this.values);
  }

  write(): void {
    if (this.newest === null) return;
    const values = valuesOf(this.newest, this.sensor.units);
    this.newest = null;
    if (values.length !== this.cells.size || values.some(({ key }) => !this.cells.has(key))) {
      this.build(values);
    }
    for (const { key, unit, value } of values) setText(this.cells.get(key)!, formatValue(value, unit));
  }

  private build(values: LiveValue[]): void {
    this.cells.clear();
    this.values.replaceChildren(
      ...values.flatMap(({ key, unit }) => {
        const cell = element("span", { class: "number" });
        this.cells.set(key, cell);
        const { topic, name } = this.sensor;
        const plot = plotButton(`Plot ${name} ${labelOf(key)}`, () =>
          this.ports.plots.add({ kind: "sensor", topic }, key, unit),
        );
        return [element("dt", { title: key }, labelOf(key)), element("dd", {}, cell, plot)];
      }),
    );
  }

  private pictureButton(): HTMLElement {
    const label = `Show the image of ${this.sensor.name}`;
    const { robot, sensor } = this;
    return element(
      "button",
      {
        class: "button plain small",
        type: "button",
        "aria-label": label,
        title: label,
        onclick: () => this.ports.cameras.show({ robot, sensor: sensor.name, topic: sensor.topic }),
      },
      icon("camera"),
    );
  }
}

// Returns a label, such as "position x" for "pose.pose.position.x", or "ranges min" for
// "ranges.min".
export function labelOf(key: string): string {
  const parts = key.split(/\.(?![^[]*\])/);
  return parts.slice(-2).join(" ").replaceAll("_", " ");
}
