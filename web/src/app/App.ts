// What the panels, the keyboard and the pointer can ask for.
import type { Action, SimulationApi } from "../api/SimulationApi";
import { camerasOf } from "../api/scene";
import type { World3D } from "../scene/World3D";
import { isAllowed, mainAction } from "../state/actions";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { dismiss, notify } from "./notices";
import { ReplayControl } from "./ReplayControl";
import type { Session } from "./Session";

export class App {
  readonly replay: ReplayControl;

  constructor(
    readonly store: Store<State>,
    readonly session: Session,
    private readonly api: SimulationApi,
    private readonly world: World3D | null, // null where the browser cannot draw in 3D
  ) {
    this.replay = new ReplayControl(store, api, (action) => this.act(action));
  }

  // Sends one action. What comes of it arrives with the stream: the answer may come later than what
  // happened after it. A refusal shows the server's sentence.
  async act(action: Action, count = 1): Promise<void> {
    const { simulation, pending } = this.store.get();
    if (!simulation || pending) return;
    this.store.set({ pending: action });
    try {
      await this.api.act(simulation, action, count);
    } catch (error) {
      notify(this.store, "error", (error as Error).message);
    } finally {
      this.store.set({ pending: null });
    }
  }

  startPauseOrResume(): void {
    if (this.store.get().replay) return void this.replay.playOrPause();
    const phase = this.store.get().status?.phase;
    const action = mainAction(phase);
    if (isAllowed(phase, action)) void this.act(action);
  }

  stepOnce(): void {
    if (this.store.get().replay) return this.replay.step(1);
    if (isAllowed(this.store.get().status?.phase, "step")) void this.act("step");
  }

  // The camera pane turns to the selected robot's camera, if it has one.
  select(robot: string | null): void {
    this.store.set(({ selection, selectedPose, following, scene, camera }) => ({
      selection: robot,
      selectedPose: robot === selection ? selectedPose : null,
      following: following && robot !== null,
      camera:
        camera?.robot === robot ? camera : (camerasOf(scene).find((each) => each.robot === robot) ?? camera),
    }));
  }

  // Follows the selected robot, or the first one when none is; a second time ends it.
  toggleFollowing(): void {
    const { selection, following, status } = this.store.get();
    const robot = selection ?? status?.robots[0]?.name ?? null;
    if (robot && !selection) this.select(robot);
    this.store.set({ following: robot !== null && !following });
  }

  toggle(part: keyof State["shown"]): void {
    this.store.set(({ shown }) => ({ shown: { ...shown, [part]: !shown[part] } }));
  }

  topView(): void {
    this.world?.topView();
  }

  resetView(): void {
    this.store.set({ following: false });
    this.world?.resetView();
  }

  openHelp(open: boolean): void {
    this.store.set({ helpOpen: open });
  }

  dismiss(notice: number): void {
    dismiss(this.store, notice);
  }
}
