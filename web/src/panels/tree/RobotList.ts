// The list of robots, filtered, sorted and grouped. Only the visible rows exist.
import { listedRobots } from "../../state/listedRobots";
import type { Entry, ListedRobot, RobotFilter } from "../../state/robotList";
import { NameOrder, entriesOf, inOrderOf, isFiltering, isTitle } from "../../state/robotList";
import { element, setText } from "../../ui/element";
import { count } from "../../ui/format";
import type { PanelPorts } from "../contract/ports";
import { ROW_PX, RobotRow, rowHeight, troubleOf } from "./RobotRow";
import type { Row } from "./VirtualRows";
import { VirtualRows } from "./VirtualRows";

type Ports = Pick<PanelPorts, "state" | "robots">;

const TITLE_PX = 30; // must equal the height in style/robots.css
// If the list has more robots than this, all rows have the same height, and long sentences are
// truncated. So a change of one row does not move the rows below it.
const MAX_WRAPPED = 100;

export class RobotList {
  readonly element: HTMLElement;
  private readonly rows: VirtualRows<Entry>;
  private readonly nothing = element("p", { class: "robot-nothing dim" }, "No robot matches. Change the search, or show all states.");
  private readonly order = new NameOrder();
  private entries: readonly Entry[] = [];
  private heights = new Map<string, number>(); // px, by robot
  private isPointed = false;
  private hasFocus = false;
  // The filter with which the present order of the rows was computed.
  private held: { filter: RobotFilter } | null = null;

  constructor(private readonly ports: Ports) {
    this.rows = new VirtualRows<Entry>(
      {
        keyOf: (entry) => (isTitle(entry) ? `group ${entry.title}` : entry.status.name),
        kindOf: (entry) => (isTitle(entry) ? "title" : "robot"),
        heightOf: (entry) => (isTitle(entry) ? TITLE_PX : this.heightOf(entry)),
        make: (kind) => (kind === "title" ? new TitleRow() : new RobotRow(ports, (listed) => this.heightOf(listed))) as Row<Entry>,
      },
      "Robots",
    );
    this.rows.list.addEventListener("keydown", (event) => this.onKey(event));
    this.element = element("div", { class: "robot-list" }, this.nothing, this.rows.scroller);
    this.followAttention();
  }

  // While the pointer or the keyboard focus is in the list, its rows stay where they are, so that
  // the user can click them. They also stay while this page drives a robot.
  private followAttention(): void {
    const { scroller } = this.rows;
    const release = () => {
      if (this.isInUse || !this.held) return;
      this.held = null;
      this.update();
    };
    scroller.addEventListener("pointerenter", () => (this.isPointed = true));
    scroller.addEventListener("pointerleave", () => {
      this.isPointed = false;
      release();
    });
    scroller.addEventListener("focusin", () => (this.hasFocus = true));
    scroller.addEventListener("focusout", ({ relatedTarget }) => {
      this.hasFocus = relatedTarget instanceof Node && scroller.contains(relatedTarget);
      release();
    });
  }

  private get isInUse(): boolean {
    return this.isPointed || this.hasFocus || this.ports.state.get().driven !== null;
  }

  update(): void {
    const state = this.ports.state.get();
    const entries = entriesOf(listedRobots(state), state.robotFilter, this.order);
    const isHeld = this.isInUse && this.held?.filter === state.robotFilter;
    this.entries = isHeld ? inOrderOf(this.entries, entries) : entries;
    if (!isHeld) this.heights.clear();
    this.held = { filter: state.robotFilter };
    this.nothing.hidden = this.entries.length > 0 || !isFiltering(state.robotFilter);
    this.rows.show(this.entries);
  }

  // Returns the height of a robot's row, px. While the order of the rows is held, the heights are
  // held, too.
  private heightOf(robot: ListedRobot): number {
    if (this.entries.length > MAX_WRAPPED) return ROW_PX;
    const known = this.heights.get(robot.status.name);
    if (known !== undefined) return known;
    const height = rowHeight(troubleOf(robot, this.ports.state.get().time));
    this.heights.set(robot.status.name, height);
    return height;
  }

  showSelection(selection: string | null): void {
    const index = this.indexOf(selection);
    if (index >= 0) this.rows.scrollTo(index);
    this.rows.show(this.entries);
  }

  private indexOf(robot: string | null): number {
    return robot === null ? -1 : this.entries.findIndex((entry) => !isTitle(entry) && entry.status.name === robot);
  }

  // The up and down keys go to the next robot, even if its row does not exist yet.
  private onKey(event: KeyboardEvent): void {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (!step) return;
    let index = this.indexOf((event.target as HTMLElement).dataset.robot ?? null) + step;
    while (index >= 0 && index < this.entries.length && isTitle(this.entries[index]!)) index += step;
    const entry = this.entries[index];
    if (!entry || isTitle(entry)) return;
    event.preventDefault();
    event.stopPropagation();
    this.ports.robots.select(entry.status.name);
    const rows = [...this.rows.list.querySelectorAll<HTMLElement>("[data-robot]")];
    rows.find(({ dataset }) => dataset.robot === entry.status.name)?.focus();
  }
}

class TitleRow {
  readonly element = element("li", { class: "robot-group" });

  write(entry: Entry): void {
    if (isTitle(entry)) setText(this.element, `${entry.title} · ${count(entry.count, "robot")}`);
  }
}
