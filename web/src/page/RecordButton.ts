// Starts and stops recording. Also shows whether the simulation is being recorded by any viewer or
// program.
import type { App } from "../app/App";
import type { Recording } from "../api/recording";
import { mayAct } from "../state/people";
import { shallowEqual } from "../state/Store";
import { element, setText } from "../ui/element";
import { formatSize } from "../ui/format";
import { icon } from "../ui/icons";

export function createRecordButton(app: App): HTMLElement {
  const size = element("span", { class: "number" });
  const button = element(
    "button",
    { class: "button plain worded record", type: "button", "aria-label": "Record", onclick: () => app.records.press() },
    icon("record"),
    element("span", { class: "word", "aria-hidden": "true" }, "Record"),
    size,
  );
  app.store.watch(
    ({ recording, connection, people }) => ({
      recording,
      isOpen: connection.phase === "open" && mayAct(people),
    }),
    ({ recording, isOpen }) => {
      button.hidden = recording === null;
      button.disabled = !isOpen || recording === null;
      button.setAttribute("aria-pressed", String(recording?.isOn === true));
      button.title = recording ? titleOf(recording) : "Record";
      setText(size, recording?.isOn ? formatSize(recording.bytes) : "");
    },
    shallowEqual,
  );
  return element("div", { class: "record-place" }, button, question(app));
}

function question(app: App): HTMLElement {
  const path = element("p", {});
  const answer = (label: string, stops: boolean) =>
    element("button", { class: "button", type: "button", onclick: () => app.records.answer(stops) }, label);
  const card = element(
    "div",
    { class: "card record-question", role: "alertdialog", "aria-label": "End the recording?" },
    path,
    element("div", {}, answer("End recording", true), answer("Continue recording", false)),
  );
  app.store.watch(
    ({ stopRecordingAsked, recording }) => (stopRecordingAsked ? (recording?.path ?? "") : null),
    (asked) => {
      card.hidden = asked === null;
      setText(path, `This recording was not started on this page. End it? File: ${asked}`);
    },
  );
  return card;
}

function titleOf({ isOn, path, droppedMessages }: Recording): string {
  if (!isOn) return path ? `Record (last recording: ${path})` : "Record";
  const lost = droppedMessages > 0 ? `; ${droppedMessages} messages not recorded, because the disk was too slow` : "";
  return `Recording to ${path}${lost}. Press to stop`;
}
