// One robot of the list: its state, its name, its activity or the reason why it does not move, and
// its distance.
import type { ListedRobot } from "../../state/robotList";
import { agentLabel } from "../../state/actions";
import { STATE_WORDS, isTrouble, sentenceOf } from "../../state/health";
import { element, setAttribute, setText } from "../../ui/element";
import { count, formatDistance } from "../../ui/format";
import type { PanelPorts } from "../contract/ports";

export class RobotRow {
  readonly element: HTMLElement;
  private readonly button: HTMLButtonElement;
  private readonly dot = element("span", { class: "dot" });
  private readonly name = element("span", { class: "robot-name" });
  private readonly behaviour = element("span", { class: "robot-behaviour" });
  private readonly distance = element("span", { class: "number" });
  private readonly collisions = element("span", { class: "number collisions" });

  constructor(private readonly ports: Pick<PanelPorts, "state" | "robots">) {
    this.button = element(
      "button",
      { class: "robot", type: "button", onclick: (event: MouseEvent) => this.choose(event) },
      this.dot,
      this.name,
      this.distance,
      this.behaviour,
      this.collisions,
    );
    this.button.addEventListener("dblclick", () => ports.robots.follow());
    this.element = element("li", {}, this.button);
  }

  private get robot(): string {
    return this.button.dataset.robot ?? "";
  }

  // In edit mode, a click with Shift or Ctrl adds the robot to the selection.
  private choose({ shiftKey, ctrlKey, metaKey }: MouseEvent): void {
    const isAdding = this.ports.state.get().editing !== null && (shiftKey || ctrlKey || metaKey);
    if (isAdding) this.ports.robots.pick(this.robot, true);
    else this.ports.robots.select(this.robot);
  }

  write(listed: ListedRobot): void {
    const { status, state } = listed;
    const { selection, editing } = this.ports.state.get();
    const isChosen = status.name === selection || editing?.more.includes(status.name);
    setAttribute(this.button, "data-robot", status.name);
    setAttribute(this.button, "aria-pressed", String(isChosen === true));
    const agent = agentLabel(status);
    setAttribute(this.dot, "data-phase", status.agentPhase);
    setAttribute(this.dot, "data-state", state);
    setAttribute(this.dot, "title", state === "unknown" ? agent : STATE_WORDS[state]);
    setText(this.name, status.name);
    const why = this.why(listed);
    setText(this.behaviour, why || this.work(listed, agent));
    setAttribute(this.behaviour, "data-trouble", String(why !== ""));
    setText(this.distance, listed.kind === "station" ? "" : formatDistance(status.distance));
    setText(this.collisions, status.collisions > 0 ? count(status.collisions, "collision") : "");
    setAttribute(this.button, "title", [why, status.detail].filter((line) => line !== "").join("\n"));
  }

  // Empty if there is no problem.
  private why({ health, state }: ListedRobot): string {
    return health && (isTrouble(state) || health.level > 0) ? sentenceOf(health, this.ports.state.get().time) : "";
  }

  private work({ status, kind }: ListedRobot, agent: string): string {
    const isAtWork = status.agentPhase === "running" || status.agentPhase === "waiting";
    const name = status.behaviour || "no behaviour";
    const behaviour = isAtWork ? name : `${name} · ${agent}`;
    if (kind === "robot") return behaviour;
    // A recorded robot cannot be changed.
    if (kind === "avatar") return this.ports.state.get().replay ? "avatar" : "avatar · W A S D";
    return status.behaviour ? `station · ${behaviour}` : "station";
  }
}
