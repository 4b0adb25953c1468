// The menu of notes: adds a note at the present instant, lists all notes, goes to the time of a
// note, and removes notes from a recording.
import type { App } from "../app/App";
import { canNote, recordingOf } from "../app/NotesControl";
import type { RecordingNote } from "../api/history";
import { mayAct } from "../state/people";
import type { State } from "../state/State";
import { shallowEqual } from "../state/Store";
import { element, setText } from "../ui/element";
import { formatTime } from "../ui/format";
import { icon } from "../ui/icons";
import { createMenu } from "../ui/menu";
import { shownTime } from "./TimelineTrack";

const LONGEST_NOTE = 500; // characters

export function createNotesMenu(app: App): HTMLElement {
  const list = element("ol", { class: "note-list", "aria-label": "Notes" });
  const menu = createMenu("Notes", "label", addForm(app), list);
  const count = element("span", { class: "number note-count", "aria-hidden": "true" });
  menu.button.append(count);
  app.store.watch(
    (state) => canNote(state),
    (isPossible) => (menu.element.hidden = !isPossible),
  );
  app.store.watch(
    (state) => ({ notes: state.notes, events: state.events, recording: recordingOf(state) }),
    () => {
      const notes = notesOf(app.store.get());
      setText(count, notes.length > 0 ? String(notes.length) : "");
      menu.button.setAttribute("aria-label", notes.length > 0 ? `Notes ${notes.length}` : "Notes");
      list.replaceChildren(...notes.map((note) => item(app, note, menu.close)));
    },
    shallowEqual,
  );
  app.menus.set("notes", menu.open);
  return menu.element;
}

// Returns the notes. Notes of a run have no id, because they are events of the run.
function notesOf({ notes, events }: State): (Omit<RecordingNote, "id"> & { id: number | null })[] {
  const ofRun = events.flatMap(({ event, time, detail }) => (event === "note" ? [{ id: null, time, text: detail }] : []));
  return [...notes, ...ofRun].sort((a, b) => a.time - b.time);
}

function addForm(app: App): HTMLElement {
  const field = element("input", {
    class: "note-text",
    "aria-label": "Note",
    placeholder: "What do you see at this time?",
    maxlength: String(LONGEST_NOTE),
    autocomplete: "off",
  });
  const button = element("button", { class: "button primary", type: "submit" });
  const form = element("form", { class: "note-form" }, field, button);
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const text = field.value.trim();
    if (text === "") return field.focus();
    void app.notes.add(text).then((isKept) => {
      if (isKept && field.value.trim() === text) field.value = "";
    });
  });
  app.store.watch(
    (state) => `Add at ${formatTime(shownTime(state))}`,
    (label) => setText(button, label),
  );
  app.store.watch(
    ({ connection, people }) => connection.phase === "open" && mayAct(people),
    (enabled) => (button.disabled = !enabled),
  );
  return form;
}

function item(app: App, { id, time, text }: { id: number | null; time: number; text: string }, close: () => void): HTMLElement {
  const goTo = () => {
    close();
    void app.past.lookAt(time);
  };
  const label = `Remove the note at ${formatTime(time)}`;
  return element(
    "li",
    {},
    element("button", { class: "button plain small number", type: "button", title: "Go to this time", onclick: goTo }, formatTime(time)),
    element("span", { class: "note" }, text),
    id !== null &&
      element(
        "button",
        { class: "button plain small", type: "button", "aria-label": label, title: label, onclick: () => void app.notes.remove(id) },
        icon("close"),
      ),
  );
}
