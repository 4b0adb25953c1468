// Shows the data of the selected part of the world, and updates it.
import type { SceneBody, SceneDescription, SceneSensor } from "../../api/scene";
import { anglesOf, stampOf, valuesOf } from "../../live/values";
import type { PosesMessage } from "../../protocol/messages";
import { seconds } from "../../protocol/messages";
import { element, setText } from "../../ui/element";
import { formatNumber, formatValue } from "../../ui/format";
import { smallButton } from "../../ui/smallButton";
import type { PanelPorts } from "../contract/ports";
import type { WorldNode } from "./nodes";
import { kindOf } from "./nodes";
import type { Transforms } from "./Transforms";
import { ageText } from "./Transforms";

type Ports = Pick<PanelPorts, "state" | "topics" | "control" | "robots" | "cameras" | "plots" | "traffic" | "notices">;

const UPDATE_MS = 200; // as fast as numbers can be read
const POSES = "/gsv/poses";
const DEGREES = 180 / Math.PI;
type Line = [name: string, value: string];

export class NodeInspector {
  private readonly title = element("h2");
  private readonly actions = element("div", { class: "inspector-actions" });
  private readonly facts = element("dl", { class: "inspector-rows" });
  private readonly cells = new Map<string, HTMLElement>();
  readonly element = element("section", { class: "world-inspector", tabindex: "0", "aria-label": "Selected part" }, this.title, this.actions, this.facts);
  private end = () => {};

  constructor(
    private readonly ports: Ports,
    private readonly transforms: Transforms,
  ) {
    this.close();
  }

  close(): void {
    this.end();
    this.end = () => {};
    setText(this.title, "Nothing chosen");
    this.actions.replaceChildren();
    this.show([["", "Choose a part of the world to see where it is and what it reads."]]);
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
    const stop = this.every(() => this.show([...factsOf(body, link), ...poseLines(this.ports.state.get().scene, newest, body, link, this.ports.state.get().time)]));
    const end = this.ports.topics.subscribe<PosesMessage>(POSES, (message) => (newest = message), { newestOnly: true });
    return () => {
      stop();
      end();
    };
  }

  private readSensor(body: SceneBody, sensor: SceneSensor): () => void {
    let newest: unknown = null;
    const facts: Line[] = [
      ["Of", body.name],
      ["Type", sensor.type.replaceAll("_", " ")],
      ["Link", sensor.link],
      ["Topic", sensor.topic],
    ];
    const isLarge = sensor.overlay === "picture" || sensor.type === "depth_camera";
    const stop = this.every(() => {
      const stamp = stampOf(newest);
      const age = stamp === null ? [] : [["Age", `${Math.max(0, this.ports.state.get().time - stamp).toFixed(2)} s`] as Line];
      const values = newest === null || isLarge ? [] : valuesOf(newest, sensor.units);
      this.show([...facts, ...age, ...values.map(({ key, unit, value }): Line => [key, formatValue(value, unit)])]);
      for (const { key, unit } of values) this.addPlot(key, sensor, unit);
    });
    const end = isLarge ? () => {} : this.ports.topics.subscribe<unknown>(sensor.topic, (message) => (newest = message), { newestOnly: true });
    return () => {
      stop();
      end();
    };
  }

  // Adds a plot button beside the value; each value has one.
  private addPlot(key: string, { topic, name }: SceneSensor, unit: string): void {
    const cell = this.cells.get(key)?.parentElement;
    if (!cell || cell.querySelector("button")) return;
    cell.append(smallButton("plot", `Plot ${name} ${key}`, () => this.ports.plots.add({ kind: "sensor", topic }, key, unit)));
  }

  private readJoint(body: SceneBody, joint: string, kind: string, link: string | null): () => void {
    const facts: Line[] = [
      ["Of", body.name],
      ["Kind", kind],
      ["Child link", link ?? "fixed to the model"],
    ];
    this.show(facts);
    let isOn = true;
    let timer: ReturnType<typeof setTimeout> | undefined;
    const ask = async () => {
      const { simulation, replay } = this.ports.state.get();
      if (simulation === null || replay) return;
      const told = await this.ports.control.joints(simulation, body.name).catch(() => null);
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
    if (!frame) return [["", "This transform has not come. Keep Transforms open in the tree."]];
    const { roll, pitch, yaw } = frame.angles;
    return [
      ["Parent", frame.parent],
      ["Translation", `${frame.position.map((value) => formatNumber(value, 3)).join(", ")} m`],
      ["Rotation", `${[roll, pitch, yaw].map((value) => formatNumber(value * DEGREES, 1)).join(", ")} ° (roll, pitch, yaw)`],
      ["At", `${frame.time.toFixed(2)} s`],
      ["Age", ageText(frame, this.ports.state.get().time)],
    ];
  }

  private actionsOf(node: WorldNode): HTMLElement[] {
    const { robots, cameras, traffic } = this.ports;
    const button = (label: string, onclick: () => void) => element("button", { class: "button small", type: "button", onclick }, label);
    const isRobot = node.kind !== "transform" && (node.body.isRobot || node.body.isAvatar || node.body.isStation);
    const select = isRobot ? [button("Select in the view", () => robots.select(node.body.name))] : [];
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

function factsOf(body: SceneBody, link: string | null): Line[] {
  if (link !== null) return [["Of", body.name]];
  return [
    ["Kind", kindOf(body)],
    ["Links", String(body.links.length)],
    ["Joints", String(body.joints.length)],
    ["Sensors", String(body.sensors.length)],
  ];
}

// A link without its own pose moves with its model. A static body keeps its initial pose.
function poseLines(scene: SceneDescription | null, message: PosesMessage | null, body: SceneBody, link: string | null, now: number): Line[] {
  const entry = scene?.poses.findIndex((each) => scene.bodies[each.body]?.name === body.name && each.link === link) ?? -1;
  const isFresh = message !== null && scene?.layoutVersion === message.layout_version && entry >= 0;
  if (link !== null && entry < 0) return [["Moves", "with its model"]];
  const pose = isFresh ? Array.from(message.poses.subarray(7 * entry, 7 * entry + 7)) : link === null ? body.pose : null;
  if (!pose || pose.length < 7) return [];
  const [x, y, z, qx, qy, qz, qw] = pose as [number, number, number, number, number, number, number];
  const { roll, pitch, yaw } = anglesOf({ x: qx, y: qy, z: qz, w: qw });
  const lines: Line[] = [
    ["Position", `${[x, y, z].map((value) => formatNumber(value, 3)).join(", ")} m`],
    ["Orientation", `${[roll, pitch, yaw].map((value) => formatNumber(value * DEGREES, 1)).join(", ")} ° (roll, pitch, yaw)`],
  ];
  return isFresh ? [...lines, ["Age", `${Math.max(0, now - seconds(message.stamp)).toFixed(2)} s`]] : lines;
}
