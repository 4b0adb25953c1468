// The page of recordings: a list with a link for each recording, which replays the recording.
import type { JsonServer } from "../api/JsonServer";
import { ListPage } from "../frame/ListPage";
import { element } from "../ui/element";
import { count, formatDate, formatSize, formatTime } from "../ui/format";
import type { RecordingLine } from "./recordings";
import { fetchRecordings, replayUrl } from "./recordings";

export function createRecordingsPage(server: JsonServer, admit: (token: string) => void): ListPage<RecordingLine> {
  return new ListPage({
    admit,
    title: "Recordings",
    label: "Recordings",
    empty: noRecordings(),
    fetch: async () => {
      const { folder, leftOut, lines } = await fetchRecordings(server);
      const more = leftOut > 0 ? `${count(leftOut, "older one")} not shown.` : "";
      return { note: folder, items: lines, more };
    },
    show: recordingItem,
  });
}

function noRecordings(): Node {
  return element(
    "span",
    {},
    "No recordings yet. Press the red dot beside the buttons of a simulation to record it, or use ",
    element("code", {}, "gsv run WORLD --record NAME.mcap"),
  );
}

function recordingItem(line: RecordingLine): HTMLElement {
  const { name, size, modified, state, world, robots, verdict, sentence, violation } = line;
  const what = [world, robots > 0 && count(robots, "robot"), formatDate(modified), formatSize(size)];
  const about = what.filter(Boolean).join(" · ");
  return element(
    "li",
    { class: "card frame-item recording" },
    element("h2", {}, name),
    element("p", { class: "dim" }, about),
    verdict !== "" && element("p", { class: verdict === "failed" ? "field-error" : "" }, [verdict, sentence].filter(Boolean).join(": ")),
    element(
      "div",
      { class: "frame-row" },
      state !== "unreadable" && element("a", { class: "button", href: replayUrl(name, violation), "aria-label": `Replay ${name}` }, "Replay"),
      content(line),
    ),
  );
}

function content({ state, problem, duration, messages }: RecordingLine): HTMLElement {
  switch (state) {
    case "complete":
      return element("span", { class: "dim" }, `${formatTime(duration)} · ${count(messages, "message")}`);
    case "unfinished":
      return element("span", { class: "dim" }, "Incomplete: still being recorded, or interrupted.");
    case "unreadable":
      return element("span", { class: "field-error" }, `Cannot be read: ${problem}`);
  }
}
