// The timeline of a recording, or of a run whose past is stored: a slider for the time, marks of
// events, and controls for playback, notes and comparison.
import type { App } from "../app/App";
import { SPEEDS } from "../app/ReplayControl";
import { shallowEqual } from "../state/Store";
import { spanOf } from "../state/timeline";
import { element, setText } from "../ui/element";
import { formatTime, parseTime } from "../ui/format";
import type { IconName } from "../ui/icons";
import { icon, setIcon } from "../ui/icons";
import { createCompareMenu } from "./CompareMenu";
import { createNotesMenu } from "./NotesMenu";
import { createTimelineTrack, shownTime } from "./TimelineTrack";

export function createTimeline(app: App): HTMLElement {
  const transport = element(
    "div",
    { class: "timeline-transport", role: "group", "aria-label": "Playback" },
    button(app, "toStart", "Go to the start", "Home", () => app.replay.toStart()),
    button(app, "stepBack", "Previous recorded instant", "ArrowLeft", () => app.replay.step(-1)),
    playButton(app),
    button(app, "stepOn", "Next recorded instant", "ArrowRight", () => app.replay.step(1)),
    button(app, "toEnd", "Go to the end", "End", () => app.replay.toEnd()),
  );
  const pace = element("div", { class: "timeline-pace" }, speedChoice(app), loopButton(app));
  const bar = element(
    "section",
    { class: "timeline" },
    createTimelineTrack(app),
    element(
      "div",
      { class: "timeline-controls" },
      transport,
      liveButton(app),
      times(app),
      createNotesMenu(app),
      createCompareMenu(app),
      pace,
    ),
  );
  app.store.watch(
    ({ replay, kept, time, setUp }) => ({ isThere: setUp === null && spanOf(replay, kept, time) !== null, isReplay: replay !== null }),
    ({ isThere, isReplay }) => {
      bar.hidden = !isThere;
      bar.setAttribute("aria-label", isReplay ? "Recording" : "Timeline");
      transport.hidden = pace.hidden = !isReplay;
    },
    shallowEqual,
  );
  return bar;
}

// The button that returns from the past to the running simulation.
function liveButton(app: App): HTMLElement {
  const made = element(
    "button",
    { class: "button live", type: "button", title: "Return to the running simulation", onclick: () => app.past.goLive() },
    "Live",
  );
  app.store.watch(
    ({ inPast }) => inPast,
    (inPast) => (made.hidden = !inPast),
  );
  return made;
}

function playButton(app: App): HTMLElement {
  const picture = icon("play");
  const made = element(
    "button",
    {
      class: "button primary",
      type: "button",
      "aria-keyshortcuts": "Space",
      onclick: () => void app.replay.playOrPause(),
    },
    picture,
  );
  app.store.watch(
    ({ status, connection, pending }) => ({
      isPlaying: status?.phase === "running",
      enabled: connection.phase === "open" && pending === null,
    }),
    ({ isPlaying, enabled }) => {
      setIcon(picture, isPlaying ? "pause" : "play");
      const label = isPlaying ? "Pause" : "Play";
      made.setAttribute("aria-label", label);
      made.title = `${label} (Space)`;
      made.disabled = !enabled;
    },
    shallowEqual,
  );
  return made;
}

const KEY_NAMES: Record<string, string> = { ArrowLeft: "←", ArrowRight: "→" };

function button(app: App, picture: IconName, label: string, key: string, onclick: () => void): HTMLElement {
  const made = element(
    "button",
    {
      class: "button plain",
      type: "button",
      "aria-label": label,
      "aria-keyshortcuts": key,
      title: `${label} (${KEY_NAMES[key] ?? key})`,
      onclick,
    },
    icon(picture),
  );
  app.store.watch(
    ({ connection }) => connection.phase === "open",
    (isOpen) => (made.disabled = !isOpen),
  );
  return made;
}

function times(app: App): HTMLElement {
  const now = element("span", { "data-testid": "replay-time" });
  const end = element("span", { class: "dim", "data-testid": "replay-end" });
  app.store.watch(
    (state) => formatTime(shownTime(state)),
    (text) => setText(now, text),
  );
  app.store.watch(
    ({ replay, inPast }) => (replay ? ` / ${formatTime(replay.end)}${inPast ? " of the run" : ""}` : " live"),
    (text) => setText(end, text),
  );
  return element("span", { class: "timeline-times number", title: "Simulated time" }, now, end, typedTime(app));
}

// A text field for a time. Enter goes to the typed time.
function typedTime(app: App): HTMLElement {
  const field = element("input", {
    class: "typed-time number",
    "aria-label": "Go to time",
    placeholder: "go to…",
    title: "Seconds, minutes:seconds or hours:minutes:seconds; press Enter to go there",
    autocomplete: "off",
    spellcheck: "false",
  });
  app.menus.set("time", () => field.focus());
  field.addEventListener("input", () => field.removeAttribute("aria-invalid"));
  field.addEventListener("keydown", ({ key }) => {
    if (key === "Escape") field.blur();
    if (key !== "Enter") return;
    const time = parseTime(field.value);
    field.setAttribute("aria-invalid", String(time === null));
    if (time === null) return;
    field.blur(); // without the focus on the field, keys control the replay again
    void app.past.lookAt(time);
  });
  return field;
}

function speedChoice(app: App): HTMLElement {
  const choice = element("select", { "aria-label": "Speed", title: "Speed" });
  choice.addEventListener("change", () => void app.replay.setSpeed(Number(choice.value)));
  app.store.watch(
    ({ replay }) => replay?.speed ?? 1,
    (speed) => {
      // The replay may have a speed that is not in the list, so this speed is added.
      const speeds = [...new Set([...SPEEDS, speed])].sort((a, b) => a - b);
      choice.replaceChildren(
        ...speeds.map((each) => new Option(`${each}×`, String(each), false, each === speed)),
      );
    },
  );
  return choice;
}

function loopButton(app: App): HTMLElement {
  const made = element(
    "button",
    {
      class: "button plain",
      type: "button",
      "aria-label": "Loop",
      title: "Loop: at the end, play again from the start",
      onclick: () => void app.replay.toggleLoop(),
    },
    icon("loop"),
  );
  app.store.watch(
    ({ replay }) => replay?.loop ?? false,
    (loop) => made.setAttribute("aria-pressed", String(loop)),
  );
  return made;
}
