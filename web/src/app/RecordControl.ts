// Switches the recording of the watched simulation on and off, and keeps asking how it stands: others
// may have switched it, the disk may have failed.
import type { SimulationApi } from "../api/SimulationApi";
import type { Recording } from "../api/recording";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { shallowEqual } from "../state/Store";
import { notify } from "./notices";

const POLL_MS = 1500;

export class RecordControl {
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly store: Store<State>,
    private readonly api: SimulationApi,
  ) {}

  start(): void {
    this.store.watch(
      ({ simulation, abilities, replay, connection }) =>
        abilities.records && replay === null && connection.phase === "open" ? simulation : null,
      (simulation) => {
        clearTimeout(this.timer);
        this.store.set({ recording: null });
        if (simulation !== null) void this.ask(simulation);
      },
    );
  }

  async toggle(): Promise<void> {
    const { simulation, recording } = this.store.get();
    if (!simulation || !recording) return;
    try {
      const now = await this.api.record(simulation, !recording.isOn);
      this.take(simulation, now);
      notify(this.store, "note", now.isOn ? `Recording to ${now.path}` : `Recording saved. Replay it on the page Recordings, or with: gsv replay ${quoted(now.path)}`);
    } catch (error) {
      notify(this.store, "error", (error as Error).message);
    }
  }

  private async ask(simulation: string): Promise<void> {
    const known = await this.api.recording(simulation).catch(() => null); // the connection tells of itself
    if (this.store.get().simulation !== simulation) return;
    if (known) this.take(simulation, known);
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.ask(simulation), POLL_MS);
  }

  private take(simulation: string, recording: Recording): void {
    const { simulation: watched, recording: known } = this.store.get();
    if (watched === simulation && !shallowEqual(recording, known)) this.store.set({ recording });
  }
}

function quoted(path: string): string {
  return /^[\w./-]+$/.test(path) ? path : `'${path.replaceAll("'", "'\\''")}'`;
}
