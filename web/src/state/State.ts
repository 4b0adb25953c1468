// The state of the page: its data and what it shows. Only Session, the commands of App and the
// panels' own controls change it.
import type { Action } from "../api/SimulationApi";
import type { Recording } from "../api/recording";
import type { Kept, RecordingNote } from "../api/history";
import type { RecordedEvent, Replay } from "../api/replay";
import type { CameraChoice, SceneDescription } from "../api/scene";
import type { Abilities } from "../api/SetUpApi";
import type { SimulationStatus, SimulationSummary } from "../api/status";
import type { ConnectionState, TopicInfo } from "../protocol/FoxgloveClient";
import type { People } from "../api/ViewersApi";
import type { Comparison } from "./comparison";
import type { Editing } from "./editing";
import type { Expectation } from "./expectations";
import type { Health } from "./health";
import { NO_PEOPLE } from "./people";
import type { OverlayColours, Shown } from "./overlays";
import { FIRST_COLOURS, FIRST_SHOWN } from "./overlays";
import type { RobotFilter } from "./robotList";
import { NO_FILTER } from "./robotList";
import type { SavedLayout } from "./layouts";
import type { SetUp } from "./setUp";
import type { ChangedKeys } from "./shortcuts";
import type { WorldPart } from "./worldPart";
import type { Plots } from "./plots";
import { NO_PLOTS } from "./plots";

// A short message at the edge of the page.
export interface Notice {
  id: number;
  kind: "error" | "note";
  sentence: string;
  action?: NoticeAction;
}

// A button of a notice.
export interface NoticeAction {
  label: string;
  run(): void;
}

// The last reported pose of a robot: metres and radians in the world.
export interface RobotPose {
  x: number;
  y: number;
  z: number;
  roll: number;
  pitch: number;
  yaw: number;
  speed: number; // m/s
  turnRate: number; // rad/s about the world's z
}

export interface Point {
  x: number;
  y: number;
  z: number;
}

// The pose of a body: metres and radians in the world.
export interface BodyPose extends Point {
  body: string;
  roll: number;
  pitch: number;
  yaw: number;
}

// Whether the browser draws in 3D. "interrupted" means that the browser has stopped WebGL. The
// browser may start WebGL again.
export type View = "starting" | "open" | "interrupted" | "none";

// The program that draws the view.
export type Drawer = "browser" | "server";

// The camera mode: free, following the selected robot, behind this robot and rotating with it, or
// the robot's own view.
export type ViewMode = "orbit" | "follow" | "chase" | "eye";

// The whole state of the page.
export interface State {
  connection: ConnectionState;
  // A present problem of the connection, for example that it is slow; empty if there is none.
  connectionProblem: string;
  abilities: Abilities; // the capabilities of the server
  missing: string; // why the content of the page's address cannot be shown; empty if it can be shown
  refusal: string; // why the server rejects this page's token; empty if it accepts the token
  people: People; // all viewers, and who has control
  editing: Editing | null; // null while this page does not edit the simulation
  // recording of the simulation; null if it cannot be recorded, or if this is unknown
  recording: Recording | null;
  stopRecordingAsked: boolean; // whether the page asks the user to confirm the end of the recording
  endSeen: boolean; // whether the user has closed the summary of an ended run
  setUp: SetUp | null; // null while no simulation is being set up
  // null if unknown
  simulations: SimulationSummary[] | null;
  simulation: string | null;
  status: SimulationStatus | null;
  time: number; // s, simulated
  replay: Replay | null; // null if this is not a replay, or if this is unknown
  isLive: boolean; // whether the server has reported that this is not a replay
  // the stored past of the running simulation; null if there is none, or if this is unknown
  kept: Kept | null;
  inPast: boolean; // whether the page replays the past of a running simulation
  events: RecordedEvent[]; // events of the recording or the run, ordered by time
  notes: readonly RecordingNote[]; // notes of the recording, ordered by time
  comparison: Comparison | null; // null while no recording is compared
  // s: the instant that the user has requested; null when the replay shows this instant
  wishedTime: number | null;
  view: View;
  whyNoView: string; // why the server draws no view, if the browser cannot draw either; else empty
  drawnBy: Drawer | null; // null before the view has started
  whyNotBrowser: string; // why the browser cannot draw at present; empty if it can
  scene: SceneDescription | null;
  modelsMissing: number; // number of shapes that are being fetched
  health: Health | null; // null if the server does not report it
  expectations: readonly Expectation[]; // expectations of the scenario
  robotFilter: RobotFilter;
  selection: string | null; // name of the selected robot
  driven: string | null; // name of the robot that this page drives
  selectedPose: RobotPose | null;
  chosenPose: BodyPose | null; // pose of the edited body as it is drawn
  part: WorldPart | null; // the selected object, link, joint or sensor, for the inspector
  placing: boolean; // whether the next click on the floor moves the selection there
  ruler: readonly Point[] | null; // the measured points, at most two; null if nothing is measured
  mapMode: boolean; // whether the view is a map: from above, north up
  viewMode: ViewMode;
  shown: Shown;
  overlayColours: OverlayColours;
  camera: CameraChoice | null;
  allCameras: boolean; // whether the images of all cameras are shown in a grid
  plots: Plots;
  openPanels: readonly string[]; // ids of panels in panels/registry.ts
  serverWarnings: readonly string[];
  layouts: readonly SavedLayout[]; // layouts that this browser stores
  topics: readonly TopicInfo[]; // topics that the server offers, ordered by name
  topic: string | null; // the topic whose messages are shown
  pending: Action | "factor" | null; // an action that the server has not answered yet
  notices: Notice[];
  helpOpen: boolean;
  paletteOpen: boolean;
  singleKeys: boolean; // whether a single key is a command
  changedKeys: ChangedKeys; // keys that differ from the default keys
  filming: boolean;
  framesPerSecond: number;
}

export const initialState: State = {
  connection: { phase: "connecting", attempt: 1 },
  connectionProblem: "",
  abilities: { creates: false, records: false, recordings: false, recording: "" },
  missing: "",
  refusal: "",
  people: NO_PEOPLE,
  editing: null,
  recording: null,
  stopRecordingAsked: false,
  endSeen: false,
  setUp: null,
  simulations: null,
  simulation: null,
  status: null,
  time: 0,
  replay: null,
  isLive: false,
  kept: null,
  inPast: false,
  events: [],
  notes: [],
  comparison: null,
  wishedTime: null,
  view: "starting",
  whyNoView: "",
  drawnBy: null,
  whyNotBrowser: "",
  scene: null,
  modelsMissing: 0,
  health: null,
  expectations: [],
  robotFilter: NO_FILTER,
  selection: null,
  driven: null,
  selectedPose: null,
  chosenPose: null,
  part: null,
  placing: false,
  ruler: null,
  mapMode: false,
  viewMode: "orbit",
  shown: FIRST_SHOWN,
  overlayColours: FIRST_COLOURS,
  camera: null,
  allCameras: false,
  plots: NO_PLOTS,
  openPanels: [],
  serverWarnings: [],
  layouts: [],
  topics: [],
  topic: null,
  pending: null,
  notices: [],
  helpOpen: false,
  paletteOpen: false,
  singleKeys: true,
  changedKeys: {},
  filming: false,
  framesPerSecond: 0,
};
