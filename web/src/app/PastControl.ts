// Shows the past of a running simulation: requests the part that the server stores and its events,
// and replays it while the run continues.
import type { SimulationApi } from "../api/SimulationApi";
import type { CurveOf, WholeCurve } from "../api/curve";
import type { RecordedEvent } from "../api/replay";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { shallowEqual } from "../state/Store";
import { withNewEvents } from "../state/timeline";
import type { ReplayControl } from "./ReplayControl";
import type { Session } from "./Session";
import { notify } from "./notices";

const POLL_MS = 2000;
// Each request also requests the last second of the previous request again, because the server may
// have received some events of this second late.
const OVERLAP_S = 1;
// The curves of the past come from a separate replay. After this time, the next request opens a new
// replay, because a new one contains more of the run.
const READER_MS = 10_000;

type PastApi = Pick<SimulationApi, "kept" | "eventsFrom" | "another">;
type PastSession = Pick<Session, "enterPast" | "goLive">;

export class PastControl {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private entering: Promise<void> | null = null;
  private asked = 0; // simulated time, s, up to which the events are known
  private reader: { api: Promise<SimulationApi>; simulation: string; openedMs: number } | null = null;

  constructor(
    private readonly store: Store<State>,
    private readonly api: PastApi,
    private readonly session: PastSession,
    private readonly replay: Pick<ReplayControl, "seek">,
  ) {}

  start(): void {
    this.store.watch(
      ({ simulation, connection, isLive }) => ({
        simulation: isLive ? simulation : null, // a replay has no stored past
        isOpen: connection.phase === "open",
      }),
      ({ simulation, isOpen }) => {
        clearTimeout(this.timer);
        this.asked = 0;
        if (simulation !== null && isOpen) void this.ask(simulation);
      },
      shallowEqual,
    );
  }

  // Goes to an instant of the recording or of the stored past.
  lookAt(time: number): Promise<void> {
    const { replay, kept } = this.store.get();
    if (replay) return this.replay.seek(time);
    if (!kept) return Promise.resolve();
    this.store.set({ wishedTime: Math.min(kept.end, Math.max(kept.start, time)) });
    this.entering ??= this.enter().finally(() => (this.entering = null));
    return this.entering;
  }

  goLive(): void {
    this.session.goLive();
  }

  // Returns the curve of a value in the stored past, with at most `most` samples.
  async curve(simulation: string, of: CurveOf, most: number): Promise<WholeCurve> {
    const now = Date.now();
    if (this.reader?.simulation !== simulation || now - this.reader.openedMs > READER_MS) {
      const api = this.api.another();
      this.reader = { simulation, openedMs: now, api: api.openPast(simulation).then(() => api) };
    }
    return (await this.reader.api).curve(simulation, of, most);
  }

  private async enter(): Promise<void> {
    try {
      await this.session.enterPast();
      const { wishedTime } = this.store.get();
      if (wishedTime !== null) await this.replay.seek(wishedTime);
    } catch (error) {
      this.store.set({ wishedTime: null });
      notify(this.store, "error", `Cannot show the past: ${(error as Error).message}`);
    }
  }

  private async ask(simulation: string): Promise<void> {
    const isWanted = () => this.store.get().simulation === simulation && this.store.get().isLive;
    try {
      const kept = await this.api.kept(simulation);
      if (!isWanted()) return;
      if (kept === null) return this.store.set({ kept });
      // After a reset, simulated time starts at 0 again. So the events of the previous run are
      // removed.
      if (kept.end < this.asked - OVERLAP_S) {
        this.asked = 0;
        this.store.set({ events: [] });
      }
      const from = Math.max(0, this.asked - OVERLAP_S);
      const found = await this.api.eventsFrom(simulation, from);
      if (!isWanted()) return;
      this.asked = Math.max(kept.end, this.store.get().time);
      this.take(found);
      if (!shallowEqual(kept, this.store.get().kept)) this.store.set({ kept });
    } catch {
      // Ignored: the connection reports its own failures, and the next request may succeed.
    }
    clearTimeout(this.timer);
    if (isWanted()) this.timer = setTimeout(() => void this.ask(simulation), POLL_MS);
  }

  private take(found: RecordedEvent[]): void {
    const { events } = this.store.get();
    const merged = withNewEvents(events, found);
    if (merged !== events) this.store.set({ events: merged });
  }
}
