// All topics of the simulation, and the newest message of the selected topic.
import { element, setText } from "../../ui/element";
import { icon } from "../../ui/icons";
import { shallowEqual } from "../../state/Store";
import { formatTime } from "../../ui/format";
import { stampOf } from "../../live/values";
import type { MountedPanel } from "../contract/Panel";
import type { PanelPorts } from "../contract/ports";
import { MessageTree, jsonOf } from "./MessageTree";
import { Rates } from "./rates";
import { TopicList } from "./TopicList";

type Ports = Pick<PanelPorts, "state" | "topics" | "traffic" | "plots" | "notices">;

const UPDATE_MS = 200; // as fast as numbers can be read
const RATES_MS = 1000;
const SILENT_MS = 3000;
const MAX_MEASURED = 100;
const MAX_COPIED = 1_000_000; // characters

export function mount({ state, topics, traffic, plots, notices }: Ports): MountedPanel {
  let chosen = state.get().topic;
  let isPaused = false;
  let isOpen = false;
  let end = () => {};
  let newest: unknown;
  let shown: unknown; // the message in the tree: the newest one, or the frozen one
  let arrived = -Infinity; // ms
  let timer: ReturnType<typeof setTimeout> | undefined;
  const tree = new MessageTree({
    plot: (path) => chosen !== null && plots.add({ kind: "topic", topic: chosen }, path, ""),
    copy: (path, value) => copy(`${path} copied.`, typeof value === "string" ? value : jsonOf(value)),
  });
  const copy = (done: string, text: string) => {
    if (text.length > MAX_COPIED) notices.notify("error", `The value is too large to copy: ${text.length.toLocaleString("en")} characters.`);
    else void notices.copy(text, done);
  };
  const title = element("h2", { class: "tree-title", hidden: "" });
  const note = element("p", { class: "dim", role: "status" });
  const pause = button("pause", "Freeze this message", () => {
    isPaused = !isPaused;
    pause.setAttribute("aria-pressed", String(isPaused));
    if (!isPaused) draw();
  });
  pause.setAttribute("aria-pressed", "false");
  const copyAll = button("copy", "Copy the message as JSON", () => shown !== undefined && copy("Message copied.", jsonOf(shown)));
  const copyName = button("link", "Copy the name of the topic", () => chosen !== null && void notices.copy(chosen, "Name copied."));
  const message = element(
    "div",
    { class: "topic-message", tabindex: "0", role: "group", "aria-label": "Newest message" },
    element("div", { class: "tree-head" }, title, pause, copyAll, copyName),
    note,
    tree.element,
  );

  const list = new TopicList((topic) => {
    traffic.choose(topic === chosen ? null : topic);
  });
  const draw = () => {
    timer = undefined;
    const isThere = newest !== undefined;
    if (isThere && !(isPaused && shown !== undefined)) tree.show((shown = newest));
    const stamp = stampOf(shown);
    const isOffered = chosen === null || state.get().topics.some(({ name }) => name === chosen);
    setText(note, noteOf(isOffered, isThere, performance.now() - arrived, stamp));
  };
  const listen = () => {
    end();
    end = () => {};
    newest = shown = undefined;
    isPaused = false;
    pause.setAttribute("aria-pressed", "false");
    tree.clear();
    setText(title, chosen ?? "");
    title.hidden = chosen === null;
    message.classList.toggle("none", chosen === null);
    setText(note, chosen === null ? "Choose a topic to see its messages." : "Waiting for a message…");
    for (const each of [pause, copyAll, copyName]) each.hidden = chosen === null;
    if (chosen === null || !isOpen) return;
    end = topics.subscribe<unknown>(
      chosen,
      (each) => {
        newest = each;
        arrived = performance.now();
        timer ??= setTimeout(draw, UPDATE_MS);
      },
      { newestOnly: true },
    );
  };

  const rates = new Rates();
  const measured = new Map<string, () => void>(); // subscriptions whose messages are only counted
  const measure = element("input", { type: "checkbox" });
  let listed: string[] = [];
  const count = () => {
    const wanted = new Set(isOpen && measure.checked ? listed.slice(0, MAX_MEASURED) : []);
    for (const [topic, stop] of measured) {
      if (wanted.has(topic)) continue;
      measured.delete(topic);
      stop();
    }
    for (const topic of wanted) {
      if (!measured.has(topic)) measured.set(topic, topics.subscribe(topic, () => {}, { newestOnly: true }));
    }
  };
  list.onShown = (names) => {
    listed = names;
    count();
  };
  measure.addEventListener("change", count);
  const whileOpen = () => {
    isOpen = true;
    const showRates = () => {
      list.showRates(rates.update(traffic.counts(), performance.now()));
      if (chosen !== null && performance.now() - arrived > SILENT_MS) draw();
    };
    const clock = setInterval(showRates, RATES_MS);
    showRates();
    const unwatch = state.watch(
      (known) => known.topics,
      (offered) => {
        list.show(offered);
        list.select(chosen);
      },
      shallowEqual,
    );
    const unwatchChoice = state.watch(
      ({ topic }) => topic,
      (topic) => {
        chosen = topic;
        list.select(chosen);
        listen();
      },
    );
    return () => {
      isOpen = false;
      unwatchChoice();
      count();
      unwatch();
      clearInterval(clock);
      clearTimeout(timer);
      timer = undefined;
      end();
      end = () => {};
      rates.clear();
    };
  };
  const measuring = element(
    "label",
    { class: "check-line", title: `Subscribe to all listed topics (at most ${MAX_MEASURED}) to measure how often their messages arrive. Otherwise, the page measures only topics that it shows.` },
    measure,
    "Measure the rates of all listed topics",
  );
  return { body: element("div", { class: "topics-body" }, list.element, message), tools: [list.filter, measuring], whileOpen };
}

function noteOf(isOffered: boolean, isThere: boolean, silentMs: number, stamp: number | null): string {
  if (!isOffered) return "The server does not offer this topic any more. The last message stays.";
  if (!isThere) return "Waiting for a message…";
  const time = stamp === null ? "" : `At ${formatTime(stamp)}`;
  if (silentMs < SILENT_MS) return time;
  return `${time === "" ? "" : `${time}. `}No message for ${Math.round(silentMs / 1000)} s.`;
}

function button(picture: "pause" | "copy" | "link", label: string, onclick: () => void): HTMLButtonElement {
  return element("button", { class: "button plain small", type: "button", "aria-label": label, title: label, onclick }, icon(picture));
}
