// A message as a tree: every field with its value, and a curve for numbers. Collapsed parts are not
// computed.
import { isTime, numberOf, pathOf } from "../../live/fieldPath";
import type { Step } from "../../live/fieldPath";
import { element, setText } from "../../ui/element";
import { icon } from "../../ui/icons";

const MAX_SHOWN = 100; // maximum number of shown elements of one list
const MAX_TEXT = 2000; // maximum number of shown characters of one value

export interface TreeActions {
  plot(path: string): void;
  copy(path: string, value: unknown): void;
}

export class MessageTree {
  readonly element = element("div", { class: "message-tree", role: "group", "aria-label": "Message" });
  private readonly root: Branch;

  constructor(actions: TreeActions) {
    this.root = new Branch("", actions);
    this.element.append(this.root.list);
  }

  show(message: unknown): void {
    this.root.show(message);
  }

  clear(): void {
    this.root.show({});
  }
}

// The fields of one object or list.
class Branch {
  readonly list = element("ul", { class: "tree-fields" });
  private readonly rows = new Map<Step, Row>();
  private readonly rest = element("li", { class: "dim" });

  constructor(
    private readonly path: string,
    private readonly actions: TreeActions,
  ) {}

  show(value: unknown): void {
    const steps = stepsOf(value);
    const shown = steps.slice(0, MAX_SHOWN);
    const wanted = new Set(shown);
    for (const [step, row] of this.rows) {
      if (wanted.has(step)) continue;
      row.element.remove();
      this.rows.delete(step);
    }
    for (const step of shown) {
      let row = this.rows.get(step);
      if (!row) {
        row = new Row(step, pathOf(this.path, step), this.actions);
        this.rows.set(step, row);
        this.list.append(row.element);
      }
      row.show((value as Record<Step, unknown>)[step]);
    }
    const left = steps.length - shown.length;
    if (left > 0) {
      setText(this.rest, `… ${left.toLocaleString("en")} more`);
      this.list.append(this.rest);
    } else this.rest.remove();
  }
}

class Row {
  readonly element = element("li");
  private leaf: { line: HTMLElement; value: HTMLElement; plot: HTMLElement } | null = null;
  private fold: { details: HTMLDetailsElement; note: HTMLElement; branch: Branch } | null = null;
  private value: unknown;

  constructor(
    private readonly step: Step,
    private readonly path: string,
    private readonly actions: TreeActions,
  ) {}

  show(value: unknown): void {
    this.value = value;
    if (isFolded(value)) this.showFold(value);
    else this.showLeaf(value);
  }

  private showLeaf(value: unknown): void {
    if (!this.leaf) {
      const text = element("span", { class: "tree-value number" });
      const plot = this.button("plot", `Plot ${this.path}`, () => this.actions.plot(this.path));
      const line = element("div", { class: "tree-line" }, this.name(), text, plot, this.copyButton());
      this.leaf = { line, value: text, plot };
      this.fold = null;
      this.element.replaceChildren(line);
    }
    setText(this.leaf.value, textOf(value));
    this.leaf.plot.hidden = numberOf(value) === null;
  }

  private showFold(value: object): void {
    if (!this.fold) {
      const note = element("span", { class: "dim" });
      const branch = new Branch(this.path, this.actions);
      const summary = element("summary", {}, this.name(), note);
      const details = element("details", {}, summary, branch.list);
      details.addEventListener("toggle", () => details.open && branch.show(this.value));
      this.fold = { details, note, branch };
      this.leaf = null;
      this.element.replaceChildren(element("div", { class: "tree-fold" }, details, this.copyButton()));
    }
    setText(this.fold.note, typeof this.step === "number" ? nameOf(value) : noteOf(value));
    if (this.fold.details.open) this.fold.branch.show(value);
  }

  private name(): HTMLElement {
    return element("span", { class: "tree-name" }, typeof this.step === "number" ? `[${this.step}]` : this.step);
  }

  private copyButton(): HTMLElement {
    return this.button("copy", `Copy ${this.path}`, () => this.actions.copy(this.path, this.value));
  }

  private button(picture: "plot" | "copy", label: string, onclick: () => void): HTMLElement {
    return element("button", { class: "button plain tiny", type: "button", "aria-label": label, title: label, onclick }, icon(picture));
  }
}

function isFolded(value: unknown): value is object {
  return typeof value === "object" && value !== null && !isTime(value);
}

function stepsOf(value: unknown): Step[] {
  if (typeof value !== "object" || value === null) return [];
  if (Array.isArray(value) || isNumbers(value)) {
    return Array.from({ length: value.length }, (_, i) => i);
  }
  return Object.keys(value);
}

function isNumbers(value: object): value is Float64Array {
  return ArrayBuffer.isView(value) && !(value instanceof DataView);
}

function noteOf(value: object): string {
  if (Array.isArray(value)) return ` ${value.length.toLocaleString("en")} elements`;
  if (isNumbers(value)) return ` ${value.length.toLocaleString("en")} numbers`;
  return "";
}

// Returns the name of an element of a list. For example, elements of a list of robots have the
// robot's name.
function nameOf(value: object): string {
  const { name, robot } = value as { name?: unknown; robot?: unknown };
  const found = [name, robot].find((each) => typeof each === "string" && each !== "");
  return found === undefined ? noteOf(value) : ` ${String(found).slice(0, MAX_TEXT)}`;
}

function textOf(value: unknown): string {
  if (typeof value === "string") return value.length > MAX_TEXT ? `"${value.slice(0, MAX_TEXT)}…"` : `"${value}"`;
  if (isTime(value)) return `${(value.sec + value.nsec * 1e-9).toFixed(3)} s`;
  return String(value);
}

// Returns the value as JSON. Numbers that JSON cannot represent are written as strings: NaN,
// infinities, and integers that are too large to be exact.
export function jsonOf(value: unknown): string {
  const plain = (_: string, each: unknown): unknown => {
    if (typeof each === "bigint") return Number.isSafeInteger(Number(each)) ? Number(each) : String(each);
    if (typeof each === "number" && !Number.isFinite(each)) return String(each);
    return typeof each === "object" && each !== null && isNumbers(each) ? Array.from(each) : each;
  };
  return JSON.stringify(value, plain, 1) ?? String(value);
}
