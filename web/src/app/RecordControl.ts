// Starts and stops the recording of the simulation. Polls the state of the recording, because other
// viewers may change it, and because the disk may fail.
import type { SimulationApi } from "../api/SimulationApi";
import type { Recording } from "../api/recording";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { shallowEqual } from "../state/Store";
import { notify } from "./notices";

const POLL_MS = 1500;

export class RecordControl {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private startedHere = ""; // path of the recording that this page has started

  constructor(
    private readonly store: Store<State>,
    private readonly api: SimulationApi,
  ) {}

  start(): void {
    this.store.watch(
      ({ simulation, abilities, replay, connection }) => ({
        simulation: abilities.records && replay === null ? simulation : null,
        isOpen: connection.phase === "open",
      }),
      ({ simulation, isOpen }, before) => {
        clearTimeout(this.timer);
        // After the server has ended, its last recording is still shown. It is removed only if
        // the page shows another simulation or a replay.
        if (simulation !== before?.simulation) this.store.set({ recording: null });
        if (simulation !== null && isOpen) void this.ask(simulation);
      },
      shallowEqual,
    );
  }

  // Starts or ends the recording. If this page has not started the recording, it asks the user
  // before ending it, because a command line or another viewer may need the recording.
  press(): void {
    const { recording } = this.store.get();
    if (recording?.isOn && recording.path !== this.startedHere) this.store.set({ stopRecordingAsked: true });
    else void this.toggle();
  }

  answer(stops: boolean): void {
    this.store.set({ stopRecordingAsked: false });
    if (stops && this.store.get().recording?.isOn) void this.toggle();
  }

  private async toggle(): Promise<void> {
    const { simulation, recording } = this.store.get();
    if (!simulation || !recording) return;
    try {
      const now = await this.api.record(simulation, !recording.isOn);
      this.take(simulation, now);
      if (now.isOn) this.startedHere = now.path;
      notify(this.store, "note", now.isOn ? `Recording to ${now.path}` : `Recording saved. Replay it on the page Recordings, or with: gsv replay ${quoted(now.path)}`);
    } catch (error) {
      notify(this.store, "error", (error as Error).message);
    }
  }

  private async ask(simulation: string): Promise<void> {
    const known = await this.api.recording(simulation).catch(() => null); // the connection reports its own failures
    const { simulation: watched, replay } = this.store.get();
    if (watched !== simulation || replay !== null) return; // the past of a simulation is a replay, which cannot be recorded
    if (known) this.take(simulation, known);
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.ask(simulation), POLL_MS);
  }

  private take(simulation: string, recording: Recording): void {
    const { simulation: watched, recording: known } = this.store.get();
    if (watched !== simulation || shallowEqual(recording, known)) return;
    this.store.set(({ stopRecordingAsked }) => ({
      recording,
      stopRecordingAsked: stopRecordingAsked && recording.isOn,
    }));
  }
}

function quoted(path: string): string {
  return /^[\w./-]+$/.test(path) ? path : `'${path.replaceAll("'", "'\\''")}'`;
}
