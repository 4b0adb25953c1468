// The server's JSON API, relative to the page's own address. Every call ends: with an answer, the
// server's sentence, or a timeout.
import { textOr } from "./json";
import type { RecordedEvent, Replay } from "./replay";
import { parseEvents, parseReplay } from "./replay";
import type { SceneDescription } from "./scene";
import { parseScene } from "./scene";
import type { SimulationStatus, SimulationSummary } from "./status";
import { parseStatus, parseSummaries } from "./status";

export type Action = "start" | "pause" | "resume" | "stop" | "reset" | "step";

export interface Drive {
  linear_m_s: number;
  lateral_m_s: number;
  angular_rad_s: number;
}

// What the server answered when it refused; `message` is its sentence.
export class ApiError extends Error {
  constructor(
    readonly httpStatus: number,
    sentence: string,
  ) {
    super(sentence);
  }
}

const TIMEOUT_MS = 10_000;
// Stopping and resetting wait for the behaviours.
const ACTION_TIMEOUT_MS = 60_000;

export class SimulationApi {
  constructor(
    private readonly base: string,
    private readonly fetchPage: typeof fetch = (input, init) => fetch(input, init),
  ) {}

  async simulations(): Promise<SimulationSummary[]> {
    return parseSummaries(await this.json("api/simulations"));
  }

  async status(name: string): Promise<SimulationStatus> {
    return parseStatus(await this.json(simulationPath(name)));
  }

  async scene(name: string): Promise<SceneDescription> {
    return parseScene(await this.json(`${simulationPath(name)}/scene`));
  }

  async act(name: string, action: Action, count = 1): Promise<SimulationStatus> {
    const body = action === "step" ? { count } : {};
    return parseStatus(await this.post(`${simulationPath(name)}/${action}`, body, ACTION_TIMEOUT_MS));
  }

  // The recorded instant, or the end that is nearer.
  async seek(name: string, time: number): Promise<SimulationStatus> {
    return parseStatus(await this.post(`${simulationPath(name)}/seek`, { time_s: time }, TIMEOUT_MS));
  }

  // Over so many recorded poses; then the replay stands still.
  async stepPoses(name: string, poses: number): Promise<SimulationStatus> {
    return parseStatus(await this.post(`${simulationPath(name)}/step`, { poses }, TIMEOUT_MS));
  }

  async changeReplay(name: string, change: Partial<Pick<Replay, "speed" | "loop">>): Promise<Replay> {
    return parseReplay(await this.post(`${simulationPath(name)}/replay`, change, TIMEOUT_MS));
  }

  // What happened in a recording, by time.
  async events(name: string): Promise<RecordedEvent[]> {
    return parseEvents(await this.json(`${simulationPath(name)}/events`));
  }

  async drive(name: string, robot: string, drive: Drive): Promise<void> {
    const path = `${simulationPath(name)}/robots/${encodeURIComponent(robot)}/drive`;
    await this.post(path, drive, TIMEOUT_MS);
  }

  modelUrl(id: string): string {
    return this.url(`api/models/${encodeURIComponent(id)}.glb`);
  }

  socketUrl(name: string): string {
    const url = new URL("ws", this.base);
    url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
    url.search = `simulation=${encodeURIComponent(name)}`;
    return url.href;
  }

  private url(path: string): string {
    return new URL(path, this.base).href;
  }

  private json(path: string): Promise<unknown> {
    return this.request(path, { signal: AbortSignal.timeout(TIMEOUT_MS) });
  }

  private post(path: string, body: object, timeoutMs: number): Promise<unknown> {
    return this.request(path, {
      method: "POST",
      headers: { "content-type": "application/json" },
      body: JSON.stringify(body),
      signal: AbortSignal.timeout(timeoutMs),
    });
  }

  private async request(path: string, init: RequestInit): Promise<unknown> {
    const response = await this.fetchPage(this.url(path), init).catch((error: unknown) => {
      throw new Error(reasonOf(error));
    });
    const answer: unknown = await response.json().catch(() => null);
    if (response.ok) return answer;
    const sentence = textOr((answer as { error?: unknown } | null)?.error, "");
    throw new ApiError(response.status, sentence || `The server answered ${response.status}.`);
  }
}

function simulationPath(name: string): string {
  return `api/simulations/${encodeURIComponent(name)}`;
}

function reasonOf(error: unknown): string {
  const name = (error as { name?: string }).name;
  if (name === "TimeoutError") return "The server did not answer in time.";
  return "The server cannot be reached.";
}
