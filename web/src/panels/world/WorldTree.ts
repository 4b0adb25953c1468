// The tree of bodies. The links, joints and sensors of a body are added when the user opens its
// entry.
import type { SceneBody } from "../../api/scene";
import { element, setText } from "../../ui/element";
import { count } from "../../ui/format";
import type { WorldNode } from "./nodes";
import { kindOf, nodeId } from "./nodes";
import type { Frame } from "./Transforms";
import { ageText } from "./Transforms";

const MAX_BODIES = 300;
const MAX_FRAMES = 300;

export class WorldTree {
  readonly element = element("div", { class: "world-nodes", tabindex: "0", role: "group", "aria-label": "Tree of the world" });
  private readonly note = element("p", { class: "dim" });
  private readonly list = element("ul");
  private readonly frames = element("ul");
  private readonly frameSummary = element("summary", {}, "Transforms");
  private readonly frameAges = new Map<string, HTMLElement>();
  private readonly opened = new Set<string>(); // bodies
  private chosen = "";

  constructor(
    private readonly choose: (node: WorldNode) => void,
    onTransforms: (isOpen: boolean) => void,
  ) {
    const details = element("details", {}, this.frameSummary, this.frames);
    details.addEventListener("toggle", () => onTransforms(details.open));
    this.element.append(this.note, this.list, details);
  }

  showBodies(bodies: readonly SceneBody[], isFiltered: boolean): void {
    const shown = bodies.slice(0, MAX_BODIES);
    this.list.replaceChildren(...shown.map((body) => this.bodyItem(body, isFiltered && bodies.length <= 3)));
    const left = bodies.length - shown.length;
    setText(this.note, bodies.length === 0 ? (isFiltered ? "No part has this text in its name. Change the text above." : "No world yet.") : left > 0 ? `${left.toLocaleString("en")} more parts. To find one, type a part of its name above.` : "");
    this.select(this.chosen);
  }

  showFrames(frames: readonly Frame[], now: number): void {
    const shown = frames.slice(0, MAX_FRAMES);
    setText(this.frameSummary, `Transforms (${frames.length})`);
    const isSame = shown.length === this.frameAges.size && shown.every(({ child }) => this.frameAges.has(child));
    if (!isSame) {
      this.frameAges.clear();
      this.frames.replaceChildren(...shown.map((frame) => this.frameItem(frame)));
      this.select(this.chosen);
    }
    for (const frame of shown) setText(this.frameAges.get(frame.child)!, ageText(frame, now));
  }

  select(id: string): void {
    this.chosen = id;
    for (const button of this.element.querySelectorAll<HTMLElement>("[data-node]")) {
      button.setAttribute("aria-pressed", String(button.dataset.node === id));
    }
  }

  private bodyItem(body: SceneBody, unfolds: boolean): HTMLElement {
    const button = this.button({ kind: "body", body }, body.name, kindOf(body));
    const parts = body.links.length + body.joints.length + body.sensors.length;
    if (parts === 0) return element("li", {}, button);
    const inside = element("ul");
    const isOpen = unfolds || this.opened.has(body.name);
    const details = element("details", { open: isOpen }, element("summary", { "aria-label": `Parts of ${body.name}` }), inside);
    const fill = () => inside.childElementCount === 0 && inside.append(...this.partItems(body));
    if (isOpen) fill();
    details.addEventListener("toggle", () => {
      this.opened[details.open ? "add" : "delete"](body.name);
      if (details.open) fill();
      this.select(this.chosen);
    });
    return element("li", { class: "world-body" }, button, details);
  }

  private partItems(body: SceneBody): HTMLElement[] {
    const group = (title: string, nodes: { node: WorldNode; label: string; kind: string }[]) =>
      nodes.length === 0
        ? []
        : [
            element("li", { class: "dim" }, count(nodes.length, title)),
            ...nodes.map(({ node, label, kind }) => element("li", {}, this.button(node, label, kind))),
          ];
    return [
      ...group("link", body.links.map((name) => ({ node: { kind: "link", body, name }, label: name, kind: "" }))),
      ...group("joint", body.joints.map((joint) => ({ node: { kind: "joint", body, joint }, label: joint.name, kind: joint.kind }))),
      ...group("sensor", body.sensors.map((sensor) => ({ node: { kind: "sensor", body, sensor }, label: sensor.name, kind: sensor.type }))),
    ];
  }

  private frameItem({ child, parent }: Frame): HTMLElement {
    const age = element("span", { class: "dim number" });
    this.frameAges.set(child, age);
    const button = this.button({ kind: "transform", child }, child, `in ${parent}`);
    button.append(age);
    return element("li", {}, button);
  }

  private button(node: WorldNode, label: string, kind: string): HTMLElement {
    return element(
      "button",
      { class: "button plain world-node", type: "button", "data-node": nodeId(node), "aria-pressed": "false", onclick: () => this.choose(node) },
      element("span", {}, label),
      kind !== "" && element("span", { class: "dim" }, kind.replaceAll("_", " ")),
    );
  }
}
