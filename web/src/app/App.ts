// The actions that panels, keyboard and pointer can request.
import type { Action, SimulationApi } from "../api/SimulationApi";
import { camerasOf } from "../api/scene";
import { poseOf } from "../scene/poses";
import type { World3D } from "../scene/World3D";
import { isAllowed, mainAction } from "../state/actions";
import type { CameraChoice } from "../api/scene";
import type { BodyPlace } from "../api/SetUpApi";
import type { Placed } from "../api/scenario";
import { findRobot } from "../api/scenario";
import type { Source } from "../state/plots";
import { ROBOT_VALUES, SIMULATION_VALUES, withCurve, withoutCurve } from "../state/plots";
import type { OverlayName } from "../state/overlays";
import { browserStorage } from "../state/overlays";
import type { RobotFilter } from "../state/robotList";
import type { WallDrawing } from "../state/editing";
import { allChosen, chosenOf } from "../state/editing";
import type { Shape } from "../state/shapes";
import { faultOf, footprintOf, modelOf, wallBetween } from "../state/shapes";
import type { BodyPose, Point, State, ViewMode } from "../state/State";
import { withChangedKey } from "../state/shortcuts";
import type { Store } from "../state/Store";
import { EDIT_PANEL } from "../state/editing";
import { PANELS } from "../panels/registry";
import { download, fileName } from "../ui/files";
import { VIEW } from "../state/layout";
import { EditControl } from "./EditControl";
import { Filming } from "./Filming";
import { LayoutControl } from "./LayoutControl";
import { LinkControl } from "./LinkControl";
import { CompareControl } from "./CompareControl";
import { NotesControl } from "./NotesControl";
import { dismiss, notify } from "./notices";
import { PastControl } from "./PastControl";
import { PanelControl } from "./PanelControl";
import { PeopleControl } from "./PeopleControl";
import { RecordControl } from "./RecordControl";
import { ReplayControl } from "./ReplayControl";
import type { Session } from "./Session";
import { SetUpControl } from "./SetUpControl";

const BEFORE_ROBOT_M = 0.6; // from a robot's middle to a shape that is put before it
const PLOTS_PANEL = "plots";
const IMAGES_PANEL = "images";
const TOPICS_PANEL = "topics";

export class App {
  readonly replay: ReplayControl;
  readonly past: PastControl;
  readonly notes: NotesControl;
  readonly compare: CompareControl;
  readonly link: LinkControl;
  readonly setUp: SetUpControl;
  readonly edits: EditControl;
  readonly records: RecordControl;
  readonly people: PeopleControl;
  readonly panels: PanelControl;
  readonly layouts: LayoutControl;
  private readonly filming: Filming;

  constructor(
    readonly store: Store<State>,
    readonly session: Session,
    private readonly api: SimulationApi,
    private readonly world: () => World3D | null, // null: the browser cannot draw in 3D, or not yet
  ) {
    this.replay = new ReplayControl(store, api, (action) => this.act(action));
    this.past = new PastControl(store, api, session, this.replay);
    this.notes = new NotesControl(store, api);
    this.compare = new CompareControl(store, api);
    const linked = {
      select: (robot: string) => this.select(robot),
      pause: () => this.act("pause"),
      seek: (time: number) => this.past.lookAt(time),
    };
    this.layouts = new LayoutControl(store, browserStorage(), new Set([VIEW, EDIT_PANEL, ...PANELS.map(({ id }) => id)]));
    this.link = new LinkControl(store, linked, world, this.layouts);
    this.setUp = new SetUpControl(store, session, api.setUp);
    this.edits = new EditControl(store, api.setUp, { placeOf: (body) => placeIn(world(), body) }, () =>
      this.act("pause"),
    );
    this.records = new RecordControl(store, api);
    this.people = new PeopleControl(store, session, api.viewers, browserStorage());
    this.panels = new PanelControl(store);
    this.filming = new Filming(store, () => world()?.video() ?? null);
  }

  // Sends one action. Its effects arrive with the stream, so the answer may come after later
  // events. If the server refuses, its sentence is shown.
  act(action: Action, count = 1): Promise<void> {
    return this.command(action, (simulation) => this.api.act(simulation, action, count));
  }

  // Sets the target real-time factor of a simulation in real time.
  setFactor(factor: number): Promise<void> {
    return this.command("factor", (simulation) => this.api.setFactor(simulation, factor));
  }

  private async command(name: State["pending"], send: (simulation: string) => Promise<unknown>): Promise<void> {
    const { simulation, pending } = this.store.get();
    if (!simulation || pending) return;
    this.store.set({ pending: name });
    try {
      await send(simulation);
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

  // Shows the selected robot's camera in the camera pane, if it has one.
  select(robot: string | null): void {
    this.edits.choose(null);
    this.store.set(({ selection, selectedPose, viewMode, scene, camera }) => ({
      selection: robot,
      selectedPose: robot === selection ? selectedPose : null,
      viewMode: robot === null ? "orbit" : viewMode,
      camera:
        camera?.robot === robot ? camera : (camerasOf(scene).find((each) => each.robot === robot) ?? camera),
    }));
  }

  // Handles a click on a body: selects a robot, or in edit mode an object. `isAdding`: adds the body to the
  // selection, or removes it if it is selected.
  pick(body: string | null, isAdding = false): void {
    const { scene, editing } = this.store.get();
    if (isAdding && editing && body !== null && chosenOf(this.store.get()) !== null) return this.addToChoice(body);
    const known = scene?.bodies.find(({ name }) => name === body);
    const isObject = known !== undefined && !known.isRobot && !known.isAvatar;
    if (!isObject) return this.select(body);
    if (!editing) return;
    this.select(null);
    this.edits.choose(known.name);
  }

  // Selects all of these bodies. Moves and turns refer to the first one.
  pickAll([first, ...more]: readonly string[]): void {
    if (first === undefined || !this.store.get().editing) return;
    this.pick(first);
    this.edits.chooseMore(more);
  }

  private addToChoice(body: string): void {
    const all = allChosen(this.store.get());
    const rest = all.filter((each) => each !== body);
    if (rest.length === all.length) this.edits.chooseMore([...all.slice(1), body]);
    else if (rest.length === 0) this.select(null);
    else this.pickAll(rest);
  }

  // Selects this view of the selected robot, or of the first one if none is selected. A second call
  // ends it.
  toggleViewMode(mode: ViewMode): void {
    const { selection, viewMode, status } = this.store.get();
    const robot = selection ?? status?.robots[0]?.name ?? null;
    if (robot && !selection) this.select(robot);
    this.store.set({ mapMode: false, viewMode: robot === null || viewMode === mode ? "orbit" : mode });
  }

  // Moves a body to the pose to which the user dragged it. Resolves to whether the body is there
  // now.
  place(body: string, place: Placed): Promise<boolean> {
    this.store.set({ placing: false });
    return this.store.get().setUp ? this.setUp.place(body, place) : this.edits.place(body, place);
  }

  // Sets the poses that the gizmo or typed numbers have given to bodies.
  pose(poses: readonly BodyPose[]): Promise<boolean> {
    const posed = poses.map(({ body, ...place }) => ({ body, place }));
    const [first] = posed;
    if (!this.store.get().setUp) return this.edits.pose(posed);
    return first ? this.setUp.place(first.body, first.place) : Promise.resolve(false);
  }

  // Whether the next click on the floor moves the selection there.
  setPlacing(placing: boolean): void {
    const { editing, setUp } = this.store.get();
    if (placing) this.endPointing();
    this.store.set({ placing: placing && (editing !== null || setUp !== null) && chosenOf(this.store.get()) !== null });
  }

  // Draws a wall from the next click on the floor to the one after it.
  drawWall(wall: Omit<WallDrawing, "from"> | null): void {
    this.endPointing();
    if (wall) this.edits.drawWall({ ...wall, from: null });
  }

  setMeasuring(isOn: boolean): void {
    this.endPointing();
    this.store.set({ ruler: isOn ? [] : null });
  }

  // Receives a clicked point of the world for the ruler or a wall.
  takePoint(point: Point): void {
    const { ruler, editing } = this.store.get();
    if (ruler) this.store.set({ ruler: ruler.length < 2 ? [...ruler, point] : [point] });
    const wall = editing?.wall;
    if (!wall) return;
    if (!wall.from) return this.edits.drawWall({ ...wall, from: { x: point.x, y: point.y } });
    const { shape, place } = wallBetween(wall.from, point, wall);
    this.edits.drawWall(null);
    if (faultOf(shape) !== "") return notify(this.store, "error", "The ends of a wall must be at least 1 mm apart.");
    void this.edits.addObject({ name: "", model: modelOf(shape), place }, "wall");
  }

  // Cancels the pending use of the next click. Returns false if there was none.
  endPointing(): boolean {
    const { placing, ruler, editing } = this.store.get();
    const wasOn = placing || ruler !== null || editing?.wall != null;
    if (!wasOn) return false;
    this.store.set({ placing: false, ruler: null });
    if (editing?.wall) this.edits.drawWall(null);
    return true;
  }

  // Escape: cancels the present operation, or else clears the selection.
  escape(): void {
    if (!this.endPointing()) this.select(null);
  }

  // Adds a shape in front of the selected robot if there is room, else at the first free place.
  async addShape(shape: Shape): Promise<boolean> {
    const { selection, editing } = this.store.get();
    const robot = editing?.chosen == null && selection !== null ? placeIn(this.world(), selection) : null;
    const ahead = BEFORE_ROBOT_M + footprintOf(shape);
    const place = robot && {
      x: robot.x + ahead * Math.cos(robot.yaw),
      y: robot.y + ahead * Math.sin(robot.yaw),
      yaw: robot.yaw,
    };
    return this.edits.addObject({ name: "", model: modelOf(shape), place }, shape.kind);
  }

  copyChosen(): void {
    const count = this.edits.copy(allChosen(this.store.get()));
    if (count > 0) notify(this.store, "note", count === 1 ? "1 body copied." : `${count} bodies copied.`);
  }

  paste(): void {
    void this.edits.paste();
  }

  duplicate(): void {
    if (this.edits.copy(allChosen(this.store.get())) > 0) void this.edits.paste();
  }

  // Downloads the present state of the world, and with `scenario` also a scenario file for it.
  async saveWorld(scenario: boolean): Promise<void> {
    const { simulation } = this.store.get();
    if (!simulation) return;
    const file = worldFileName(simulation);
    try {
      const saved = await this.api.setUp.saveWorld(simulation, file);
      download(file, new Blob([saved.sdf], { type: "application/xml" }));
      if (scenario) download(file.replace(/\.sdf$/, ".yaml"), new Blob([saved.scenario], { type: "application/yaml" }));
      for (const warning of saved.warnings) notify(this.store, "note", warning);
    } catch (error) {
      notify(this.store, "error", (error as Error).message);
    }
  }

  removeSelected(): void {
    const { setUp, selection, editing } = this.store.get();
    if (editing && editing.more.length > 0) return void this.edits.removeAll(allChosen(this.store.get()));
    if (editing?.chosen) return void this.edits.removeObject(editing.chosen);
    if (selection === null) return;
    const found = setUp && findRobot(setUp.scenario, selection);
    if (found) this.setUp.removeRobot(found.list, found.index);
    else if (!setUp) void this.edits.remove(selection);
  }

  // In edit mode: rotates counter-clockwise, in radians.
  turnSelected(angle: number): void {
    const body = chosenOf(this.store.get());
    if (this.store.get().editing && body !== null) void this.edits.turn(body, angle);
  }

  undo(): void {
    if (this.store.get().setUp) this.setUp.undo();
    else void this.edits.undo();
  }

  redo(): void {
    if (this.store.get().setUp) this.setUp.redo();
    else void this.edits.redo();
  }

  filterRobots(change: Partial<RobotFilter>): void {
    this.store.set(({ robotFilter }) => ({ robotFilter: { ...robotFilter, ...change } }));
  }

  toggle(overlay: OverlayName): void {
    this.store.set(({ shown }) => ({ shown: { ...shown, [overlay]: !shown[overlay] } }));
  }

  // Shows the view as a map: from above, north up.
  setMap(mapMode: boolean): void {
    this.store.set({ mapMode, ...(mapMode && { viewMode: "orbit" }) });
  }

  topView(): void {
    this.leaveEye();
    this.world()?.topView();
  }

  resetView(): void {
    this.store.set({ viewMode: "orbit" });
    this.world()?.resetView();
  }

  // The user can only rotate the view if it is not a robot's own view.
  private leaveEye(): void {
    if (this.store.get().viewMode === "eye") this.store.set({ viewMode: "orbit" });
  }

  orbit(): void {
    this.store.set({ viewMode: "orbit" });
  }

  showCamera(camera: CameraChoice): void {
    this.store.set({ camera });
    this.panels.open(IMAGES_PANEL);
  }

  // Plots a value against simulated time from now on.
  plot(source: Source, key: string, unit?: string): void {
    const known = [...ROBOT_VALUES, ...SIMULATION_VALUES].find((value) => value.key === key)?.unit ?? "";
    this.store.set(({ plots }) => ({ plots: withCurve(plots, source, key, unit ?? known) }));
    this.panels.open(PLOTS_PANEL);
  }

  unplot(curve: string): void {
    this.store.set(({ plots }) => ({ plots: withoutCurve(plots, curve) }));
  }

  async savePicture(): Promise<void> {
    const { simulation, time } = this.store.get();
    try {
      const picture = await this.world()?.picture();
      if (picture) download(fileName(simulation, time, "view", "png"), picture);
    } catch (error) {
      notify(this.store, "error", (error as Error).message);
    }
  }

  // Starts or stops a video of the view.
  film(): void {
    this.filming.toggle();
  }

  // Also shows the link in the address bar.
  copyLink(): void {
    const link = this.link.linkTo(location.href);
    history.replaceState(null, "", link);
    void this.copy(link, "Link copied.");
  }

  openPalette(paletteOpen: boolean): void {
    this.store.set({ paletteOpen });
  }

  // Shows the messages of a topic.
  showTopic(topic: string): void {
    this.store.set({ topic });
    this.panels.open(TOPICS_PANEL);
  }

  openHelp(open: boolean): void {
    this.store.set({ helpOpen: open });
  }

  useSingleKeys(singleKeys: boolean): void {
    this.store.set({ singleKeys });
  }

  // Assigns another single key to a command. `original` is the command's default key.
  changeKey(original: string, key: string): void {
    this.store.set(({ changedKeys }) => ({ changedKeys: withChangedKey(changedKeys, original, key) }));
  }

  // Copies to the clipboard and reports it. If the browser does not allow this, shows the text to
  // copy.
  async copy(text: string, done: string): Promise<void> {
    try {
      await navigator.clipboard.writeText(text);
      notify(this.store, "note", done);
    } catch {
      notify(this.store, "note", text);
    }
  }

  enterToken(token: string): void {
    this.api.admit(token);
    this.session.admit();
  }

  dismiss(notice: number): void {
    dismiss(this.store, notice);
  }
}

// The name of a simulation as a file name.
function worldFileName(simulation: string): string {
  return `${simulation.replace(/[^\p{L}\p{N}_.-]+/gu, "_").slice(0, 80)}.sdf`;
}

function placeIn(world: World3D | null, body: string): Required<BodyPlace> | null {
  const pose = world?.bodyPose(body);
  if (!pose) return null;
  return poseOf(pose);
}
