// The actions that panels, keyboard and pointer can request.
import type { Action, SimulationApi } from "../api/SimulationApi";
import { camerasOf, hasAgent } from "../api/scene";
import { poseOf } from "../scene/poses";
import type { World3D } from "../scene/World3D";
import { isAllowed, mainAction } from "../state/actions";
import type { CameraChoice } from "../api/scene";
import type { BodyPlace } from "../api/SetUpApi";
import type { WorldPart } from "../state/worldPart";
import { bodyPart } from "../state/parts";
import type { Source } from "../state/plots";
import { ROBOT_VALUES, SIMULATION_VALUES, withCurve, withoutCurve } from "../state/plots";
import type { OverlayColours, OverlayName } from "../state/overlays";
import { browserStorage } from "../state/overlays";
import type { RobotFilter } from "../state/robotList";
import { allChosen, chosenOf } from "../state/editing";
import type { Drawer, State, ViewMode } from "../state/State";
import { withChangedKey } from "../state/shortcuts";
import type { Store } from "../state/Store";
import { EDIT_PANEL } from "../state/editing";
import { PANELS } from "../panels/registry";
import { download, fileName } from "../ui/files";
import { VIEW } from "../state/layout";
import { EditActions } from "./EditActions";
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
import { PointingControl } from "./PointingControl";
import { RecordControl } from "./RecordControl";
import { ReplayControl } from "./ReplayControl";
import type { Session } from "./Session";
import { SetUpControl } from "./SetUpControl";

const PLOTS_PANEL = "plots";
const IMAGES_PANEL = "images";
const TOPICS_PANEL = "topics";
const INSPECTOR_PANEL = "inspector";

// The menus that commands of the command palette open.
export type MenuName = "pace" | "layout" | "viewers" | "notes" | "compare" | "time" | "shape" | "model";

export class App {
  readonly replay: ReplayControl;
  readonly past: PastControl;
  readonly notes: NotesControl;
  readonly compare: CompareControl;
  readonly link: LinkControl;
  readonly setUp: SetUpControl;
  readonly edits: EditControl;
  readonly editActions: EditActions;
  readonly pointing: PointingControl;
  readonly records: RecordControl;
  readonly people: PeopleControl;
  readonly panels: PanelControl;
  readonly layouts: LayoutControl;
  // Functions that open the menus of the page and focus their first field.
  readonly menus = new Map<MenuName, () => void>();
  drawBy: (drawer: Drawer) => void = () => {}; // chooses whether browser or server draws the view
  askServerAgain: () => void = () => {}; // requests the server's images after the server has refused
  private readonly filming: Filming;

  constructor(
    readonly store: Store<State>,
    readonly session: Session,
    private readonly api: SimulationApi,
    // null until the browser draws in 3D; always null if it cannot draw in 3D
    private readonly world: () => World3D | null,
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
    this.edits = new EditControl(
      ...[store, api.setUp, { placeOf: (body: string) => placeIn(world(), body) }] as const,
      () => this.act("pause"),
      () => void this.act("resume"),
    );
    this.pointing = new PointingControl(store, this.edits);
    this.editActions = new EditActions(
      ...[store, api.setUp, this.edits, this.setUp] as const,
      (body) => placeIn(world(), body),
      () => world()?.lookedAt ?? null,
    );
    this.records = new RecordControl(store, api);
    this.people = new PeopleControl(store, session, api.viewers, browserStorage());
    this.panels = new PanelControl(store);
    this.filming = new Filming(store, () => world()?.video() ?? null);
  }

  // Sends one action. The live stream reports the effects of the action, so the answer may arrive
  // after later events. If the server refuses the action, its error message is
  // shown.
  act(action: Action, count = 1): Promise<void> {
    return this.command(action, (simulation) => this.api.act(simulation, action, count));
  }

  // Sets the target real-time factor of a simulation in real-time mode.
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
      part: null,
      selectedPose: robot === selection ? selectedPose : null,
      viewMode: robot === null ? "orbit" : viewMode,
      camera:
        camera?.robot === robot ? camera : (camerasOf(scene).find((each) => each.robot === robot) ?? camera),
    }));
  }

  // Handles a click on a body: selects a robot, or in edit mode an object. If `isAdding` is true,
  // the body is added to the selection. If it is already selected, it is removed from the
  // selection.
  pick(body: string | null, isAdding = false): void {
    const { scene, editing } = this.store.get();
    if (isAdding && editing && body !== null && chosenOf(this.store.get()) !== null) return this.addToChoice(body);
    const known = scene?.bodies.find(({ name }) => name === body);
    const isObject = known !== undefined && !known.isRobot && !known.isAvatar;
    if (!isObject) return this.select(body);
    if (!editing) return this.store.get().setUp ? undefined : this.inspect(bodyPart(known.name));
    this.select(null);
    this.edits.choose(known.name);
  }

  // Selects an object, or a link, joint or sensor of any body, for the inspector. Its robot, avatar
  // or station is selected too.
  inspect(part: WorldPart): void {
    const { scene, editing } = this.store.get();
    const body = scene?.bodies.find(({ name }) => name === part.body);
    if (!body) return;
    if (hasAgent(body)) this.select(body.name);
    else this.select(null);
    if (editing && !body.isRobot && !body.isAvatar) this.edits.choose(body.name);
    this.store.set({ part: part.kind === "body" && hasAgent(body) ? null : part });
  }

  // Selects all of these bodies. The first body determines the reference for moving and rotating.
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

  // Selects this camera mode for the selected robot, or for the first robot if no robot is
  // selected. A second call ends the mode.
  toggleViewMode(mode: ViewMode): void {
    const { selection, viewMode, status } = this.store.get();
    const robot = selection ?? status?.robots[0]?.name ?? null;
    if (robot && !selection) this.select(robot);
    this.store.set({ mapMode: false, viewMode: robot === null || viewMode === mode ? "orbit" : mode });
  }

  // Handles Escape: cancels the present operation. If there is none, clears the selection.
  escape(): void {
    if (!this.pointing.end() && !this.panels.host?.restoreSize()) this.select(null);
  }

  filterRobots(change: Partial<RobotFilter>): void {
    this.store.set(({ robotFilter }) => ({ robotFilter: { ...robotFilter, ...change } }));
  }

  toggle(overlay: OverlayName): void {
    this.store.set(({ shown }) => ({ shown: { ...shown, [overlay]: !shown[overlay] } }));
  }

  colourOverlays(change: Partial<OverlayColours>): void {
    this.store.set(({ overlayColours }) => ({ overlayColours: { ...overlayColours, ...change } }));
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

  // A view from a robot's own camera cannot be rotated, so the camera mode "eye" is ended first.
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

  // Opens the panel of joints, which shows the joints of the selected body.
  showJoints(): void {
    this.panels.open("joints");
  }

  // The images of all cameras together need much space. So if the panel of images is small, it is
  // maximised while it shows all cameras.
  showAllCameras(allCameras: boolean): void {
    this.store.set({ allCameras });
    this.panels.open(IMAGES_PANEL);
    if (allCameras) this.panels.host?.enlarge(IMAGES_PANEL);
    else this.panels.host?.restoreSize();
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

  // Copies a link to the clipboard, and also shows it in the address bar.
  copyLink(): void {
    const link = this.link.linkTo(location.href);
    history.replaceState(null, "", link);
    void this.copy(link, "Link copied.");
  }

  // Opens a menu, as if the user had pressed its button.
  openMenu(name: MenuName): void {
    this.menus.get(name)?.();
  }

  openPalette(paletteOpen: boolean): void {
    this.store.set({ paletteOpen });
  }

  // Shows the messages of a topic.
  showTopic(topic: string): void {
    this.store.set({ topic });
    this.panels.open(TOPICS_PANEL);
  }

  // Shows a part of the world in the inspector.
  showPart(part: WorldPart): void {
    this.inspect(part);
    this.panels.open(INSPECTOR_PANEL);
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

  // Copies to the clipboard and reports this. If the browser does not allow copying, shows the
  // text, so that the user can copy it.
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

function placeIn(world: World3D | null, body: string): Required<BodyPlace> | null {
  const pose = world?.bodyPose(body);
  if (!pose) return null;
  return poseOf(pose);
}
