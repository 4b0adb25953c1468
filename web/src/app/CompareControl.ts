// Replays a second recording for comparison, together with the first recording and at the same
// simulated time.
import type { SimulationApi } from "../api/SimulationApi";
import type { CurveOf, WholeCurve } from "../api/curve";
import { FoxgloveClient } from "../protocol/FoxgloveClient";
import type { PosesMessage } from "../protocol/messages";
import { seconds } from "../protocol/messages";
import { POSES } from "../protocol/packedPoses";
import type { RecordingLine } from "../recordings/recordings";
import { fetchRecordings } from "../recordings/recordings";
import type { Comparison } from "../state/comparison";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { resultOf } from "../state/comparison";
import { shallowEqual } from "../state/Store";
import { recordingOf } from "./NotesControl";
import { notify } from "./notices";

// If the times of the two recordings differ by more than this, the second recording is moved to the
// instant of the first.
const FARTHEST_APART_S = 0.15;

type CompareApi = Pick<SimulationApi, "another" | "rootServer" | "difference">;
type Client = Pick<FoxgloveClient, "connect" | "close" | "subscribe">;

// The poses of the second recording's robots, which are drawn as ghosts.
export interface GhostPoses {
  stamp: number; // s, simulated
  layoutVersion: number;
  poses: Float64Array;
}

export class CompareControl {
  onPoses: (poses: GhostPoses) => void = () => {};
  private other: { api: SimulationApi; client: Client; simulation: string } | null = null;
  private stamp = 0; // current time of the second recording, simulated, s
  private isMoving = false;
  private movesAgain = false;

  constructor(
    private readonly store: Store<State>,
    private readonly api: CompareApi,
    private readonly makeClient = (url: string, events: ConstructorParameters<typeof FoxgloveClient>[1]): Client =>
      new FoxgloveClient(url, events),
  ) {}

  start(): void {
    this.store.watch(
      ({ time, wishedTime }) => wishedTime ?? time,
      () => this.follow(),
    );
    this.store.watch(
      ({ status, replay }) => ({ phase: status?.phase, speed: replay?.speed }),
      () => this.follow(true),
      shallowEqual,
    );
    this.store.watch(
      ({ replay }) => replay !== null,
      (isReplay) => isReplay || this.end(),
    );
  }

  // Returns the recordings with which the replayed recording can be compared.
  async choices(): Promise<RecordingLine[]> {
    const { lines } = await fetchRecordings(this.api.rootServer);
    const shown = recordingOf(this.store.get());
    return lines.filter(({ name, state }) => name !== shown && state !== "unreadable");
  }

  async with(recording: string): Promise<void> {
    this.end();
    const empty: Comparison = { recording, simulation: "", scene: null, difference: null, problem: "" };
    this.store.set({ comparison: empty });
    const isWanted = () => this.store.get().comparison?.recording === recording;
    try {
      const api = this.api.another();
      await api.openRecording(recording);
      const simulation = (await api.simulations())[0]?.name;
      if (simulation === undefined) throw new Error("The recording has no simulation.");
      const scene = await api.scene(simulation).catch(() => null);
      if (!isWanted()) return;
      this.connect(api, simulation); // connect first: the scene's models come from this replay
      this.set({ simulation, scene });
      this.follow(true);
    } catch (error) {
      if (isWanted()) this.set({ problem: (error as Error).message });
      return;
    }
    await this.findDifference(recording);
  }

  end(): void {
    this.other?.client.close();
    this.other = null;
    if (this.store.get().comparison) this.store.set({ comparison: null });
  }

  // Returns a value over the whole second recording; null if there is no second recording.
  async curve(of: CurveOf, most: number): Promise<WholeCurve | null> {
    return this.other ? this.other.api.curve(this.other.simulation, of, most) : null;
  }

  // Returns the address of a model of the second recording.
  modelUrl(id: string): string {
    return (this.other?.api ?? this.api.another()).modelUrl(id);
  }

  private async findDifference(recording: string): Promise<void> {
    const shown = recordingOf(this.store.get());
    if (shown === "") return;
    try {
      const difference = await this.api.difference(shown, recording);
      if (this.store.get().comparison?.recording !== recording) return;
      this.set({ difference });
      const { sentence, details } = resultOf(this.store.get().comparison!);
      notify(this.store, "note", `${sentence} ${details.split("\n", 1)[0]!}`.trim());
    } catch (error) {
      if (this.store.get().comparison?.recording === recording) this.set({ problem: (error as Error).message });
    }
  }

  private set(change: Partial<Comparison>): void {
    this.store.set(({ comparison }) => ({ comparison: comparison && { ...comparison, ...change } }));
  }

  private connect(api: SimulationApi, simulation: string): void {
    const client = this.makeClient(api.socketUrl(simulation), {
      onConnection: () => {},
      onTopics: () => {},
      onProblem: (sentence) => this.set({ problem: sentence }),
    });
    this.other = { api, client, simulation };
    client.subscribe<PosesMessage>(POSES, ({ stamp, layout_version, poses }) => {
      this.stamp = seconds(stamp);
      this.onPoses({ stamp: this.stamp, layoutVersion: layout_version, poses });
    });
    client.connect();
  }

  // Moves the second recording to the instant of the first recording, and plays or pauses both
  // together.
  private follow(isChange = false): void {
    if (!this.other) return;
    const { status, time, wishedTime } = this.store.get();
    const isPlaying = status?.phase === "running" && wishedTime === null;
    const isApart = Math.abs((wishedTime ?? time) - this.stamp) > FARTHEST_APART_S;
    if (!isChange && isPlaying && !isApart) return;
    this.movesAgain = true;
    if (!this.isMoving) void this.move();
  }

  private async move(): Promise<void> {
    this.isMoving = true;
    while (this.movesAgain && this.other) {
      this.movesAgain = false;
      const { other } = this;
      try {
        await this.moveOnce(other);
      } catch (error) {
        if (this.other === other) this.set({ problem: (error as Error).message });
      }
    }
    this.isMoving = false;
  }

  private async moveOnce({ api, simulation }: NonNullable<CompareControl["other"]>): Promise<void> {
    const { status, time, wishedTime, replay } = this.store.get();
    if (replay) await api.changeReplay(simulation, { speed: replay.speed });
    const { phase, time: there } = await api.seek(simulation, wishedTime ?? time);
    this.stamp = there;
    const plays = status?.phase === "running" && wishedTime === null;
    if (plays && phase !== "running") await api.act(simulation, phase === "created" ? "start" : "resume");
    else if (!plays && phase === "running") {
      await api.act(simulation, "pause");
      // The replay has advanced between the seek and the pause, so it must seek again.
      this.movesAgain = true;
    }
  }
}
