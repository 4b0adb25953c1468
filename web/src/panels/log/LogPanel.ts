// The log of events, with filters for level and text. In a recording, a click on a line goes to its
// time.
import { Store, shallowEqual } from "../../state/Store";
import { element } from "../../ui/element";
import { formatTime } from "../../ui/format";
import type { MountedPanel } from "../contract/Panel";
import type { PanelPorts } from "../contract/ports";
import type { LogPorts } from "./LogFeed";
import { LogFeed } from "./LogFeed";
import type { Log, LogLine } from "./log";
import { LEVELS, NO_LOG, countUntil, levelWord, shownLines } from "./log";

const MOST_ROWS = 500; // maximum number of shown lines; these are the lines around the present instant
// if the user has scrolled farther up than this, the list does not scroll to new lines
const NEAR_END_PX = 24;

const NOTHING_YET =
  "No messages yet. This panel lists events of the simulation: starts and pauses, robots " +
  "that are added or removed, behaviours that crash.";
const NOTHING_FITS = "No message matches. Choose a lower level, or change the text above.";

type Ports = Pick<PanelPorts, "state" | "replay">;

export function mount(ports: Ports & LogPorts): MountedPanel {
  const store = new Store<Log>(NO_LOG);
  new LogFeed(store, ports).start();
  return panelOf(store, ports);
}

// Makes the panel for the lines in the store.
export function panelOf(store: Store<Log>, ports: Ports): MountedPanel {
  const list = element("ol", { class: "log-lines", "aria-label": "Lines", tabindex: "0" });
  const empty = element("p", { class: "log-empty" });
  const rows = new Rows(ports, list, empty);
  return {
    body: element("div", { class: "log-body" }, list, empty),
    tools: [levelChoice(store), textField(store)],
    whileOpen: () => {
      const ends = [
        store.watch((log) => log, (log) => rows.show(log), shallowEqual),
        ports.state.watch(({ time }) => time, () => rows.mark()),
      ];
      return () => ends.forEach((end) => end());
    },
  };
}

function levelChoice(store: Store<Log>): HTMLElement {
  const choice = element("select", { "aria-label": "Level" });
  choice.append(...LEVELS.map(({ level, label }) => new Option(label, String(level))));
  choice.addEventListener("change", () => store.set({ lowest: Number(choice.value) }));
  return choice;
}

function textField(store: Store<Log>): HTMLElement {
  const field = element("input", {
    type: "search",
    class: "log-filter",
    "aria-label": "Search the log",
    placeholder: "robot or text…",
    autocomplete: "off",
    spellcheck: "false",
  });
  field.addEventListener("input", () => store.set({ filter: field.value }));
  return field;
}

class Rows {
  private lines: LogLine[] = []; // lines that fit the filter
  private from = 0; // index of the first line that is shown
  private until = 0; // number of lines up to the present instant
  private shown: Log | null = null;

  constructor(
    private readonly ports: Ports,
    private readonly list: HTMLElement,
    private readonly empty: HTMLElement,
  ) {}

  show(log: Log): void {
    if (log === this.shown) return;
    this.shown = log;
    this.lines = shownLines(log);
    this.empty.textContent = log.lines.length === 0 ? NOTHING_YET : NOTHING_FITS;
    this.empty.hidden = this.lines.length > 0;
    this.list.hidden = this.lines.length === 0;
    this.draw();
  }

  // Marks the lines of a recording that come after the present instant.
  mark(): void {
    const { replay, time } = this.ports.state.get();
    const until = replay ? countUntil(this.lines, time) : this.lines.length;
    if (until === this.until) return;
    const isOutside = until < this.from || until > this.from + this.list.childElementCount;
    if (isOutside) return this.draw();
    this.until = until;
    this.place();
  }

  private draw(): void {
    const { replay, time } = this.ports.state.get();
    const { scrollTop, clientHeight, scrollHeight } = this.list;
    const wasAtEnd = scrollTop + clientHeight > scrollHeight - NEAR_END_PX;
    this.until = replay ? countUntil(this.lines, time) : this.lines.length;
    const last = Math.max(0, this.lines.length - MOST_ROWS);
    this.from = replay ? Math.min(last, Math.max(0, this.until - MOST_ROWS / 2)) : last;
    const rows = this.lines.slice(this.from, this.from + MOST_ROWS);
    this.list.replaceChildren(...rows.map((line) => this.row(line, replay !== null)));
    if (replay || wasAtEnd) this.place();
    else this.list.scrollTop = scrollTop;
  }

  // Marks the lines that come after the present instant. Scrolls to the last line before it.
  private place(): void {
    const present = this.until - this.from - 1;
    const rows = [...this.list.children] as HTMLElement[];
    rows.forEach((row, i) => row.classList.toggle("to-come", i > present));
    const row = rows[Math.max(0, present)];
    if (!row) return;
    const bottom = row.offsetTop + row.offsetHeight;
    const { scrollTop, clientHeight } = this.list;
    const isSeen = row.offsetTop >= scrollTop && bottom <= scrollTop + clientHeight;
    if (!isSeen) this.list.scrollTop = bottom - clientHeight;
  }

  private row({ time, level, name, text }: LogLine, isReplay: boolean): HTMLElement {
    const word = levelWord(level);
    const go = () => void this.ports.replay.seek(time);
    const instant = formatTime(time);
    const attributes = { type: "button", title: "Go to this time", onclick: go };
    return element(
      "li",
      { class: `log-line ${word}` },
      isReplay
        ? element("button", { ...attributes, class: "log-time number" }, instant)
        : element("span", { class: "log-time number" }, instant),
      element("span", { class: "log-level" }, word),
      element("span", { class: "log-name" }, name),
      element("span", { class: "log-text" }, text),
    );
  }
}
