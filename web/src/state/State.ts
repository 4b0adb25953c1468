// What the page knows and shows. Only Session, the commands of App and the panels' own controls
// change it.
import type { Action } from "../api/SimulationApi";
import type { RecordedEvent, Replay } from "../api/replay";
import type { CameraChoice, SceneDescription } from "../api/scene";
import type { SimulationStatus, SimulationSummary } from "../api/status";
import type { ConnectionState } from "../protocol/FoxgloveClient";

export interface Notice {
  id: number;
  kind: "error" | "note";
  sentence: string;
}

// Where a robot is, as last reported: metres and radians in the world.
export interface RobotPose {
  x: number;
  y: number;
  z: number;
  yaw: number;
  speed: number; // m/s
}

export interface State {
  connection: ConnectionState;
  // null: not known yet.
  simulations: SimulationSummary[] | null;
  simulation: string | null;
  status: SimulationStatus | null;
  time: number; // s, simulated
  replay: Replay | null; // null: it is no recording, or not known yet
  events: RecordedEvent[]; // of the recording, by time
  wishedTime: number | null; // s: the instant of the recording that was asked for and is not there yet
  scene: SceneDescription | null;
  modelsMissing: number; // shapes that are still being fetched
  selection: string | null; // a robot's name
  selectedPose: RobotPose | null;
  following: boolean;
  shown: { beams: boolean; labels: boolean; grid: boolean };
  camera: CameraChoice | null;
  pending: Action | null; // sent to the server, not answered yet
  notices: Notice[];
  helpOpen: boolean;
  framesPerSecond: number;
}

export const initialState: State = {
  connection: { phase: "connecting", attempt: 1 },
  simulations: null,
  simulation: null,
  status: null,
  time: 0,
  replay: null,
  events: [],
  wishedTime: null,
  scene: null,
  modelsMissing: 0,
  selection: null,
  selectedPose: null,
  following: false,
  shown: { beams: true, labels: true, grid: true },
  camera: null,
  pending: null,
  notices: [],
  helpOpen: false,
  framesPerSecond: 0,
};
