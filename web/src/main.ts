// Connects the parts of the page: the store, the session that fills it, the 3D view, and the
// panels.
import { credentials, graphics, parameters, requests } from "./early";
import { SimulationApi } from "./api/SimulationApi";
import { robotsOf } from "./api/scene";
import { App } from "./app/App";
import { panelPorts } from "./app/panelPorts";
import { OverlayFeed } from "./app/OverlayFeed";
import { SHORTEST_UPDATE_MS, SelectedPose } from "./app/SelectedPose";
import { Session } from "./app/Session";
import { notify } from "./app/notices";
import { AvatarSteering } from "./input/AvatarSteering";
import { listenForKeys } from "./input/Keyboard";
import { createHelpSheet } from "./page/HelpSheet";
import { createPalette } from "./page/Palette";
import { createHealthStrip } from "./page/HealthStrip";
import { createNotices } from "./page/Notices";
import { createOverlay } from "./page/Overlay";
import { createControlQuestion } from "./page/PeopleMenu";
import { createSceneTree } from "./panels/tree/SceneTree";
import { createStatusBar } from "./page/StatusBar";
import { createTimeline } from "./page/Timeline";
import { createToolbar } from "./page/Toolbar";
import { editPanel } from "./page/EditPanel";
import { createPanelBar } from "./page/PanelBar";
import { createViewTools } from "./page/ViewTools";
import { pageNames } from "./page/pageLinks";
import { PANELS } from "./panels/registry";
import type { PackedPosesMessage, PosesMessage } from "./protocol/messages";
import { PACKED_POSES, POSES, posesOf } from "./protocol/packedPoses";
import type { RobotStates } from "./scene/RobotSigns";
import { ModelLibrary } from "./scene/ModelLibrary";
import { World3D } from "./scene/World3D";
import { createSetUpPanel } from "./setup/SetUpPanel";
import { listedRobots } from "./state/listedRobots";
import { markedObject } from "./state/parts";
import { filtered, isFiltering } from "./state/robotList";
import { browserStorage, keepColours, keepShown, loadColours, loadShown } from "./state/overlays";
import { keepChangedKeys, keepSingleKeys, loadChangedKeys, loadSingleKeys } from "./state/shortcuts";
import { showKeys } from "./page/keyLabels";
import type { State } from "./state/State";
import { initialState } from "./state/State";
import { Store, shallowEqual } from "./state/Store";
import { exposeForTests } from "./testing";
import { element } from "./ui/element";
import { Workspace } from "./workspace/Workspace";
import { STANDARD } from "./workspace/presets";
import { linkedView } from "./state/link";
import { createMeasureBar, createScaleBar } from "./page/MeasureCard";
import { createDrawerSwitch } from "./page/DrawerSwitch";
import { connectTools, showChosenPose } from "./app/connectTools";
import { chosenDrawer, keepDrawer, startDrawing } from "./app/startDrawing";
import type { ViewChoice } from "./app/ViewChoice";

// The page's address may contain simulation=NAME (the simulation to join) and recording=NAME (the
// recording to replay). With quality=high, the view keeps its full resolution even if drawing is
// slow. With quality=best, it also has reflections, fitted shadows and ambient occlusion. With
// other values, these three are drawn only if the browser uses a graphics card.
const storage = browserStorage();
const store = new Store<State>({
  ...initialState,
  shown: loadShown(storage),
  overlayColours: loadColours(storage),
  singleKeys: loadSingleKeys(storage),
  changedKeys: loadChangedKeys(storage),
});
const api = new SimulationApi(document.baseURI, requests.fetch, credentials);

// The 3D view is added when the browser has started to draw.
let world: World3D | null = null;
let drawing: ViewChoice | null = null;
const library = new ModelLibrary(
  (id) => api.modelUrl(id),
  () => credentials.headers,
);

function createWorld(host: HTMLElement, inSoftware: boolean): World3D | null {
  const quality = parameters.get("quality");
  try {
    return new World3D(
      host,
      {
        library,
        inSoftware,
        fixedQuality: quality === "high" || quality === "best",
        hasFineLight: quality === "best" || !inSoftware,
      },
      {
        onPick: (body) => app.pick(body),
        onPlace: (body, place) => app.editActions.place(body, place),
        onAddToChoice: (body) => app.pick(body, true),
        onChoose: (bodies) => app.pickAll(bodies),
        onPoint: (point) => app.pointing.takePoint(point),
        onDrag: (chosenPose) => store.set({ chosenPose }),
        onPose: (poses) => app.editActions.pose(poses),
        onModelsMissing: (modelsMissing) => store.set({ modelsMissing }),
        onProblem: (sentence) => notify(store, "error", sentence),
        onFrameRate: (framesPerSecond) => {
          store.set({ framesPerSecond });
          drawing?.frameRate(framesPerSecond);
        },
        onScale: (metresPerPixel) => scaleBar.show(metresPerPixel),
        onGraphics: (isThere) => {
          if (store.get().drawnBy !== "server") store.set({ view: isThere ? "open" : "interrupted" });
          drawing?.graphics(isThere);
        },
      },
    );
  } catch (error) {
    console.warn(error);
    return null;
  }
}

const view = element("section", { class: "view", "aria-label": "3D view" });
const selected = new SelectedPose();
const session = new Session(
  api,
  store,
  { simulation: parameters.get("simulation"), recording: parameters.get("recording") },
);
const app = new App(store, session, api, () => world);
const ports = panelPorts(app, api, library);

const LONGEST_PAINTING_MS = 200;

let nextPose: ReturnType<typeof setTimeout> | undefined;

function showSelectedPose(): void {
  clearTimeout(nextPose);
  const { selection } = store.get();
  const latest = selection === null ? null : world?.latestPose(selection);
  if (selection === null || !latest) return;
  const pose = selected.update(selection, latest, performance.now());
  if (pose) store.set({ selectedPose: pose });
  // The last update is too recent. A timer shows the pose later, because no more poses may arrive:
  // for example, if the simulation is paused, or if the user moved a replay to this instant.
  else nextPose = setTimeout(showSelectedPose, SHORTEST_UPDATE_MS);
}

async function openWorld(): Promise<void> {
  const unwatch = store.watch(
    ({ scene }) => scene,
    (scene) => scene && library.prepare(scene),
  );
  const inSoftware = await graphics;
  await painted();
  unwatch();
  world = createWorld(view, inSoftware);
  if (!world) return store.set({ view: "none" });
  connectWorld(world);
  drawing = startDrawing(store, api, session, world, { inSoftware, chosen: chosenDrawer(storage, parameters) });
}

// Resolves when the browser has drawn the present page. So the list of robots is drawn before the
// 3D view starts. A page in the background is not drawn, so the wait has a limit.
function painted(): Promise<void> {
  return new Promise((resolve) => {
    setTimeout(resolve, LONGEST_PAINTING_MS);
    requestAnimationFrame(() => setTimeout(resolve));
  });
}

function connectWorld(world: World3D): void {
  const takePoses = (message: PosesMessage | PackedPosesMessage) => {
    world.setPoses(posesOf(message));
    showSelectedPose();
    showChosenPose(store, world);
  };
  let endPoses = () => {};
  store.watch(
    ({ editing }) => editing !== null,
    (isEditing) => {
      endPoses();
      // Editing needs exact poses and not the rounded ones, because undo restores poses exactly.
      endPoses = isEditing
        ? session.subscribe<PosesMessage>(POSES, takePoses)
        : session.subscribe<PosesMessage | PackedPosesMessage>(PACKED_POSES, takePoses, { orElse: POSES });
    },
  );
  store.watch(
    ({ scene }) => scene,
    (scene) => {
      world.setScene(scene);
      showSelectedPose(); // the poses may have arrived before the scene
      showChosenPose(store, world);
    },
  );
  store.watch(
    ({ shown }) => shown,
    (shown) => world.show(shown),
  );
  store.watch(
    ({ overlayColours }) => overlayColours,
    (colours) => world.setOverlayColours(colours),
  );
  store.watch(
    ({ selection }) => selection,
    (selection) => {
      world.select(selection);
      showSelectedPose();
    },
  );
  store.watch(
    markedObject,
    (object) => world.choose(object),
  );
  connectTools(store, world);
  store.watch(
    ({ viewMode }) => viewMode,
    (mode) => world.setViewMode(mode),
  );
  store.watch(
    ({ setUp }) => setUp?.poses ?? null,
    (poses) => poses && world.setPoses(posesOfPreview(poses, store.get().scene?.layoutVersion ?? 0)),
  );
  store.watch(
    ({ setUp, editing }) => `${setUp !== null || editing !== null} ${editing === null}`,
    () => {
      const { setUp, editing } = store.get();
      world.setArranging(setUp !== null || editing !== null, editing === null);
    },
  );
  store.watch(
    ({ health, robotFilter, status, scene }) => ({
      health,
      robotFilter,
      scene,
      // The robots' status matters in two cases. Without a health report, the states of robots
      // follow from the states of their behaviours. With a filter, the robots that match are shown.
      robots: health === null || isFiltering(robotFilter) ? status?.robots : null,
    }),
    () => world.setStates(shownStates(store.get())),
    shallowEqual,
  );
  store.watch(
    ({ expectations }) => expectations,
    (expectations) => world.setExpectations(expectations),
  );
  store.watch(
    ({ comparison }) => comparison?.scene ?? null,
    (scene) => {
      const models = new ModelLibrary((id) => app.compare.modelUrl(id), () => credentials.headers);
      world.setGhosts(scene, models);
    },
  );
  app.compare.onPoses = ({ layoutVersion, poses }) => world.setGhostPoses(layoutVersion, poses);
  new OverlayFeed(store, session, world).start();
}

function shownStates(state: State): RobotStates {
  const { health, robotFilter } = state;
  if (health === null && !isFiltering(robotFilter)) return { states: null, chosen: null };
  const robots = listedRobots(state);
  return {
    states: health && new Map(robots.map(({ status, state: its }) => [status.name, its])),
    chosen: isFiltering(robotFilter) ? new Set(filtered(robots, robotFilter).map(({ status }) => status.name)) : null,
  };
}

function posesOfPreview(poses: Float64Array, layoutVersion: number): PosesMessage {
  return { stamp: { sec: 0, nsec: 0 }, step: 0n, layout_version: layoutVersion, poses };
}

// Returns the selected avatar. If no avatar is selected, returns the first one. A recorded avatar
// cannot be driven.
function avatarToDrive(): string | null {
  const { scene, selection, replay } = store.get();
  if (replay) return null;
  const avatars = robotsOf(scene).filter(({ isAvatar }) => isAvatar);
  return (avatars.find(({ name }) => name === selection) ?? avatars[0])?.name ?? null;
}

async function drive(avatar: string, wish: Parameters<SimulationApi["drive"]>[2]): Promise<void> {
  const { simulation } = store.get();
  if (!simulation) return;
  await api.drive(simulation, avatar, wish).catch((error: Error) => notify(store, "error", error.message));
}

const page = document.getElementById("app")!;
const statusBar = createStatusBar(app);
app.askServerAgain = () => drawing?.askServerAgain();
app.drawBy = (drawer) => {
  drawing?.choose(drawer);
  keepDrawer(storage, drawer);
};
statusBar.append(createDrawerSwitch(store, app));
const toggleSidebar = () => page.classList.toggle("sidebar-open");
const scaleBar = createScaleBar(app);
view.append(scaleBar.element, createOverlay(app), createControlQuestion(app), createNotices(app));
const workspace = new Workspace(
  { body: element("div", { class: "view-part" }, view, createMeasureBar(app)), tools: createViewTools(app) },
  { panels: [...PANELS, editPanel(app)], ports, setOpen: (openPanels) => store.set({ openPanels }) },
  (space) => STANDARD.layout(space),
);
const sceneTree = createSceneTree(ports, pageNames(app));
// On a narrow screen, the list covers the view. So it closes when the user selects a robot or
// presses something outside of the list.
sceneTree.addEventListener("click", ({ target }) => {
  if (target instanceof Element && target.closest("[data-robot], [data-object]")) page.classList.remove("sidebar-open");
});
page.addEventListener("pointerdown", ({ target }) => {
  if (target instanceof Element && !target.closest(".sidebar, .sidebar-toggle")) page.classList.remove("sidebar-open");
});
page.append(
  createToolbar(app, toggleSidebar),
  createHealthStrip(app),
  sceneTree,
  createSetUpPanel(app),
  workspace.element,
  createPanelBar(app, PANELS),
  createTimeline(app),
  statusBar,
  createHelpSheet(app),
  createPalette(app),
);
app.panels.host = workspace;
app.layouts.start(workspace, linkedView(location.hash).layout);
workspace.onChange = (layout) => app.layouts.changed(layout);
store.watch(
  ({ simulation }) => simulation,
  (simulation) => (document.title = simulation ? `${simulation} · GSV` : "GSV"),
);
store.watch(
  ({ setUp }) => setUp !== null,
  (isOpen) => page.classList.toggle("setting-up", isOpen),
);
store.watch(
  ({ shown }) => shown,
  (shown) => keepShown(storage, shown),
);
store.watch(
  ({ overlayColours }) => overlayColours,
  (colours) => keepColours(storage, colours),
);
store.watch(
  ({ singleKeys }) => singleKeys,
  (isOn) => {
    page.classList.toggle("no-single-keys", !isOn);
    keepSingleKeys(storage, isOn);
  },
);
store.watch(
  ({ changedKeys }) => changedKeys,
  (changed) => {
    showKeys(page, changed);
    keepChangedKeys(storage, changed);
  },
);
listenForKeys(app);
new AvatarSteering(avatarToDrive, drive, () => store.get().singleKeys).listen(window);
exposeForTests(store, () => world, () => session.readTopics);
app.records.start();
app.past.start();
app.notes.start();
app.compare.start();
app.link.start(window);
// The viewers of a replay that a page has opened for itself are not listed, because nobody else can
// see this replay.
if (!parameters.has("recording")) app.people.start(window);
session.start();
void openWorld();
