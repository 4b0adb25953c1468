// The bar below a recording: where it stands, to be dragged; its events; how it plays. Live
// simulations have none.
import type { App } from "../app/App";
import { SPEEDS } from "../app/ReplayControl";
import type { State } from "../state/State";
import { shallowEqual } from "../state/Store";
import type { Mark } from "../state/timeline";
import { marksOf } from "../state/timeline";
import { element, setText } from "../ui/element";
import { formatTime, parseTime } from "../ui/format";
import type { IconName } from "../ui/icons";
import { icon, setIcon } from "../ui/icons";

export function createTimeline(app: App): HTMLElement {
  const bar = element(
    "section",
    { class: "timeline", "aria-label": "Recording" },
    element("div", { class: "timeline-track" }, slider(app), marks(app)),
    element(
      "div",
      { class: "timeline-controls" },
      element(
        "div",
        { class: "timeline-transport", role: "group", "aria-label": "Playback" },
        button(app, "toStart", "Go to the start", "Home", () => app.replay.toStart()),
        button(app, "stepBack", "Previous pose", "ArrowLeft", () => app.replay.step(-1)),
        playButton(app),
        button(app, "stepOn", "Next pose", "ArrowRight", () => app.replay.step(1)),
        button(app, "toEnd", "Go to the end", "End", () => app.replay.toEnd()),
      ),
      times(app),
      element("div", { class: "timeline-pace" }, speedChoice(app), loopButton(app)),
    ),
  );
  app.store.watch(
    ({ replay }) => replay !== null,
    (isReplay) => (bar.hidden = !isReplay),
  );
  return bar;
}

// Where it will be as soon as the server has answered.
function shownTime({ time, wishedTime }: State): number {
  return wishedTime ?? time;
}

// A browser's own slider: it knows pointers, touch and keys, and tells assistive technology.
function slider(app: App): HTMLElement {
  const input = element("input", {
    type: "range",
    class: "timeline-slider",
    step: "any",
    "aria-label": "Time in the recording",
  });
  let isHeld = false;
  const hold = (held: boolean) => () => (isHeld = held);
  input.addEventListener("pointerdown", hold(true));
  for (const end of ["pointerup", "pointercancel", "change"]) input.addEventListener(end, hold(false));
  input.addEventListener("input", () => void app.replay.seek(Number(input.value)));
  app.store.watch(
    (state) => ({ replay: state.replay, time: shownTime(state) }),
    ({ replay, time }) => {
      if (!replay) return;
      input.min = String(replay.start);
      input.max = String(replay.end);
      input.setAttribute("aria-valuetext", `${formatTime(time)} of ${formatTime(replay.end)}`);
      // What plays does not draw the thumb away from under a finger.
      if (!isHeld) input.value = String(time);
    },
    shallowEqual,
  );
  app.store.watch(
    ({ connection }) => connection.phase === "open",
    (isOpen) => (input.disabled = !isOpen),
  );
  return input;
}

// A press on a mark goes to its instant; keys reach them by "," and ".".
function marks(app: App): HTMLElement {
  const place = element("div", { class: "timeline-marks", role: "group", "aria-label": "Events" });
  app.store.watch(
    ({ replay, events }) => ({ start: replay?.start, end: replay?.end, events }),
    () => {
      const { replay, events } = app.store.get();
      place.replaceChildren(...(replay ? marksOf(events, replay) : []).map((mark) => markButton(app, mark)));
    },
    shallowEqual,
  );
  return place;
}

function markButton(app: App, mark: Mark): HTMLElement {
  const made = element(
    "button",
    {
      class: mark.isBad ? "mark bad" : "mark",
      type: "button",
      tabindex: "-1",
      "aria-label": mark.text,
      onclick: () => void app.replay.seek(mark.time),
    },
    element("span", { class: "mark-text card", "aria-hidden": "true" }, mark.text),
  );
  made.style.setProperty("--share", String(mark.share));
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
    ({ replay }) => (replay ? ` / ${formatTime(replay.end)}` : ""),
    (text) => setText(end, text),
  );
  return element("span", { class: "timeline-times number", title: "Simulated time" }, now, end, typedTime(app));
}

// Enter goes to the instant that was typed.
function typedTime(app: App): HTMLElement {
  const field = element("input", {
    class: "typed-time number",
    "aria-label": "Go to time",
    placeholder: "go to…",
    title: "Seconds or minutes:seconds; press Enter to go there",
    autocomplete: "off",
    spellcheck: "false",
  });
  field.addEventListener("input", () => field.removeAttribute("aria-invalid"));
  field.addEventListener("keydown", ({ key }) => {
    if (key === "Escape") field.blur();
    if (key !== "Enter") return;
    const time = parseTime(field.value);
    field.setAttribute("aria-invalid", String(time === null));
    if (time === null) return;
    field.blur(); // keys are the replay's again
    void app.replay.seek(time);
  });
  return field;
}

function speedChoice(app: App): HTMLElement {
  const choice = element("select", { "aria-label": "Speed", title: "Speed" });
  choice.addEventListener("change", () => void app.replay.setSpeed(Number(choice.value)));
  app.store.watch(
    ({ replay }) => replay?.speed ?? 1,
    (speed) => {
      // It may have been started at a speed of its own.
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
      title: "Start again at the end",
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
