// The topics that the server offers: their types, and the messages and bytes per second that arrive
// at this page.
import type { TopicInfo } from "../../protocol/FoxgloveClient";
import { element, setText } from "../../ui/element";
import type { Traffic } from "./rates";

const MAX_ROWS = 300;

interface Row {
  element: HTMLTableRowElement;
  button: HTMLButtonElement;
  rate: HTMLElement;
  bandwidth: HTMLElement;
}

export class TopicList {
  readonly element: HTMLElement;
  readonly filter = element("input", {
    type: "search",
    class: "log-filter",
    "aria-label": "Text in topic or type",
    placeholder: "topic or type…",
    autocomplete: "off",
    spellcheck: "false",
  });
  private readonly rows = new Map<string, Row>();
  private readonly body = element("tbody");
  private readonly note = element("p", { class: "dim" });
  private topics: readonly TopicInfo[] = [];
  onShown: (topics: string[]) => void = () => {}; // called with the topics that have a row

  constructor(private readonly choose: (topic: string) => void) {
    const head = ["Topic", "Type", "Hz", "kB/s"].map((title) => element("th", { scope: "col" }, title));
    const table = element("table", {}, element("thead", {}, element("tr", {}, ...head)), this.body);
    this.element = element("div", { class: "topic-list", tabindex: "0", role: "group", "aria-label": "Topics" }, table, this.note);
    this.filter.addEventListener("input", () => this.show(this.topics));
  }

  show(topics: readonly TopicInfo[]): void {
    this.topics = topics;
    const wanted = this.filter.value.trim().toLowerCase();
    const fitting = topics.filter(({ name, type }) => `${name} ${type}`.toLowerCase().includes(wanted));
    const shown = fitting.slice(0, MAX_ROWS);
    this.body.replaceChildren(...shown.map((topic) => this.rowOf(topic).element));
    setText(this.note, noteOf(topics.length, fitting.length, shown.length));
    this.onShown(shown.map(({ name }) => name));
  }

  select(topic: string | null): void {
    for (const [name, { button }] of this.rows) button.setAttribute("aria-pressed", String(name === topic));
  }

  showRates(rates: ReadonlyMap<string, Traffic>): void {
    for (const [name, { rate, bandwidth }] of this.rows) {
      const known = rates.get(name);
      setText(rate, known ? known.rate.toFixed(1) : "–");
      setText(bandwidth, known ? (known.bytesPerSecond / 1000).toFixed(1) : "–");
    }
  }

  private rowOf({ name, type }: TopicInfo): Row {
    const known = this.rows.get(name);
    if (known) return known;
    const button = element(
      "button",
      { class: "button plain", type: "button", "data-topic": name, title: name, "aria-pressed": "false", onclick: () => this.choose(name) },
      name,
    );
    const [rate, bandwidth] = [element("td", { class: "number" }, "–"), element("td", { class: "number" }, "–")];
    const row = { element: element("tr", {}, element("td", {}, button), element("td", { class: "dim", title: type }, type), rate, bandwidth), button, rate, bandwidth };
    this.rows.set(name, row);
    return row;
  }
}

function noteOf(all: number, fitting: number, shown: number): string {
  if (all === 0) return "No topics yet. They appear when the page is connected to a simulation.";
  if (fitting === 0) return "No topic matches. Change the text above.";
  return shown < fitting ? `The first ${shown} of ${fitting} topics. Type a text above to find others.` : "";
}
