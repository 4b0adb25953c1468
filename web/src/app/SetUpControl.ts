// Sets up a simulation. Sends the user's changes to the server. The server returns the scene at the
// start and the problems. Finally, creates the simulation.
//
// One preview is requested at a time. While it is pending, only the last state of the form is kept
// for the next request.
import { ApiError } from "../api/JsonServer";
import type { SetUpApi } from "../api/SetUpApi";
import type { PedestrianSetUp } from "../api/pedestrians";
import { newPedestrians } from "../api/pedestrians";
import type { Placed, RobotList, RobotSetUp, Scenario } from "../api/scenario";
import { EMPTY_SCENARIO, findRobot, newRobot } from "../api/scenario";
import { withChangedRobot, withRobot, withoutRobot } from "../api/scenario";
import type { SetUp } from "../state/setUp";
import { changed, inTheirWords, redone, undone } from "../state/setUp";
import type { DroppedFile } from "../api/DroppedFile";
import { unpacked, worldsFirst } from "../upload/dropped";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { download } from "../ui/files";
import { notify } from "./notices";
import type { TextFile } from "./scenarioFile";
import { readScenario, scenarioFile, scenarioFileName } from "./scenarioFile";
import type { Session } from "./Session";

const OFFERS_POLL_MS = 3000;
const FIRST_WORLD = "office";

export class SetUpControl {
  private previewing: Promise<void> | null = null;
  private isStale = false; // whether the form has changed since the last preview was requested
  private offersTimer: ReturnType<typeof setTimeout> | undefined;
  private left: string | null = null; // the simulation that was shown before

  constructor(
    private readonly store: Store<State>,
    private readonly session: Session,
    private readonly api: SetUpApi,
  ) {}

  async open(): Promise<void> {
    if (this.store.get().setUp) return;
    this.left = this.store.get().simulation;
    this.session.rest();
    const none = { worlds: [], uploaded: [], models: [], behaviours: null, ros2: null };
    const setUp = { ...none, scenario: EMPTY_SCENARIO, past: [], future: [], warnings: [], poses: null };
    this.store.set({ setUp: { ...setUp, wrong: null, isBusy: true, isHeld: true } });
    void this.lookForOffers();
    await this.hold(async () => {
      const [worlds, models] = await Promise.all([this.api.worlds(), this.api.models()]);
      const world = worlds.includes(FIRST_WORLD) ? FIRST_WORLD : (worlds[0] ?? "");
      // The user may have chosen a world during the request, by dropping a world file on the page.
      // This world is kept.
      this.patch(({ scenario }) => ({ worlds, models, scenario: { ...scenario, world: scenario.world || world } }));
    });
    await this.preview();
  }

  // Returns to the simulation that was shown before.
  close(): void {
    this.end();
    if (this.left) this.session.join(this.left);
    else this.session.start();
  }

  // Waits for the preview first, because the last change may not have reached the server yet.
  async create(): Promise<void> {
    await this.previewing;
    const { setUp } = this.store.get();
    if (!setUp || setUp.isHeld) return;
    await this.hold(async () => {
      const name = await this.api.create(setUp.scenario);
      this.end();
      await this.session.joinNew(name);
    });
  }

  change(patch: Partial<Scenario>): void {
    this.take((setUp) => changed(setUp, { ...setUp.scenario, ...patch }));
  }

  addRobot(list: RobotList, model: string): void {
    const { setUp } = this.store.get();
    if (!setUp) return;
    const robot = newRobot(setUp.scenario, model);
    this.take((setUp) => changed(setUp, withRobot(setUp.scenario, list, robot)));
    this.store.set({ selection: robot.name });
  }

  removeRobot(list: RobotList, index: number): void {
    this.take((setUp) => changed(setUp, withoutRobot(setUp.scenario, list, index)));
  }

  changeRobot(list: RobotList, index: number, change: Partial<RobotSetUp>): void {
    const isSelected = this.store.get().selection === this.store.get().setUp?.scenario[list][index]?.name;
    this.take((setUp) => changed(setUp, withChangedRobot(setUp.scenario, list, index, change)));
    if (isSelected && change.name) this.store.set({ selection: change.name });
  }

  addPedestrians(): void {
    this.takePedestrians((groups) => [...groups, newPedestrians(groups)]);
  }

  removePedestrians(index: number): void {
    this.takePedestrians((groups) => groups.filter((_, i) => i !== index));
  }

  changePedestrians(index: number, patch: Partial<PedestrianSetUp>): void {
    this.takePedestrians((groups) => groups.map((group, i) => (i === index ? { ...group, ...patch } : group)));
  }

  // Moves a robot to the place to which the user has clicked or dragged.
  async place(name: string, place: Placed): Promise<boolean> {
    const { setUp } = this.store.get();
    const found = setUp && findRobot(setUp.scenario, name);
    if (!found) return false;
    this.changeRobot(found.list, found.index, { place });
    await this.previewing;
    return this.store.get().setUp?.wrong === null;
  }

  undo(): void {
    this.take(undone);
  }

  redo(): void {
    this.take(redone);
  }

  save(): void {
    const scenario = this.store.get().setUp?.scenario;
    if (scenario) download(scenarioFileName(scenario), scenarioFile(scenario));
  }

  async load(file: TextFile): Promise<void> {
    try {
      const { scenario, left } = await readScenario(file);
      this.take((setUp) => changed(setUp, scenario));
      if (left.length > 0) {
        notify(this.store, "note", `${file.name}: ${left.join(", ")} is not supported on this page and was ignored.`);
      }
    } catch (error) {
      notify(this.store, "error", (error as Error).message);
    }
  }

  // Uploads a world from this machine with its files. If there are several worlds, the user chooses
  // one of them.
  async drop(files: Promise<DroppedFile[]> | DroppedFile[]): Promise<void> {
    if (!this.store.get().setUp) await this.open();
    this.patch(() => ({ isBusy: true, isHeld: true }));
    try {
      const delivery = worldsFirst(await unpacked(await files));
      const places = await this.api.upload(delivery.files);
      const worlds = places.slice(0, delivery.worlds).map((path, index) => ({ name: delivery.files[index]!.path, path }));
      this.patch(({ uploaded }) => ({ uploaded: [...worlds, ...uploaded] }));
      this.change({ world: places[0]! });
    } catch (error) {
      this.patch(() => ({ isBusy: false, wrong: { field: "world", sentence: (error as Error).message } }));
    } finally {
      this.patch(() => ({ isHeld: false }));
    }
  }

  private end(): void {
    clearTimeout(this.offersTimer);
    this.store.set({ setUp: null, scene: null, selection: null });
  }

  private takePedestrians(change: (groups: PedestrianSetUp[]) => PedestrianSetUp[]): void {
    this.take((setUp) => {
      const { scenario } = setUp;
      return changed(setUp, { ...scenario, pedestrians: change(scenario.pedestrians) });
    });
  }

  private take(change: (setUp: SetUp) => SetUp): void {
    const { setUp } = this.store.get();
    if (!setUp) return;
    this.store.set({ setUp: change(setUp) });
    void this.preview();
  }

  private patch(change: (setUp: SetUp) => Partial<SetUp>): void {
    this.store.set(({ setUp }) => (setUp ? { setUp: { ...setUp, ...change(setUp) } } : {}));
  }

  private preview(): Promise<void> {
    this.isStale = true;
    this.previewing ??= this.previewAll().finally(() => (this.previewing = null));
    return this.previewing;
  }

  private async previewAll(): Promise<void> {
    while (this.isStale) {
      this.isStale = false;
      const { setUp } = this.store.get();
      if (!setUp?.scenario.world) return;
      await this.ask(async () => {
        const { scene, poses, warnings } = await this.api.preview(setUp.scenario);
        this.store.set(({ setUp }) => {
          if (!setUp) return {};
          const readable = warnings.map((warning) => inTheirWords(warning, setUp.uploaded));
          return { scene, setUp: { ...setUp, poses, warnings: readable } };
        });
      });
    }
  }

  // Performs a request. If the server refuses it, it may name a field of the form.
  private async ask(work: () => Promise<void>): Promise<void> {
    this.patch(() => ({ isBusy: true }));
    try {
      await work();
      this.patch(() => ({ wrong: null }));
    } catch (error) {
      const { message } = error as Error;
      const field = error instanceof ApiError ? error.field : "";
      this.patch(({ uploaded }) => ({ wrong: { field, sentence: inTheirWords(message, uploaded) } }));
    } finally {
      this.patch(() => ({ isBusy: false }));
    }
  }

  // Performs the request. The simulation cannot be created until the request has ended.
  private async hold(work: () => Promise<void>): Promise<void> {
    this.patch(() => ({ isHeld: true }));
    await this.ask(work);
    this.patch(() => ({ isHeld: false }));
  }

  // The offered behaviours may change while the form is open, so they are requested repeatedly.
  private async lookForOffers(): Promise<void> {
    clearTimeout(this.offersTimer);
    const asked = [this.api.behaviours(), this.api.ros2()] as const;
    const [behaviours, ros2] = await Promise.all([asked[0].catch(() => null), asked[1].catch(() => null)]);
    if (!this.store.get().setUp) return;
    const known = this.store.get().setUp!;
    if (behaviours && JSON.stringify(behaviours) !== JSON.stringify(known.behaviours)) this.patch(() => ({ behaviours }));
    if (ros2 && JSON.stringify(ros2) !== JSON.stringify(known.ros2)) this.patch(() => ({ ros2 }));
    this.offersTimer = setTimeout(() => void this.lookForOffers(), OFFERS_POLL_MS);
  }
}
