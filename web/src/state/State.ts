// The state of the page: what it knows and shows. Only Session, the commands of App and the panels'
// own controls change it.
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
import type { Plots } from "./plots";
import { NO_PLOTS } from "./plots";

export interface Notice {
  id: number;
  kind: "error" | "note";
  sentence: string;
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

// Whether the browser draws in 3D.
export type View = "starting" | "open" | "interrupted" | "none"; // interrupted: the browser took WebGL away

// The program that draws the view.
export type Drawer = "browser" | "server";

// The camera mode: free, following the selected robot, behind it and rotating with it, or the
// robot's own view.
export type ViewMode = "orbit" | "follow" | "chase" | "eye";

export interface State {
  connection: ConnectionState;
  abilities: Abilities; // of the server
  missing: string; // why what the address asks for cannot be shown; empty: it can
  refusal: string; // why the server lets this page do nothing, as it takes a token; empty: it does
  people: People; // who else is watching, and who holds control
  editing: Editing | null; // null: what stands in the simulation is not being changed
  recording: Recording | null; // of the simulation; null: it cannot be recorded, or not known yet
  stopRecordingAsked: boolean; // whether the viewer is asked if it is to end
  endSeen: boolean; // whether the viewer has closed the summary of a run that ended
  setUp: SetUp | null; // null: no simulation is being put together
  // null: not known yet.
  simulations: SimulationSummary[] | null;
  simulation: string | null;
  status: SimulationStatus | null;
  time: number; // s, simulated
  replay: Replay | null; // null: it is no recording, or not known yet
  kept: Kept | null; // of the running simulation's past; null: nothing, or not known yet
  inPast: boolean; // what is replayed is the past of a simulation that runs
  events: RecordedEvent[]; // of the recording or the run, by time
  notes: readonly RecordingNote[]; // of the recording, by time
  comparison: Comparison | null; // null: nothing is laid over the recording
  wishedTime: number | null; // s: the instant of the recording that was asked for and is not there yet
  view: View;
  drawnBy: Drawer | null; // null: the view has not started
  scene: SceneDescription | null;
  modelsMissing: number; // shapes that are still being fetched
  health: Health | null; // null: the server does not report it
  expectations: readonly Expectation[]; // of the scenario
  robotFilter: RobotFilter;
  selection: string | null; // a robot's name
  selectedPose: RobotPose | null;
  chosenPose: BodyPose | null; // of what is edited, as it is drawn
  placing: boolean; // whether the next click on the floor puts the selection there
  ruler: readonly Point[] | null; // the points that are measured, at most two; null: nothing is measured
  mapMode: boolean; // whether the view is a map: from above, north up
  viewMode: ViewMode;
  shown: Shown;
  overlayColours: OverlayColours;
  camera: CameraChoice | null;
  plots: Plots;
  openPanels: readonly string[]; // by id, as panels/registry.ts has them
  serverWarnings: readonly string[];
  layouts: readonly SavedLayout[]; // in this browser
  topics: readonly TopicInfo[]; // that the server offers, by name
  topic: string | null; // whose messages are shown
  pending: Action | "factor" | null; // sent to the server, not answered yet
  notices: Notice[];
  helpOpen: boolean;
  paletteOpen: boolean;
  singleKeys: boolean; // whether single keys are commands
  changedKeys: ChangedKeys; // those that are not as the page comes with them
  filming: boolean;
  framesPerSecond: number;
}

export const initialState: State = {
  connection: { phase: "connecting", attempt: 1 },
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
  kept: null,
  inPast: false,
  events: [],
  notes: [],
  comparison: null,
  wishedTime: null,
  view: "starting",
  drawnBy: null,
  scene: null,
  modelsMissing: 0,
  health: null,
  expectations: [],
  robotFilter: NO_FILTER,
  selection: null,
  selectedPose: null,
  chosenPose: null,
  placing: false,
  ruler: null,
  mapMode: false,
  viewMode: "orbit",
  shown: FIRST_SHOWN,
  overlayColours: FIRST_COLOURS,
  camera: null,
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
