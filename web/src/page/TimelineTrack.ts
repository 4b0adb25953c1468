// The slider of a timeline, with marks of events.
import type { App } from "../app/App";
import type { State } from "../state/State";
import { shallowEqual } from "../state/Store";
import type { Mark } from "../state/timeline";
import { allMarks, spanOf } from "../state/timeline";
import { element } from "../ui/element";
import { formatTime } from "../ui/format";

const MARKS_MS = 500; // of a run: minimum time between two drawings of the marks, which move slowly

export function createTimelineTrack(app: App): HTMLElement {
  return element("div", { class: "timeline-track" }, slider(app), marks(app));
}

// The time to show. If an instant was requested, this is the requested time, until the server has
// answered.
export function shownTime({ time, wishedTime }: State): number {
  return wishedTime ?? time;
}

// This is the browser's own slider: it handles pointers, touch and keys, and works with assistive
// technology.
function slider(app: App): HTMLElement {
  const input = element("input", { type: "range", class: "timeline-slider", step: "any" });
  let isHeld = false;
  const hold = (held: boolean) => () => (isHeld = held);
  input.addEventListener("pointerdown", hold(true));
  for (const end of ["pointerup", "pointercancel", "change"]) input.addEventListener(end, hold(false));
  input.addEventListener("input", () => void app.past.lookAt(Number(input.value)));
  app.store.watch(
    (state) => ({ replay: state.replay, kept: state.kept, time: shownTime(state), now: state.time }),
    ({ replay, kept, time, now }) => {
      const span = spanOf(replay, kept, now);
      if (!span) return;
      // While the user drags the slider, its range does not change, because this would move the
      // thumb.
      if (!isHeld || replay) {
        input.min = String(span.start);
        input.max = String(span.end);
      }
      const whole = replay ? formatTime(span.end) : "the running simulation";
      input.setAttribute("aria-valuetext", `${formatTime(time)} of ${whole}`);
      // While the user holds the thumb, playback does not move it.
      if (!isHeld) input.value = String(time);
    },
    shallowEqual,
  );
  app.store.watch(
    ({ replay }) => replay !== null,
    (isReplay) => input.setAttribute("aria-label", isReplay ? "Time in the recording" : "Time in the run"),
  );
  app.store.watch(
    ({ connection }) => connection.phase === "open",
    (isOpen) => (input.disabled = !isOpen),
  );
  return input;
}

// A press on a mark goes to its time. The keys "," and "." go to the previous and the next mark.
function marks(app: App): HTMLElement {
  const place = element("div", { class: "timeline-marks", role: "group", "aria-label": "Events" });
  let timer: ReturnType<typeof setTimeout> | undefined;
  const draw = () => {
    timer = undefined;
    place.replaceChildren(...allMarks(app.store.get()).map((mark) => markButton(app, mark)));
  };
  app.store.watch(
    ({ replay, kept, events, notes, comparison }) => ({
      start: replay?.start,
      end: replay?.end,
      kept,
      events,
      notes,
      difference: comparison?.difference,
    }),
    () => {
      if (app.store.get().replay) {
        clearTimeout(timer);
        draw();
      } else {
        timer ??= setTimeout(draw, MARKS_MS);
      }
    },
    shallowEqual,
  );
  return place;
}

function markButton(app: App, mark: Mark): HTMLElement {
  const made = element(
    "button",
    {
      class: ["mark", mark.isBad && "bad", mark.kind !== "event" && mark.kind].filter(Boolean).join(" "),
      type: "button",
      tabindex: "-1",
      "aria-label": mark.text,
      onclick: () => void app.past.lookAt(mark.time),
    },
    element("span", { class: "mark-text card", "aria-hidden": "true" }, mark.text),
  );
  made.style.setProperty("--share", String(mark.share));
  return made;
}
