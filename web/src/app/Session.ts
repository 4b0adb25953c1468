// Keeps the store consistent with the server. Finds the simulation, fetches its scene, and reads
// its live stream. Starts again if the connection was lost or the layout has changed.
import type { SimulationApi } from "../api/SimulationApi";
import { ApiError, needsToken } from "../api/JsonServer";
import type { SceneDescription } from "../api/scene";
import { camerasOf } from "../api/scene";
import type { SimulationStatus } from "../api/status";
import { statusFromMessage } from "../api/status";
import { backoffMs } from "../protocol/Backoff";
import type { ClientEvents, ParameterValue, TopicCount } from "../protocol/FoxgloveClient";
import { FoxgloveClient } from "../protocol/FoxgloveClient";
import type { TopicOptions, TopicSource } from "../protocol/SharedTopics";
import { SharedTopics } from "../protocol/SharedTopics";
import type { LiveView, LiveViewSource, ViewReader } from "../protocol/LiveViews";
import { SharedViews } from "../protocol/LiveViews";
import { PACKED_POSES, POSES } from "../protocol/packedPoses";
import type {
  ClockMessage,
  ExpectationsMessage,
  HealthMessage,
  LifecycleEventMessage,
  PosesMessage,
  SimulationStatusMessage,
} from "../protocol/messages";
import { seconds } from "../protocol/messages";
import { expectationOf } from "../state/expectations";
import { healthOf } from "../state/health";
import { withServerWarning } from "../state/serverWarnings";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { shallowEqual } from "../state/Store";
import { notify } from "./notices";
import { SlowPage } from "./SlowPage";
import { TopicRequests } from "./TopicRequests";

const EMPTY_POLL_MS = 2000;
const SCENE_RETRY_MS = 3000;

const NOTHING_WATCHED: Partial<State> = {
  scene: null,
  status: null,
  time: 0,
  replay: null,
  isLive: false,
  kept: null,
  inPast: false,
  events: [],
  notes: [],
  health: null,
  endSeen: false,
  expectations: [],
  wishedTime: null,
  selection: null,
  selectedPose: null,
  part: null,
  viewMode: "orbit",
  camera: null,
  serverWarnings: [],
  topics: [],
};

const SLOW_PAGE = "This page is slow: the browser is busy, so older updates are left out. Close panels, or let the server draw the view.";
const NO_COUNTS: ReadonlyMap<string, TopicCount> = new Map();

// The simulation or recording that the page's address asks for; null if the address names none.
export interface Wanted {
  simulation: string | null;
  recording: string | null; // the recording to replay for this page only
}

export const NOTHING_WANTED: Wanted = { simulation: null, recording: null };

// The part of the live stream that the session uses.
export type LiveClient = Pick<FoxgloveClient, "connect" | "close" | "retryNow" | "subscribe" | "parameter" | "missingTopics"> &
  Partial<Pick<FoxgloveClient, "counts" | "received" | "openView">>;
export type ClientFactory = (url: string, events: ClientEvents) => LiveClient;

type LayoutMessage = Pick<PosesMessage, "layout_version">;

export class Session implements TopicSource, LiveViewSource {
  private client: LiveClient | null = null;
  // The problem of the connection that the server has reported; empty if there is none.
  private lasting = "";
  private readonly slowPage = new SlowPage(
    () => this.client?.received ?? 0,
    (isSlow) => this.store.set({ connectionProblem: isSlow ? SLOW_PAGE : this.lasting }),
  );
  private readonly topics = new SharedTopics(); // subscriptions of the client
  private readonly views = new SharedViews(); // views of the client
  private timer: ReturnType<typeof setTimeout> | undefined;
  private attempt = 0;
  private sceneText = "";
  private fetchingScene: string | null = null; // name of the simulation whose scene is being fetched
  private sceneFailedAtMs = -Infinity;
  private wasOpen = false;
  private hasOpened = false; // whether the requested recording was opened
  // s, simulated: time to which the replay seeks after a new connection.
  private instant: number | null = null;
  private newsSince = Infinity; // s, simulated; older events are not shown as notices
  // If the page changes between a run and its past, a closed stream does not mean a lost
  // connection.
  private isSwitching = false;
  // Whether the status in the store describes another run than the stream that is being opened: the
  // run instead of its past, or the reverse.
  private isStatusOfOther = false;
  private readonly topicRequests: TopicRequests;

  constructor(
    private readonly api: SimulationApi,
    private readonly store: Store<State>,
    private readonly wanted: Wanted,
    private readonly makeClient: ClientFactory = (url, events) => new FoxgloveClient(url, events),
  ) {
    this.topicRequests = new TopicRequests(api, store, () => this.client?.missingTopics ?? []);
    store.watch(
      ({ view }) => view !== "starting",
      (isThere) => isThere && this.hear(),
    );
  }

  start(): void {
    void this.findSimulation();
    if (this.wanted.recording === null) void this.findAbilities();
  }

  retryNow(): void {
    if (this.client) this.client.retryNow();
    else void this.findSimulation();
  }

  join(name: string): void {
    this.leave();
    this.wasOpen = this.isStatusOfOther = false;
    this.sceneText = "";
    this.store.set({ ...NOTHING_WATCHED, simulation: name });
    this.connect(name);
    if (this.instant !== null) return;
    // These two requests are sent before the stream opens, because they do not need it.
    void this.fetchStatus(name);
    void this.fetchScene(name, () => {}); // if the stream opens without the scene, the scene is fetched again
  }

  // Shows the past of the simulation that the server stores, as a replay for this page only. The
  // page does not change until the replay sends data.
  async enterPast(): Promise<void> {
    const { simulation, inPast } = this.store.get();
    if (simulation === null || inPast) return;
    const replay = await this.api.openPast(simulation);
    if (this.store.get().simulation !== simulation) {
      this.api.leavePast();
      throw new Error("Another simulation was opened meanwhile.");
    }
    this.switchStream(simulation, { inPast: true, replay, isLive: false, events: [] });
  }

  // Returns to the running simulation.
  goLive(): void {
    const { simulation, inPast } = this.store.get();
    if (simulation === null || !inPast) return;
    this.api.leavePast();
    this.switchStream(simulation, { inPast: false, replay: null, wishedTime: null, events: [] });
  }

  private switchStream(simulation: string, change: Partial<State>): void {
    this.leave();
    this.wasOpen = false;
    this.isSwitching = this.isStatusOfOther = true;
    this.store.set(change);
    this.connect(simulation);
  }

  // Joins a simulation that was just created.
  async joinNew(name: string): Promise<void> {
    this.store.set({ simulations: await this.api.simulations() });
    this.join(name);
  }

  // Shows no simulation until join() or start() is called.
  rest(): void {
    clearTimeout(this.timer);
    this.leave();
    this.store.set({ ...NOTHING_WATCHED, simulation: null });
  }

  private leave(): void {
    clearTimeout(this.timer);
    this.client?.close();
    this.client = null;
    this.topics.attach(null);
    this.views.attach(null);
  }

  // Subscribes to a topic of the present simulation, and of each simulation that is shown
  // afterwards.
  subscribe<Message>(topic: string, handler: (message: Message) => void, options?: TopicOptions): () => void {
    this.topicRequests.lookSoon();
    return this.topics.subscribe(topic, handler, options);
  }

  // Opens a view of the present simulation, and of each simulation that is shown afterwards.
  openView(reader: ViewReader): LiveView {
    return this.views.openView(reader);
  }

  get readTopics(): string[] {
    return this.topics.read;
  }

  // The number of messages and bytes received on each topic that is read.
  counts(): ReadonlyMap<string, TopicCount> {
    return this.client?.counts ?? NO_COUNTS;
  }

  // Returns the value of a parameter from the server of the stream; null if there is no answer.
  parameter(name: string): Promise<ParameterValue | null> {
    return this.client?.parameter(name) ?? Promise.resolve(null);
  }

  takeStatus(status: SimulationStatus): void {
    const known = this.store.get().status;
    const failure = status.failure || (status.phase === "failed" ? (known?.failure ?? "") : "");
    this.store.set({ status: { ...status, failure }, time: status.time });
    if (status.phase !== "finished" && status.phase !== "failed" && this.store.get().endSeen) this.store.set({ endSeen: false });
    this.takeReplay(status);
    // After a reset, the simulated time starts again, and its events are new.
    if (this.newsSince !== Infinity) this.newsSince = Math.min(this.newsSince, status.time);
  }

  // The stream does not report whether this is a replay, but the API does. The stream reports the
  // speed of a replay.
  private takeReplay({ replay: told, targetFactor }: SimulationStatus): void {
    const known = this.store.get().replay;
    const replay = told ?? (known && { ...known, speed: targetFactor });
    if (!shallowEqual(replay, known)) this.store.set({ replay });
  }

  private async findSimulation(): Promise<void> {
    clearTimeout(this.timer);
    this.attempt += 1;
    try {
      if (!(await this.openRecording())) return;
      const simulations = await this.api.simulations();
      this.attempt = 0;
      this.store.set({ simulations });
      if (this.store.get().setUp) return;
      const chosen = simulations.find(({ name }) => name === this.wanted.simulation) ?? simulations[0];
      if (chosen) {
        const { simulation: wanted } = this.wanted;
        if (wanted && chosen.name !== wanted) {
          notify(this.store, "note", `This server has no simulation ${wanted}. The page shows ${chosen.name} instead.`);
        }
        this.join(chosen.name);
        return;
      }
      this.store.set({ connection: { phase: "open" } });
      this.timer = setTimeout(() => void this.findSimulation(), EMPTY_POLL_MS);
    } catch (error) {
      if (needsToken(error)) return this.store.set({ refusal: (error as ApiError).message });
      const wait = backoffMs(this.attempt);
      this.store.set({
        connection: { phase: "waiting", attempt: this.attempt, retryAtMs: Date.now() + wait },
      });
      this.timer = setTimeout(() => void this.findSimulation(), wait);
    }
  }

  // Starts again after the user has entered an access token.
  admit(): void {
    this.store.set({ refusal: "" });
    this.start();
  }

  // Opens the recording that the page's address requests, if any. Returns false if the server
  // refuses it, for example because the recording no longer exists. Throws an error if a later
  // attempt may succeed.
  private async openRecording(): Promise<boolean> {
    const { recording } = this.wanted;
    if (recording === null || this.hasOpened) return true;
    try {
      await this.api.openRecording(recording);
    } catch (error) {
      if (!(error instanceof ApiError) || error.httpStatus >= 500 || needsToken(error)) throw error;
      this.store.set({ missing: error.message, connection: { phase: "open" } });
      return false;
    }
    this.hasOpened = true;
    void this.findAbilities();
    return true;
  }

  // Shows a problem of the connection. While there is a problem, checks whether its cause is this
  // page, because it reads too slowly. If so, shows this as the problem.
  private showLasting(sentence: string): void {
    this.lasting = sentence;
    if (sentence !== "") return this.slowPage.start();
    this.slowPage.stop();
    this.store.set({ connectionProblem: "" });
  }

  private async findAbilities(): Promise<void> {
    try {
      this.store.set({ abilities: await this.api.setUp.abilities() });
    } catch {
      // Ignored: without the answer, the page does not offer the actions that only some servers
      // support.
    }
  }

  private connect(name: string): void {
    const client = this.makeClient(this.api.socketUrl(name), {
      onConnection: (connection) => {
        if (this.isSwitching && connection.phase === "connecting") return;
        this.isSwitching = false;
        this.store.set({ connection });
        if (connection.phase === "open") void this.opened(name);
        else if (connection.phase === "waiting") void this.checkStillThere(name);
      },
      onTopics: (topics) => this.store.set({ topics }),
      onLasting: (sentences) => this.showLasting(sentences.join(" ")),
      onProblem: (sentence) => {
        notify(this.store, "error", sentence);
        this.store.set(({ serverWarnings }) => ({ serverWarnings: withServerWarning(serverWarnings, sentence) }));
      },
    });
    this.client = client;
    this.topics.attach(client);
    this.views.attach(client.openView ? (client as LiveViewSource) : null);
    client.connect();
  }

  // Subscribes to the frequently changing topics once there is a view. Until then, each update
  // would make the browser draw the page again, which is slow without a graphics card.
  private hear(): void {
    const { topics } = this;
    topics.subscribe<LayoutMessage>(PACKED_POSES, (message) => this.takePoses(message), { orElse: POSES });
    topics.subscribe<ClockMessage>("/clock", ({ clock }) => this.store.set({ time: seconds(clock) }));
    topics.subscribe<SimulationStatusMessage>("/gsv/status", (message) => {
      const { status, simulation } = this.store.get();
      const hadFailed = status?.phase === "failed";
      this.takeStatus(statusFromMessage(message));
      // The stream reports that the run failed. The API also reports why.
      if (message.state === "failed" && !hadFailed && simulation !== null) void this.fetchStatus(simulation);
    });
    topics.subscribe<HealthMessage>("/gsv/health", (message) => this.store.set({ health: healthOf(message) }));
    topics.subscribe<ExpectationsMessage>("/gsv/expectations", ({ expectations }) =>
      this.store.set({ expectations: expectations.map(expectationOf) }),
    );
    topics.subscribe<LifecycleEventMessage>("/gsv/events", (message) => this.takeEvent(message));
  }

  private async opened(name: string): Promise<void> {
    const isFetched = !this.wasOpen && !this.isStatusOfOther;
    this.isStatusOfOther = false;
    if (this.wasOpen) notify(this.store, "note", "Connected again.");
    this.wasOpen = true;
    const instant = this.instant;
    this.instant = null;
    const { scene, status } = this.store.get();
    if (isFetched && instant === null && scene && status && status.phase !== "failed") {
      // The scene and the status have just been fetched. The stream reports all later changes.
      this.newsSince = status.time;
      return this.topicRequests.lookSoon();
    }
    this.newsSince = Infinity;
    // If this fails, the replay stays at its start.
    if (instant !== null) await this.api.seek(name, instant).catch(() => {});
    await Promise.all([this.fetchScene(name), this.fetchStatus(name)]);
    this.topicRequests.lookSoon();
  }

  // Checks whether the simulation still exists. After a restart of the server, it may not exist any
  // more. The page then searches for other simulations.
  private async checkStillThere(name: string): Promise<void> {
    try {
      await this.api.status(name);
    } catch (error) {
      if (!(error instanceof ApiError && error.httpStatus === 404)) return;
      if (this.store.get().simulation !== name) return;
      if (this.store.get().inPast) {
        notify(this.store, "note", "The server has closed the view of the past. The page shows the running simulation again.");
        return this.goLive();
      }
      this.leave();
      // A replay of this page ends with its server. A new replay continues at the same instant.
      this.instant = this.store.get().replay && this.hasOpened ? this.store.get().time : null;
      this.hasOpened = false;
      this.store.set({ ...NOTHING_WATCHED, simulation: null });
      this.sceneText = "";
      void this.findSimulation();
    }
  }

  private takePoses({ layout_version }: LayoutMessage): void {
    const { scene, simulation } = this.store.get();
    if (simulation === null || scene?.layoutVersion === layout_version) return;
    if (Date.now() - this.sceneFailedAtMs > SCENE_RETRY_MS) void this.fetchScene(simulation);
  }

  private async fetchScene(name: string, onError = (reason: string) => this.reportScene(reason)): Promise<void> {
    if (this.fetchingScene === name) return;
    this.fetchingScene = name;
    try {
      const scene = await this.api.scene(name);
      const text = JSON.stringify(scene);
      if (this.store.get().simulation === name && text !== this.sceneText) {
        this.sceneText = text;
        this.takeScene(scene);
      }
    } catch (error) {
      this.sceneFailedAtMs = Date.now();
      onError((error as Error).message);
    } finally {
      if (this.fetchingScene === name) this.fetchingScene = null;
    }
  }

  private reportScene(reason: string): void {
    notify(this.store, "error", `Cannot show the scene: ${reason}`);
  }

  private takeScene(scene: SceneDescription): void {
    const avatars = new Set(scene.bodies.filter(({ isAvatar }) => isAvatar).map(({ name }) => name));
    this.store.set(({ camera, selection }) => {
      const cameras = camerasOf(scene);
      const kept = cameras.find(({ topic }) => topic === camera?.topic);
      return {
        scene,
        camera: kept ?? cameras.find(({ robot }) => !avatars.has(robot)) ?? cameras[0] ?? null,
        selection: scene.bodies.some(({ name }) => name === selection) ? selection : null,
      };
    });
  }

  private async fetchStatus(name: string): Promise<void> {
    const { client } = this;
    try {
      const status = await this.api.status(name);
      if (this.store.get().simulation !== name || this.client !== client) return;
      this.takeStatus(status);
      this.store.set({ isLive: status.replay === null });
      this.newsSince = Math.min(this.newsSince, status.time);
      if (status.replay) void this.fetchEvents(name);
    } catch {
      // Ignored: the stream also carries the status, and reports a lost connection.
    }
  }

  private async fetchEvents(name: string): Promise<void> {
    const { client } = this;
    const events = await this.api.events(name).catch(() => []); // the timeline is useful without events, too
    if (this.store.get().simulation === name && this.client === client) this.store.set({ events });
  }

  // Handles an event. A new subscription also delivers past events; only later events are shown as
  // notices.
  private takeEvent(message: LifecycleEventMessage): void {
    if (seconds(message.stamp) < this.newsSince) return;
    if (message.event === "agent_dead" || message.event === "agent_unresponsive") {
      notify(this.store, "error", message.detail || `${message.robot}: the behaviour crashed.`);
    }
  }
}
