// Plays a recording, for the timeline and the keys.
//
// The server performs one seek at a time. During a seek, only the last requested instant is kept,
// for example while a slider is dragged. Steps are added up.
import type { Action, SimulationApi } from "../api/SimulationApi";
import type { Replay } from "../api/replay";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { allMarks, markBeside } from "../state/timeline";
import { notify } from "./notices";

export const SPEEDS: readonly number[] = [0.1, 0.25, 0.5, 1, 2, 5, 10];

const MOST_POSES = 1000; // maximum number of poses in one step, as in the server

type Move = { time: number } | { poses: number };

export class ReplayControl {
  private moves: Move[] = [];
  private moving: Promise<void> | null = null;

  constructor(
    private readonly store: Store<State>,
    private readonly api: SimulationApi,
    private readonly act: (action: Action) => Promise<void>,
  ) {}

  // Pauses a replay that plays, or plays a replay that is paused. At its end, a replay starts from
  // the beginning.
  async playOrPause(): Promise<void> {
    const { status, replay, time } = this.store.get();
    if (!status || !replay) return;
    if (status.phase === "running") return this.act("pause");
    if (status.phase === "created") return this.act("start");
    if (status.phase === "finished" || time >= replay.end) await this.seek(replay.start);
    return this.act("resume");
  }

  // Goes to an instant of the recording. Resolves when the replay is at this instant, or at an
  // instant that was requested later.
  seek(time: number): Promise<void> {
    const { replay } = this.store.get();
    if (!replay) return Promise.resolve();
    const wishedTime = Math.min(replay.end, Math.max(replay.start, time));
    this.moves = [{ time: wishedTime }];
    this.store.set({ wishedTime });
    return this.move();
  }

  // Moves by a number of recorded instants (negative: backwards), and pauses.
  step(poses: number): void {
    if (!this.store.get().replay) return;
    const last = this.moves.at(-1);
    const sum = poses + (last && "poses" in last ? last.poses : 0);
    if (last && "poses" in last) this.moves.pop();
    if (sum !== 0) this.moves.push({ poses: Math.min(MOST_POSES, Math.max(-MOST_POSES, sum)) });
    void this.move();
  }

  toStart(): void {
    const { replay } = this.store.get();
    if (replay) void this.seek(replay.start);
  }

  toEnd(): void {
    const { replay } = this.store.get();
    if (replay) void this.seek(replay.end);
  }

  // Goes to the next or the previous event.
  toEvent(direction: 1 | -1): void {
    const { replay, time, wishedTime } = this.store.get();
    const there = replay && markBeside(allMarks(this.store.get()), wishedTime ?? time, direction);
    if (there !== null) void this.seek(there);
  }

  setSpeed(speed: number): Promise<void> {
    return this.change({ speed });
  }

  toggleLoop(): Promise<void> {
    return this.change({ loop: !this.store.get().replay?.loop });
  }

  private async change(change: Partial<Pick<Replay, "speed" | "loop">>): Promise<void> {
    const { simulation } = this.store.get();
    if (!simulation) return;
    try {
      const replay = await this.api.changeReplay(simulation, change);
      if (this.store.get().simulation === simulation) this.store.set({ replay });
    } catch (error) {
      notify(this.store, "error", (error as Error).message);
    }
  }

  private move(): Promise<void> {
    this.moving ??= this.moveAll().finally(() => (this.moving = null));
    return this.moving;
  }

  private async moveAll(): Promise<void> {
    const { simulation } = this.store.get();
    try {
      for (let move = this.moves.shift(); move && simulation; move = this.moves.shift()) {
        const { time } = await ("time" in move
          ? this.api.seek(simulation, move.time)
          : this.api.stepPoses(simulation, move.poses));
        if (this.store.get().simulation !== simulation) break;
        this.store.set({ time });
      }
    } catch (error) {
      notify(this.store, "error", (error as Error).message);
    }
    this.moves = [];
    this.store.set({ wishedTime: null });
  }
}
