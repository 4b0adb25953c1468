// Notes at simulated times. Notes of a recording are saved beside its file. Notes of a running
// simulation are sent to all viewers and written to its recordings.
import type { SimulationApi } from "../api/SimulationApi";
import { youOf } from "../state/people";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { shallowEqual } from "../state/Store";
import { withNewEvents } from "../state/timeline";
import { notify } from "./notices";

type NotesApi = Pick<SimulationApi, "notesOf" | "addNoteTo" | "removeNote" | "addNote">;

// The server's name for the recording that is replayed; empty if there is none.
export function recordingOf({ replay, inPast, abilities }: State): string {
  return replay && !inPast ? abilities.recording : "";
}

// Whether notes can be added: to a recording, or to a running simulation.
export function canNote(state: State): boolean {
  return state.simulation !== null && (state.replay === null || state.inPast || recordingOf(state) !== "");
}

export class NotesControl {
  constructor(
    private readonly store: Store<State>,
    private readonly api: NotesApi,
  ) {}

  start(): void {
    this.store.watch(recordingOf, (recording) => void this.load(recording));
  }

  // Adds a note at the instant that the page shows. Resolves to true if the server has stored it.
  async add(text: string): Promise<boolean> {
    const state = this.store.get();
    const { simulation, wishedTime, time, people } = state;
    const author = youOf(people)?.name ?? "";
    const instant = wishedTime ?? time;
    const recording = recordingOf(state);
    if (simulation === null || !canNote(state)) return false;
    return this.attempt(async () => {
      if (recording !== "") {
        await this.api.addNoteTo(recording, instant, text, author);
        return this.load(recording);
      }
      await this.api.addNote(simulation, instant, text, author);
      const detail = author ? `${author}: ${text}` : text;
      const note = { time: instant, event: "note", robot: "", detail };
      // Notes of a running simulation arrive with its other events. But if the page shows the past,
      // its replay was opened before this note. So the note is added here.
      if (state.inPast) this.store.set(({ events }) => ({ events: withNewEvents(events, [note]) }));
    });
  }

  remove(id: number): Promise<boolean> {
    const recording = recordingOf(this.store.get());
    return this.attempt(async () => {
      await this.api.removeNote(recording, id);
      await this.load(recording);
    });
  }

  private async load(recording: string): Promise<void> {
    if (recording === "") return this.store.set({ notes: [] });
    const notes = await this.api.notesOf(recording).catch((error: Error) => {
      notify(this.store, "error", error.message);
      return [];
    });
    if (recordingOf(this.store.get()) !== recording || shallowEqual(notes, this.store.get().notes)) return;
    this.store.set({ notes });
  }

  private async attempt(change: () => Promise<void>): Promise<boolean> {
    try {
      await change();
      return true;
    } catch (error) {
      notify(this.store, "error", (error as Error).message);
      return false;
    }
  }
}
