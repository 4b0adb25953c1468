// One robot of the list: its state, its name, its activity or the reason why it does not move, and
// its distance.
import type { ListedRobot } from "../../state/robotList";
import { agentLabel } from "../../state/actions";
import { STATE_WORDS, isTrouble, sentenceOf } from "../../state/health";
import { element, setAttribute, setText } from "../../ui/element";
import { count, formatDistance } from "../../ui/format";
import type { PanelPorts } from "../contract/ports";

export const ROW_PX = 50;
const FIRST_LINE_PX = 33; // the name and the padding
const LINE_PX = 17; // must equal the line height in style/robots.css
const LINE_CHARACTERS = 31; // number of characters in one line at the smallest width of the list
const MAX_LINES = 4;

// Returns the sentence about what is wrong with the robot; empty if there is no problem.
export function troubleOf({ health, state }: ListedRobot, now: number): string {
  return health && (isTrouble(state) || health.level > 0) ? sentenceOf(health, now) : "";
}

// Returns the height of a row in px. If the robot is in trouble, the row has lines for its whole
// sentence.
export function rowHeight(trouble: string): number {
  if (trouble === "") return ROW_PX;
  return FIRST_LINE_PX + LINE_PX * Math.min(MAX_LINES, Math.ceil(trouble.length / LINE_CHARACTERS));
}

export class RobotRow {
  private height = 0;
  readonly element: HTMLElement;
  private readonly button: HTMLButtonElement;
  private readonly dot = element("span", { class: "dot" });
  private readonly name = element("span", { class: "robot-name" });
  private readonly behaviour = element("span", { class: "robot-behaviour" });
  private readonly distance = element("span", { class: "number" });
  private readonly collisions = element("span", { class: "number collisions" });

  constructor(
    private readonly ports: Pick<PanelPorts, "state" | "robots">,
    private readonly heightOf: (listed: ListedRobot) => number,
  ) {
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
    const why = troubleOf(listed, this.ports.state.get().time);
    this.setHeight(this.heightOf(listed));
    setText(this.behaviour, why || this.work(listed, agent));
    setAttribute(this.behaviour, "data-trouble", String(why !== ""));
    setText(this.distance, listed.kind === "station" ? "" : formatDistance(status.distance));
    setText(this.collisions, status.collisions > 0 ? count(status.collisions, "collision") : "");
    setAttribute(this.button, "title", [why, status.detail].filter((line) => line !== "").join("\n"));
  }

  private setHeight(height: number): void {
    if (height === this.height) return;
    this.height = height;
    this.element.style.height = `${height}px`;
    this.behaviour.style.setProperty("--lines", String(Math.floor((height - FIRST_LINE_PX) / LINE_PX)));
  }

  private work({ status, kind }: ListedRobot, agent: string): string {
    if (status.name === this.ports.state.get().driven) return "driven from this page";
    const isAtWork = status.agentPhase === "running" || status.agentPhase === "waiting";
    const name = status.behaviour || "no behaviour";
    const behaviour = isAtWork ? name : `${name} · ${agent}`;
    if (kind === "robot") return behaviour;
    // A recorded avatar cannot be driven, so its keys are not shown.
    if (kind === "avatar") return this.ports.state.get().replay ? "avatar" : "avatar · W A S D";
    return status.behaviour ? `sensor station · ${behaviour}` : "sensor station";
  }
}
