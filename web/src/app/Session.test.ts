import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { SimulationApi } from "../api/SimulationApi";
import { ApiError } from "../api/SimulationApi";
import type { Replay } from "../api/replay";
import type { Phase, SimulationStatus } from "../api/status";
import type { ClientEvents } from "../protocol/FoxgloveClient";
import { body, scene } from "../scene/testScene";
import type { State, View } from "../state/State";
import { initialState } from "../state/State";
import { Store } from "../state/Store";
import type { LiveClient } from "./Session";
import { Session } from "./Session";

const TWENTY_SECONDS: Replay = { start: 0, end: 20, speed: 1, loop: false };

// A server whose answers the test sets, and its stream.
class Fixture {
  readonly store: Store<State>;
  readonly handlers = new Map<string, (message: never) => void>();
  readonly clients: { url: string; events: ClientEvents; closed: boolean }[] = [];
  readonly onPoses = vi.fn();
  names = ["house"];
  layoutVersion = 1;
  failure = "";
  replay: Replay | null = null;
  sceneRequests = 0;
  readonly openRecording = vi.fn(async () => {});
  readonly seek = vi.fn(async () => {});
  readonly session: Session;

  constructor(wanted: string | null = null, recording: string | null = null, view: View = "open") {
    this.store = new Store<State>({ ...initialState, view });
    const api = {
      openRecording: this.openRecording,
      openPast: async () => (this.replay = TWENTY_SECONDS),
      leavePast: () => void (this.replay = null),
      seek: this.seek,
      setUp: { abilities: async () => initialState.abilities },
      simulations: async () => this.names.map((name) => ({ name, phase: "running", robots: 0 })),
      status: async (name: string) => {
        if (!this.names.includes(name)) throw new ApiError(404, "no such simulation");
        return { ...status(this.failure ? "failed" : "running", this.failure), replay: this.replay };
      },
      events: async () => [{ time: 1, event: "started", robot: "", detail: "" }],
      scene: async (name: string) => {
        this.sceneRequests += 1;
        const camera = {
          name: "eye",
          type: "camera",
          overlay: "picture",
          link: "",
          view: null,
          topic: "/a/eye",
        } as const;
        const visitor = body("visitor", { isAvatar: true, sensors: [{ ...camera, topic: "/visitor/eye" }] });
        const robot = body("a", { sensors: [camera] });
        return scene({ name, layoutVersion: this.layoutVersion, bodies: [visitor, robot] });
      },
      socketUrl: (name: string) => `ws://test/ws?simulation=${name}`,
    } as unknown as SimulationApi;
    this.session = new Session(
      api,
      this.store,
      { simulation: wanted, recording },
      (url, events) => this.makeClient(url, events),
    );
    this.store.watch(
      ({ view }) => view !== "starting",
      (isThere) => isThere && this.session.subscribe("/gsv/packed_poses", this.onPoses),
    );
  }

  get state(): State {
    return this.store.get();
  }

  send(topic: string, message: object): void {
    this.handlers.get(topic)!(message as never);
  }

  sendPoses(layoutVersion: number): void {
    this.send("/gsv/packed_poses", { layout_version: layoutVersion });
  }

  private makeClient(url: string, events: ClientEvents): LiveClient {
    const client = { url, events, closed: false };
    this.clients.push(client);
    return {
      connect: () => events.onConnection({ phase: "open" }),
      close: () => void (client.closed = true),
      retryNow: () => {},
      parameter: async () => null,
      missingTopics: [],
      subscribe: (topic, handler) => {
        if (this.handlers.has(topic)) throw new Error(`a second subscription of ${topic}`);
        this.handlers.set(topic, handler as (message: never) => void);
        return () => this.handlers.delete(topic);
      },
    };
  }
}

function status(phase: Phase, failure = ""): SimulationStatus {
  return {
    phase,
    mode: "real_time",
    step: 500,
    time: 5,
    targetFactor: 1,
    realTimeFactor: 1,
    lateSteps: 0,
    waitingFor: "",
    failure,
    robots: [],
    replay: null,
  };
}

function statusMessage(state: Phase, more: object = {}): object {
  return {
    stamp: { sec: 6, nsec: 0 },
    step: 600n,
    state,
    mode: "real_time",
    real_time_factor: 1,
    target_factor: 1,
    late_steps: 0n,
    waiting_for: "",
    robots: [],
    ...more,
  };
}

async function joined(fixture: Fixture): Promise<Fixture> {
  fixture.session.start();
  await vi.waitFor(() => expect(fixture.state.status).not.toBeNull());
  return fixture;
}

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

test("it joins the simulation in the address, or else the first one", async () => {
  const named = new Fixture("yard");
  named.names = ["house", "yard"];
  expect((await joined(named)).state.simulation).toBe("yard");
  const other = await joined(new Fixture("gone"));
  expect(other.state.simulation).toBe("house");
  expect(other.state.notices[0]?.sentence).toBe("This server has no simulation gone. The page shows house instead.");
});

test("it loads the scene, and shows a robot's camera rather than an avatar's", async () => {
  const { state, clients } = await joined(new Fixture());
  expect(state.scene?.name).toBe("house");
  expect(state.camera?.robot).toBe("a");
  expect(clients[0]?.url).toBe("ws://test/ws?simulation=house");
});

test("frequently changing topics are subscribed when there is a view, after the scene and its state", async () => {
  const fixture = new Fixture(null, null, "starting");
  await joined(fixture);
  expect(fixture.state.scene?.name).toBe("house");
  expect([...fixture.handlers.keys()]).toEqual([]);

  fixture.store.set({ view: "open" });
  fixture.sendPoses(1);
  expect(fixture.onPoses).toHaveBeenCalledTimes(1);
});

test("without a simulation it looks repeatedly until there is one", async () => {
  const fixture = new Fixture();
  fixture.names = [];
  fixture.session.start();
  await vi.waitFor(() => expect(fixture.state.simulations).toEqual([]));
  fixture.names = ["late"];
  await vi.advanceTimersByTimeAsync(2500);
  expect(fixture.state.simulation).toBe("late");
});

test("poses of another layout cause one new request for the scene", async () => {
  const fixture = await joined(new Fixture());
  fixture.layoutVersion = 2;
  fixture.sendPoses(1);
  expect(fixture.sceneRequests).toBe(1);
  fixture.sendPoses(2);
  fixture.sendPoses(2);
  await vi.waitFor(() => expect(fixture.state.scene?.layoutVersion).toBe(2));
  fixture.sendPoses(2);
  expect(fixture.sceneRequests).toBe(2);
  expect(fixture.onPoses).toHaveBeenCalledTimes(4);
});

test("a selected robot stays selected after a change of the scene's layout", async () => {
  const fixture = await joined(new Fixture());
  fixture.store.set({ selection: "a" });
  fixture.layoutVersion = 2;
  fixture.sendPoses(2);
  await vi.waitFor(() => expect(fixture.state.scene?.layoutVersion).toBe(2));
  expect(fixture.state.selection).toBe("a");
});

test("if its simulation no longer exists after a restart, it joins another one", async () => {
  const fixture = await joined(new Fixture());
  fixture.names = ["other"];
  fixture.clients[0]!.events.onConnection({ phase: "waiting", attempt: 1, retryAtMs: 0 });
  await vi.waitFor(() => expect(fixture.state.simulation).toBe("other"));
  expect(fixture.clients[0]?.closed).toBe(true);
});

test("a reconnection is reported, but not the first connection", async () => {
  const fixture = await joined(new Fixture());
  expect(fixture.state.notices).toEqual([]);
  fixture.clients[0]!.events.onConnection({ phase: "open" });
  expect(fixture.state.notices.map(({ sentence }) => sentence)).toEqual(["Connected again."]);
});

test("deaths of behaviours are shown, except those before the page was opened", async () => {
  const fixture = await joined(new Fixture());
  const death = (sec: number, robot: string) => ({
    stamp: { sec, nsec: 0 },
    event: "agent_dead",
    robot,
    detail: `${robot} (wander): killed`,
  });
  fixture.send("/gsv/events", death(4, "a"));
  fixture.send("/gsv/events", death(6, "b"));
  expect(fixture.state.notices.map(({ sentence }) => sentence)).toEqual(["b (wander): killed"]);
});

test("after a reset, deaths are shown from the new start on", async () => {
  const fixture = await joined(new Fixture());
  fixture.send("/gsv/status", statusMessage("created", { stamp: { sec: 0, nsec: 0 } }));
  fixture.send("/gsv/events", { stamp: { sec: 3, nsec: 0 }, event: "agent_dead", robot: "a", detail: "a (wander): killed" });
  expect(fixture.state.notices.map(({ sentence }) => sentence)).toEqual(["a (wander): killed"]);
});

test("the past has its events, and the page returns to a live run", async () => {
  const fixture = await joined(new Fixture());
  await vi.waitFor(() => expect(fixture.state.isLive).toBe(true));
  await fixture.session.enterPast();
  await vi.waitFor(() => expect(fixture.state.events).toHaveLength(1));
  expect(fixture.state).toMatchObject({ isLive: false, inPast: true, replay: TWENTY_SECONDS });
  fixture.session.goLive();
  await vi.waitFor(() => expect(fixture.state.isLive).toBe(true));
  expect(fixture.state).toMatchObject({ inPast: false, replay: null, events: [] });
});

test("a recording is recognised by its status, and its events are fetched", async () => {
  const fixture = new Fixture();
  fixture.replay = { start: 0, end: 9, speed: 1, loop: true };
  await joined(fixture);
  await vi.waitFor(() => expect(fixture.state.events).toHaveLength(1));
  expect(fixture.state.replay).toEqual(fixture.replay);
  fixture.send("/gsv/status", statusMessage("running", { target_factor: 5 }));
  expect(fixture.state.replay).toEqual({ start: 0, end: 9, speed: 5, loop: true });
});

test("a live simulation is not a recording", async () => {
  const fixture = await joined(new Fixture());
  fixture.send("/gsv/status", statusMessage("running"));
  expect(fixture.state).toMatchObject({ replay: null, events: [] });
});

test("the reason of a failure is fetched when the stream reports the failure", async () => {
  const fixture = await joined(new Fixture());
  fixture.failure = "a's behaviour was killed";
  fixture.send("/gsv/status", statusMessage("failed"));
  await vi.waitFor(() => expect(fixture.state.status?.failure).toBe("a's behaviour was killed"));
});

test("a recording is opened for this page only before other requests, and a missing one is reported", async () => {
  const fixture = new Fixture(null, "run.mcap");
  await joined(fixture);
  expect(fixture.openRecording).toHaveBeenCalledWith("run.mcap");
  const gone = new Fixture(null, "gone.mcap");
  gone.openRecording.mockRejectedValue(new ApiError(404, "there is no recording 'gone.mcap' here"));
  gone.session.start();
  await vi.waitFor(() => expect(gone.state.missing).toBe("there is no recording 'gone.mcap' here"));
  expect(gone.state.simulation).toBeNull();
});

test("after a restart of the server, the page's own replay is opened again at the same instant", async () => {
  const fixture = new Fixture(null, "run.mcap");
  fixture.replay = TWENTY_SECONDS;
  await joined(fixture);
  await vi.waitFor(() => expect(fixture.state.replay).toEqual(TWENTY_SECONDS));
  fixture.store.set({ time: 7.5 });
  fixture.names = [];
  fixture.clients[0]!.events.onConnection({ phase: "waiting", attempt: 1, retryAtMs: 0 });
  fixture.openRecording.mockImplementation(async () => void (fixture.names = ["house"]));
  await vi.waitFor(() => expect(fixture.seek).toHaveBeenCalledWith("house", 7.5));
  expect(fixture.openRecording).toHaveBeenCalledTimes(2);
});

test("a panel reads the session's topics, and continues in another simulation", async () => {
  const fixture = await joined(new Fixture());
  const panel = vi.fn();
  const end = fixture.session.subscribe("/gsv/status", panel);
  fixture.send("/gsv/status", statusMessage("running"));
  expect(panel).toHaveBeenCalledTimes(1);
  fixture.names = ["house", "yard"];
  fixture.session.join("yard");
  await vi.waitFor(() => expect(fixture.state.scene?.name).toBe("yard"));
  fixture.send("/gsv/status", statusMessage("paused"));
  expect(panel).toHaveBeenCalledTimes(2);
  end();
  fixture.send("/gsv/status", statusMessage("running"));
  expect(panel).toHaveBeenCalledTimes(2);
  expect(fixture.state.status?.phase).toBe("running");
});
