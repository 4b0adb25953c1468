// The requests about a simulation.
import { ApiError, JsonServer, simulationPath } from "./JsonServer";
import { SetUpApi } from "./SetUpApi";
import { Credentials } from "./credentials";
import { MetricsApi } from "./MetricsApi";
import { ViewersApi } from "./ViewersApi";
import type { CommandArguments, CommandDescription } from "./commands";
import { parseCommands } from "./commands";
import type { CurveOf, WholeCurve } from "./curve";
import { curveQuery, parseCurve } from "./curve";
import type { OutputLine } from "./health";
import { parseOutput } from "./health";
import type { BodyJoints, JointCommandKind } from "./joints";
import { parseJoints } from "./joints";
import type { Difference, Kept, RecordingNote } from "./history";
import { parseDifference, parseKept, parseNotes } from "./history";
import type { Recording } from "./recording";
import { parseRecording } from "./recording";
import type { RecordedEvent, RecordedLine, Replay } from "./replay";
import { parseEvents, parseLog, parseReplay } from "./replay";
import type { SceneDescription } from "./scene";
import { parseScene } from "./scene";
import type { SimulationStatus, SimulationSummary } from "./status";
import { parseStatus, parseSummaries } from "./status";
import { objectAt, textAt } from "./json";

export { ApiError };

export type Action = "start" | "pause" | "resume" | "stop" | "reset" | "step";

// The commanded velocity of a base.
export interface Drive {
  linear_m_s: number;
  lateral_m_s: number;
  angular_rad_s: number;
}

// The time limit is long, because stopping and resetting wait for the behaviours.
const ACTION_TIMEOUT_MS = 60_000;
// A robot stops this number of wall-clock seconds after its last drive command. The page repeats a
// command several times in this period.
const DRIVE_TIMEOUT_S = 1;
// The time limit is long, because the server reads both recordings from beginning to end.
const DIFFERENCE_TIMEOUT_MS = 120_000;

export class SimulationApi {
  readonly setUp: SetUpApi;
  private readonly server: JsonServer;
  // Sends requests to the server itself, also while `server` sends its requests to a replay.
  private readonly root: JsonServer;

  readonly viewers: ViewersApi;
  readonly metrics: MetricsApi;

  constructor(
    private readonly base: string,
    private readonly fetchPage?: typeof fetch,
    private readonly credentials = new Credentials(),
  ) {
    this.server = new JsonServer(base, fetchPage);
    this.root = new JsonServer(base, fetchPage);
    this.setUp = new SetUpApi(this.server);
    this.metrics = new MetricsApi(base, fetchPage ?? ((input, init) => fetch(input, init)));
    this.viewers = new ViewersApi(new JsonServer(base, fetchPage), credentials);
  }

  // Opens a recording as a replay for this page only. All further requests of `server` go to this
  // replay.
  async openRecording(recording: string): Promise<void> {
    this.server.moveTo("");
    const path = `api/recordings/${encodeURIComponent(recording)}/replay`;
    const answer = objectAt(await this.server.post(path, {}, ACTION_TIMEOUT_MS), "replay");
    this.server.moveTo(textAt(answer.base, "replay.base"));
  }

  // Returns an API of the same server, for a second replay beside this page's replay.
  another(): SimulationApi {
    return new SimulationApi(this.base, this.fetchPage, this.credentials);
  }

  get rootServer(): JsonServer {
    return this.root;
  }

  // The server stores the last part of a running simulation's past. Returns the time range of this
  // part; null if the server stores nothing.
  async kept(name: string): Promise<Kept | null> {
    try {
      return parseKept(await this.root.get(`${simulationPath(name)}/history`));
    } catch (error) {
      if (error instanceof ApiError && error.httpStatus === 404) return null;
      throw error;
    }
  }

  // Opens the stored past as a replay for this page only, and returns its playback state. All
  // further requests of `server` go to this replay, until leavePast(). Requests made before the
  // playback state has arrived still go to the running simulation.
  async openPast(name: string): Promise<Replay> {
    const answer = objectAt(await this.root.post(`${simulationPath(name)}/history`, {}), "history");
    const base = textAt(answer.base, "history.base");
    const replay = parseReplay(await this.root.get(`${base}${simulationPath(name)}/replay`));
    this.server.moveTo(base);
    return replay;
  }

  leavePast(): void {
    this.server.moveTo("");
  }

  // Returns the events and notes of a running simulation from this simulated time on.
  async eventsFrom(name: string, from: number): Promise<RecordedEvent[]> {
    return parseEvents(await this.root.get(`${simulationPath(name)}/events?from_s=${from}`));
  }

  // Adds a note at a simulated time of a running simulation. All viewers see it.
  async addNote(name: string, time: number, text: string, author: string): Promise<void> {
    await this.root.post(`${simulationPath(name)}/notes`, { text, time_s: time, ...(author && { author }) });
  }

  async notesOf(recording: string): Promise<RecordingNote[]> {
    return parseNotes(await this.root.get(notesPath(recording)));
  }

  async addNoteTo(recording: string, time: number, text: string, author: string): Promise<void> {
    await this.root.post(notesPath(recording), { text, time_s: time, ...(author && { author }) });
  }

  async removeNote(recording: string, id: number): Promise<void> {
    await this.root.delete(`${notesPath(recording)}/${id}`);
  }

  async difference(recording: string, other: string): Promise<Difference> {
    const path = `api/recordings/${encodeURIComponent(recording)}/difference?with=${encodeURIComponent(other)}`;
    return parseDifference(await this.root.get(path, DIFFERENCE_TIMEOUT_MS));
  }

  // Sends this token with all further requests.
  admit(token: string): void {
    this.credentials.token = token;
  }

  async simulations(): Promise<SimulationSummary[]> {
    return parseSummaries(await this.server.get("api/simulations"));
  }

  async status(name: string): Promise<SimulationStatus> {
    return parseStatus(await this.server.get(simulationPath(name)));
  }

  async scene(name: string): Promise<SceneDescription> {
    return parseScene(await this.server.get(`${simulationPath(name)}/scene`));
  }

  // Returns an image of the view that the server draws. `query` contains the parameters that
  // docs/api.yaml lists for view.jpg.
  image(name: string, query: string, signal: AbortSignal): Promise<Response> {
    return this.server.fetch(`view.jpg?simulation=${encodeURIComponent(name)}&${query}`, signal);
  }

  async act(name: string, action: Action, count = 1): Promise<SimulationStatus> {
    const body = action === "step" ? { count } : {};
    return parseStatus(await this.server.post(`${simulationPath(name)}/${action}`, body, ACTION_TIMEOUT_MS));
  }

  async commands(name: string): Promise<CommandDescription[]> {
    return parseCommands(await this.server.get(`${simulationPath(name)}/commands`));
  }

  async command(name: string, command: string, given: CommandArguments): Promise<void> {
    await this.server.post(`${simulationPath(name)}/${encodeURIComponent(command)}`, given, ACTION_TIMEOUT_MS);
  }

  // Sets the target real-time factor: simulated seconds per second of wall-clock time.
  async setFactor(name: string, factor: number): Promise<SimulationStatus> {
    return parseStatus(await this.server.post(`${simulationPath(name)}/real_time_factor`, { real_time_factor: factor }));
  }

  // Moves the replay to this recorded instant, or to the nearest one.
  async seek(name: string, time: number): Promise<SimulationStatus> {
    return parseStatus(await this.server.post(`${simulationPath(name)}/seek`, { time_s: time }));
  }

  // Moves the replay by a number of recorded instants (negative: backwards), and pauses.
  async stepPoses(name: string, poses: number): Promise<SimulationStatus> {
    return parseStatus(await this.server.post(`${simulationPath(name)}/step`, { poses }));
  }

  async changeReplay(name: string, change: Partial<Pick<Replay, "speed" | "loop">>): Promise<Replay> {
    return parseReplay(await this.server.post(`${simulationPath(name)}/replay`, change));
  }

  // Returns the events of a recording, ordered by time.
  async events(name: string): Promise<RecordedEvent[]> {
    return parseEvents(await this.server.get(`${simulationPath(name)}/events`));
  }

  // Returns the log of a recording, ordered by time.
  async log(name: string): Promise<RecordedLine[]> {
    return parseLog(await this.server.get(`${simulationPath(name)}/log`));
  }

  // Returns the last lines that a robot's behaviour printed.
  async output(name: string, robot: string): Promise<OutputLine[]> {
    return parseOutput(await this.server.get(`${simulationPath(name)}/health?robot=${encodeURIComponent(robot)}`));
  }

  // Returns the curve of a value over the whole recording, or over the part that the server has
  // read so far. The curve has at most `most` points.
  async curve(name: string, of: CurveOf, most: number): Promise<WholeCurve> {
    return parseCurve(await this.server.get(`${simulationPath(name)}/curve?${curveQuery(of, most)}`));
  }

  async recording(name: string): Promise<Recording> {
    return parseRecording(await this.server.get(`${simulationPath(name)}/recording`));
  }

  async record(name: string, record: boolean): Promise<Recording> {
    return parseRecording(await this.server.post(`${simulationPath(name)}/recording`, { record }));
  }

  // Makes the live stream list the topics of the robot's sensors, even if there are very many
  // topics.
  async listTopics(name: string, robot: string): Promise<void> {
    await this.server.get(`${simulationPath(name)}/robots/${encodeURIComponent(robot)}/topics`);
  }

  // The robot stops soon after the last command. So it does not continue if the page crashes or the
  // connection is lost.
  async drive(name: string, robot: string, drive: Drive): Promise<void> {
    const path = `${simulationPath(name)}/robots/${encodeURIComponent(robot)}/drive`;
    await this.server.post(path, { ...drive, timeout_s: DRIVE_TIMEOUT_S });
  }

  async joints(name: string, body: string): Promise<BodyJoints> {
    return parseJoints(await this.server.get(`${simulationPath(name)}/bodies/${encodeURIComponent(body)}/joints`));
  }

  async commandJoint(name: string, body: string, joint: string, kind: JointCommandKind, value: number): Promise<void> {
    const path = `${simulationPath(name)}/bodies/${encodeURIComponent(body)}/joints/${encodeURIComponent(joint)}`;
    await this.server.post(path, { [kind]: value });
  }

  modelUrl(id: string): string {
    return this.server.url(`api/models/${encodeURIComponent(id)}.glb`);
  }

  socketUrl(name: string): string {
    const url = new URL(this.server.url("ws"));
    url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
    const { token, viewer } = this.credentials;
    // A WebSocket cannot have headers, so the token is in the address. URLSearchParams is not used
    // because the server takes a "+" literally.
    const query = Object.entries({ simulation: name, token, viewer }).filter(([, value]) => value !== "");
    url.search = query.map(([key, value]) => `${key}=${encodeURIComponent(value)}`).join("&");
    return url.href;
  }
}

function notesPath(recording: string): string {
  return `api/recordings/${encodeURIComponent(recording)}/notes`;
}
