// Records the simulation; shows whether it is recorded, whoever switched it on.
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
    { class: "button record", type: "button", "aria-label": "Record", onclick: () => void app.records.toggle() },
    icon("record"),
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
  return button;
}

function titleOf({ isOn, path, droppedMessages }: Recording): string {
  if (!isOn) return path ? `Record (last recording: ${path})` : "Record";
  const lost = droppedMessages > 0 ? `; the disk was too slow for ${droppedMessages} messages` : "";
  return `Recording to ${path}${lost}. Press to stop`;
}
