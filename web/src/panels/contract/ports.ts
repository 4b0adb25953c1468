// The interfaces by which a panel accesses the page.
//
// A panel's mount function names the ports that the panel uses. The panel uses no other part of the
// page. So tests or other pages can mount the panel with their own ports. app/panelPorts.ts
// implements the ports for the viewer.
import type { ServerFigures } from "../../api/MetricsApi";
import type { CommandArguments, CommandDescription } from "../../api/commands";
import type { CurveOf, WholeCurve } from "../../api/curve";
import type { BodyJoints, JointCommandKind } from "../../api/joints";
import type { Drive } from "../../api/SimulationApi";
import type { OutputLine } from "../../api/health";
import type { RecordedLine } from "../../api/replay";
import type { CameraChoice } from "../../api/scene";
import type { ParameterValue, TopicCount } from "../../protocol/FoxgloveClient";
import type { TopicSource } from "../../protocol/SharedTopics";
import type { VisualFacts } from "../../api/visuals";
import type { WorldPart } from "../../state/worldPart";
import type { Source } from "../../state/plots";
import type { RobotFilter } from "../../state/robotList";
import type { BodyPose, State } from "../../state/State";
import type { StateReader } from "../../state/Store";

// All ports. A panel names the ports that it uses.
export interface PanelPorts {
  state: StateReader<State>; // the page's state, read-only; the other ports change it
  // Topics of the simulation that is shown. If the page changes to another simulation, a
  // subscription continues with the other simulation.
  topics: TopicSource;
  traffic: TrafficPort;
  server: ServerPort;
  commands: CommandsPort;
  control: ControlPort;
  shapes: ShapesPort;
  replay: ReplayPort;
  robots: RobotsPort;
  edits: EditsPort;
  cameras: CamerasPort;
  plots: PlotsPort;
  notices: NoticesPort;
}

export interface TrafficPort {
  // The number of messages and bytes received on each topic that the page reads or has read.
  counts(): ReadonlyMap<string, TopicCount>;
  choose(topic: string | null): void; // selects the topic whose messages are shown
  open(topic: string): void; // shows the messages of a topic, and opens their panel
}

// Requests to the server for data that is not in the live stream. If the server refuses a request,
// its promise rejects with the server's sentence.
export interface ServerPort {
  // The metrics of /metrics (docs/monitoring.md).
  figures(): Promise<ServerFigures>;
  // The value of a parameter, such as /gsv/step_size_s, read over the live connection (Foxglove
  // WebSocket). Null if the server does not answer.
  parameter(name: string): Promise<ParameterValue | null>;
  // The lines of a recording's log.
  log(simulation: string): Promise<RecordedLine[]>;
  // The last output of a robot's behaviour.
  output(simulation: string, robot: string): Promise<OutputLine[]>;
  // One value over a whole recording, or over the part that is read so far, with at most `most`
  // samples.
  curve(simulation: string, of: CurveOf, most: number): Promise<WholeCurve>;
  // One value over the stored past of a running simulation.
  pastCurve(simulation: string, of: CurveOf, most: number): Promise<WholeCurve>;
  // One value over the recording with which the page compares; null if there is no comparison.
  comparedCurve(of: CurveOf, most: number): Promise<WholeCurve | null>;
}

// Commands to a simulation. If the server refuses a command, its promise rejects with the server's
// sentence.
export interface CommandsPort {
  list(simulation: string): Promise<CommandDescription[]>;
  run(simulation: string, command: string, given: CommandArguments): Promise<void>;
}

// Commands to bodies. If the server refuses a command, its promise rejects with the server's
// sentence.
export interface ControlPort {
  // Takes control of the simulation, or requests it from the viewer who has it.
  take(): Promise<void>;
  resume(): void; // starts or resumes the simulation
  // Sets the velocity of an avatar, or of a robot without a behaviour. The body stops 1 s of
  // wall-clock time after the last command.
  drive(simulation: string, robot: string, drive: Drive): Promise<void>;
  setDriven(robot: string | null): void; // sets the robot that this page drives by hand
  joints(simulation: string, body: string): Promise<BodyJoints>;
  showJoints(): void; // opens the panel of joints, which shows the joints of the selected body
  commandJoint(simulation: string, body: string, joint: string, kind: JointCommandKind, value: number): Promise<void>;
}

// The shapes of models. If a request fails, its promise rejects with an error sentence.
export interface ShapesPort {
  // The visuals of a model. `model` is the identifier `model` of a body in the scene. If `model` is
  // the body's identifier `collisions`, returns the collision shapes.
  visuals(model: string, links: readonly string[]): Promise<readonly VisualFacts[]>;
}

export interface ReplayPort {
  // Goes to an instant of the recording, in simulated seconds. Resolves when the page shows this
  // instant.
  seek(time: number): Promise<void>;
}

export interface RobotsPort {
  select(robot: string | null): void;
  inspect(part: WorldPart): void; // selects an object, link, joint or sensor
  // Has the effect of a click on the body: selects a robot or an object. If `isAdding` is true and
  // something is selected in edit mode, adds the body to the selection or removes it.
  pick(body: string, isAdding?: boolean): void;
  filter(change: Partial<RobotFilter>): void; // filters the list and the view
  follow(): void; // the view follows the selected robot; a second call ends this
}

export interface CamerasPort {
  show(camera: CameraChoice): void; // selects the camera, and opens the panel of images
  showAll(isOn: boolean): void; // shows all cameras in a grid, or only the selected camera, and opens the panel
}

export interface PlotsPort {
  // Plots a value against simulated time from now on, and opens the plots.
  add(source: Source, key: string, unit?: string): void;
  remove(curve: string): void;
  setSpan(seconds: number | null): void; // shows the newest seconds only; null for all
  setAgainst(curve: string | null): void; // sets the curve on the horizontal axis; null for simulated time
  showEvents(show: boolean): void;
}

export interface EditsPort {
  // In edit mode, moves a body to exactly this pose. Resolves to true if the server has moved it.
  pose(pose: BodyPose): Promise<boolean>;
}

export interface NoticesPort {
  notify(kind: "error" | "note", sentence: string): void;
  // Copies to the clipboard. `done` is the message after success.
  copy(text: string, done: string): Promise<void>;
}
