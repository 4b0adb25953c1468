// Shows the data of the selected part of the world, and updates it.
import type { SceneBody, SceneSensor } from "../../api/scene";
import { stampOf, valuesOf } from "../../live/values";
import type { PosesMessage, TransformsMessage } from "../../protocol/messages";
import { element, setText } from "../../ui/element";
import { formatNumber, formatValue } from "../../ui/format";
import { smallButton } from "../../ui/smallButton";
import type { PanelPorts } from "../contract/ports";
import { hasJoints, jointsButton } from "../control/jointsButton";
import type { WorldNode } from "./nodes";
import type { Line } from "./partLines";
import { collisionLines, factsOf, massLines, mountLines, orientationText, poseLines, positionText, sensorLines, visualLines } from "./partLines";
import type { Transforms } from "./Transforms";
import { ageText } from "./Transforms";

type Ports = Pick<PanelPorts, "state" | "topics" | "control" | "shapes" | "robots" | "cameras" | "plots" | "traffic" | "notices">;

const UPDATE_MS = 200; // as fast as numbers can be read
const POSES = "/gsv/poses";

export class NodeInspector {
  private readonly title = element("h2");
  private readonly actions = element("div", { class: "inspector-actions" });
  private readonly facts = element("dl", { class: "inspector-rows" });
  private readonly cells = new Map<string, HTMLElement>();
  readonly element: HTMLElement;
  private end = () => {};

  constructor(
    private readonly ports: Ports,
    private readonly transforms: Transforms,
    label = "Selected part",
  ) {
    this.element = element("section", { class: "world-inspector", tabindex: "0", "aria-label": label }, this.title, this.actions, this.facts);
    this.close();
  }

  close(): void {
    this.end();
    this.end = () => {};
    setText(this.title, "Nothing selected");
    this.actions.replaceChildren();
    this.show([["", "Select a part of the world to see its pose, or the readings of a sensor."]]);
  }

  // Reads the data of the node until another node is opened, or close() is called.
  open(node: WorldNode): void {
    this.end();
    this.facts.replaceChildren();
    this.cells.clear();
    setText(this.title, titleOf(node));
    this.actions.replaceChildren(...this.actionsOf(node));
    if (node.kind === "transform") this.end = this.every(() => this.show(this.transformLines(node.child)));
    else if (node.kind === "sensor") this.end = this.readSensor(node.body, node.sensor);
    else if (node.kind === "joint") this.end = this.readJoint(node.body, node.joint.name, node.joint.kind, node.joint.link);
    else this.end = this.readPose(node.body, node.kind === "link" ? node.name : null);
  }

  private every(update: () => void): () => void {
    update();
    const timer = setInterval(update, UPDATE_MS);
    return () => clearInterval(timer);
  }

  private readPose(body: SceneBody, link: string | null): () => void {
    let newest: PosesMessage | null = null;
    let shapes: Line[] = [];
    let isOn = true;
    const update = () => {
      const { scene, time } = this.ports.state.get();
      this.show([...factsOf(body, link), ...poseLines(scene, newest, body, link, time), ...massLines(scene, body, link), ...shapes]);
    };
    const stop = this.every(update);
    void this.shapeLines(body, link).then((lines) => {
      shapes = lines;
      if (isOn) update();
    });
    const end = this.ports.topics.subscribe<PosesMessage>(POSES, (message) => (newest = message), { newestOnly: true });
    return () => {
      isOn = false;
      stop();
      end();
    };
  }

  private async shapeLines({ model, collisions, links }: SceneBody, link: string | null): Promise<Line[]> {
    const { shapes } = this.ports;
    const isMeant = (visual: { link: string | null }) => link === null || visual.link === link;
    try {
      const visuals = await shapes.visuals(model, links);
      const shown = collisions === null ? [] : await shapes.visuals(collisions, links);
      return [...visualLines(visuals.filter(isMeant)), ...collisionLines(shown.filter(isMeant))];
    } catch (error) {
      return [["Geometry", (error as Error).message]];
    }
  }

  private readSensor(body: SceneBody, sensor: SceneSensor): () => void {
    let newest: unknown = null;
    const facts = sensorLines(body, sensor);
    let mount: Line[] = [];
    const isLarge = sensor.overlay === "picture" || sensor.type === "depth_camera";
    const stop = this.every(() => {
      const stamp = stampOf(newest);
      const age = stamp === null ? [] : [["Age", `${Math.max(0, this.ports.state.get().time - stamp).toFixed(2)} s`] as Line];
      const values = newest === null || isLarge ? [] : valuesOf(newest, sensor.units);
      this.show([...facts, ...mount, ...age, ...values.map(({ key, unit, value }): Line => [key, formatValue(value, unit)])]);
      for (const { key, unit } of values) this.addPlot(key, sensor, unit);
    });
    const { topics } = this.ports;
    const ends = [topics.subscribe<TransformsMessage>("/tf_static", (message) => (mount = mountLines(message, body, sensor)))];
    if (!isLarge) ends.push(topics.subscribe<unknown>(sensor.topic, (message) => (newest = message), { newestOnly: true }));
    return () => {
      stop();
      ends.forEach((end) => end());
    };
  }

  // Adds a plot button beside the value, unless there is already one.
  private addPlot(key: string, { topic, name }: SceneSensor, unit: string): void {
    const cell = this.cells.get(key)?.parentElement;
    if (!cell || cell.querySelector("button")) return;
    cell.append(smallButton("plot", `Plot ${name} ${key}`, () => this.ports.plots.add({ kind: "sensor", topic }, key, unit)));
  }

  private readJoint(body: SceneBody, joint: string, kind: string, link: string | null): () => void {
    const facts: Line[] = [
      ["Of", body.name],
      ["Kind", kind],
      ["Child link", link ?? "does not move relative to the model"],
    ];
    this.show(facts);
    let isOn = true;
    let timer: ReturnType<typeof setTimeout> | undefined;
    const ask = async () => {
      const { simulation, replay } = this.ports.state.get();
      // A replay has no values of joints. The page may return to the running simulation.
      const isAsked = simulation !== null && !replay;
      const told = isAsked ? await this.ports.control.joints(simulation, body.name).catch(() => null) : null;
      const found = told?.joints.find(({ name }) => name === joint);
      if (!isOn) return;
      if (found) {
        const text = (value: number) => `${formatNumber(value, 3)} ${found.unit}`;
        const limits = Number.isFinite(found.minimum + found.maximum) ? `${text(found.minimum)} to ${text(found.maximum)}` : "none";
        this.show([...facts, ["Position", text(found.position)], ["Velocity", `${text(found.velocity)}/s`], ["Limits", limits]]);
      }
      timer = setTimeout(() => void ask(), UPDATE_MS);
    };
    void ask();
    return () => {
      isOn = false;
      clearTimeout(timer);
    };
  }

  private transformLines(child: string): Line[] {
    const frame = this.transforms.get(child);
    if (!frame) return [["", "Waiting for this transform. The page reads transforms only while Transforms is open in the tree."]];
    return [
      ["Parent", frame.parent],
      ["Translation", positionText(frame.position)],
      ["Rotation", orientationText(frame.angles)],
      ["At", `${frame.time.toFixed(2)} s`],
      ["Age", ageText(frame, this.ports.state.get().time)],
    ];
  }

  private actionsOf(node: WorldNode): HTMLElement[] {
    const { robots, cameras, traffic } = this.ports;
    const button = (label: string, onclick: () => void) => element("button", { class: "button small", type: "button", onclick }, label);
    const isRobot = node.kind !== "transform" && (node.body.isRobot || node.body.isAvatar || node.body.isStation);
    const select = isRobot ? [button("Select in the view", () => robots.select(node.body.name))] : [];
    const isMovable = (node.kind === "body" || node.kind === "joint") && hasJoints(node.body) && this.ports.state.get().replay === null;
    if (isMovable) return [...select, jointsButton(this.ports)];
    if (node.kind !== "sensor") return select;
    const { sensor, body } = node;
    const image = sensor.overlay === "picture" ? [button("Show the image", () => cameras.show({ robot: body.name, sensor: sensor.name, topic: sensor.topic }))] : [];
    return [...select, ...image, button("Show messages", () => traffic.open(sensor.topic))];
  }

  private show(lines: readonly Line[]): void {
    const names = lines.map(([name]) => name);
    const isSame = names.length === this.cells.size && names.every((name) => this.cells.has(name));
    if (!isSame) {
      this.cells.clear();
      this.facts.replaceChildren(
        ...lines.flatMap(([name]) => {
          const cell = element("span", { class: "number" });
          this.cells.set(name, cell);
          return [element("dt", {}, name), element("dd", {}, cell)];
        }),
      );
    }
    for (const [name, value] of lines) setText(this.cells.get(name)!, value);
  }
}

function titleOf(node: WorldNode): string {
  switch (node.kind) {
    case "body":
      return node.body.name;
    case "link":
      return `Link ${node.name}`;
    case "joint":
      return `Joint ${node.joint.name}`;
    case "sensor":
      return `Sensor ${node.sensor.name}`;
    case "transform":
      return node.child;
  }
}
