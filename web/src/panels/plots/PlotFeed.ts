// Collects the values of the plots' curves as they arrive, each by its simulated instant. Sensors
// are subscribed only while one of their values is plotted. Of a recording the server tells the whole
// curve, which then stands for what is played.
import type { WholeCurve } from "../../api/curve";
import type { SceneDescription } from "../../api/scene";
import { robotsOf } from "../../api/scene";
import { shortWay } from "../../live/angle";
import { numberAt, parsePath } from "../../live/fieldPath";
import { anglesOf, stampOf, valuesOf } from "../../live/values";
import { Series } from "../../live/Series";
import type { TopicSource } from "../../protocol/SharedTopics";
import type { PosesMessage } from "../../protocol/messages";
import { seconds } from "../../protocol/messages";
import type { Curve } from "../../state/plots";
import type { State } from "../../state/State";
import type { StateReader } from "../../state/Store";
import { shallowEqual } from "../../state/Store";

const POSES_TOPIC = "/gsv/poses";
const LONGEST_GAP_S = 1; // between two poses of which a speed is made

interface PlacedAt {
  time: number;
  x: number;
  y: number;
  z: number;
  yaw: number;
}

export class PlotFeed {
  private readonly series = new Map<string, Series>(); // by curve
  private readonly whole = new Map<string, WholeCurve>(); // that the server has told
  private readonly ends = new Map<string, () => void>(); // by topic
  private readonly last = new Map<string, PlacedAt>(); // by robot
  private simulation: string | null = null;
  private newest = -Infinity; // s, simulated

  // `onData`: there is something new to draw.
  constructor(
    private readonly state: StateReader<State>,
    private readonly topics: TopicSource,
    private readonly onData: () => void,
  ) {}

  start(): void {
    this.state.watch(
      ({ simulation, plots, scene }) => ({ simulation, curves: plots.curves, hasScene: scene !== null }),
      () => this.listen(),
      shallowEqual,
    );
    this.state.watch(
      ({ status }) => status,
      () => this.takeStatus(),
    );
  }

  seriesOf(id: string): Series | null {
    return this.series.get(id) ?? null;
  }

  // Whether a recording has more of its values than are plotted.
  isThinned(id: string): boolean {
    return this.whole.get(id)?.isWhole === false;
  }

  // All that is known of a recording's curve.
  takeWhole(id: string, curve: WholeCurve): void {
    const series = this.series.get(id);
    if (!series) return;
    this.whole.set(id, curve);
    series.clear();
    curve.times.forEach((time, i) => series.push(time, curve.values[i]!));
    this.onData();
  }

  private takePoses({ stamp, layout_version, poses }: PosesMessage): void {
    const { scene, plots } = this.state.get();
    if (!scene || scene.layoutVersion !== layout_version) return;
    const time = seconds(stamp);
    this.goOn(time);
    for (const robot of new Set(
      plots.curves.flatMap(({ source: s }) => (s.kind === "robot" ? [s.robot] : [])),
    )) {
      const entry = scene.poses.findIndex(
        ({ body, link }) => link === null && scene.bodies[body]!.name === robot,
      );
      if (entry >= 0 && poses.length >= 7 * entry + 7) this.takePose(robot, time, poses, 7 * entry);
    }
  }

  private takePose(robot: string, time: number, poses: Float64Array, at: number): void {
    const [x, y, z, qx, qy, qz, qw] = poses.subarray(at, at + 7) as unknown as number[] & { length: 7 };
    const { roll, pitch, yaw } = anglesOf({ x: qx!, y: qy!, z: qz!, w: qw! });
    const now: PlacedAt = { time, x: x!, y: y!, z: z!, yaw };
    const before = this.last.get(robot);
    if (before?.time !== time) this.last.set(robot, now);
    const values: Record<string, number> = { x: now.x, y: now.y, z: now.z, roll, pitch, yaw };
    const elapsed = before ? time - before.time : 0;
    if (before && elapsed > 0 && elapsed < LONGEST_GAP_S) {
      values.speed = Math.hypot(now.x - before.x, now.y - before.y, now.z - before.z) / elapsed;
      values.turn_rate = shortWay(yaw - before.yaw) / elapsed;
    }
    this.add(({ source }) => source.kind === "robot" && source.robot === robot, time, values);
  }

  private takeStatus(): void {
    const { status } = this.state.get();
    if (!status) return;
    this.goOn(status.time);
    const simulation = { real_time_factor: status.realTimeFactor, late_steps: status.lateSteps };
    this.add(({ source }) => source.kind === "simulation", status.time, simulation);
    for (const { name, distance, collisions } of status.robots) {
      this.add(({ source }) => source.kind === "robot" && source.robot === name, status.time, {
        distance,
        collisions,
      });
    }
  }

  private takeReading(topic: string, message: unknown): void {
    const time = stampOf(message) ?? this.state.get().time;
    this.goOn(time);
    const values = Object.fromEntries(valuesOf(message).map(({ key, value }) => [key, value]));
    this.add(({ source }) => source.kind === "sensor" && source.topic === topic, time, values);
    const isField = ({ source }: Curve) => source.kind === "topic" && source.topic === topic;
    const fields: Record<string, number> = {};
    for (const { key } of this.state.get().plots.curves.filter(isField)) {
      const value = numberAt(message, parsePath(key) ?? []);
      if (value !== null) fields[key] = value;
    }
    this.add(isField, time, fields);
  }

  private add(isMeant: (curve: Curve) => boolean, time: number, values: Record<string, number>): void {
    let isNews = false;
    for (const curve of this.state.get().plots.curves) {
      const value = isMeant(curve) ? values[curve.key] : undefined;
      if (value === undefined || this.whole.has(curve.id)) continue;
      this.series.get(curve.id)?.push(time, value);
      isNews = true;
    }
    if (isNews) this.onData();
  }

  // What runs never goes back, unless it was reset; a recording does, and its values stay true.
  private goOn(time: number): void {
    const wasReset = time < this.newest - LONGEST_GAP_S && this.state.get().replay === null;
    if (wasReset) {
      for (const series of this.series.values()) series.clear();
      this.last.clear();
      this.newest = time;
    }
    this.newest = Math.max(this.newest, time);
  }

  private listen(): void {
    const { simulation, plots, scene } = this.state.get();
    const isOther = simulation !== this.simulation;
    this.simulation = simulation;
    if (isOther) this.forget();
    const ids = new Set(plots.curves.map(({ id }) => id));
    for (const id of [...this.series.keys()]) {
      if (ids.has(id)) continue;
      this.series.delete(id);
      this.whole.delete(id);
    }
    for (const id of ids) if (!this.series.has(id)) this.series.set(id, new Series());
    const wanted = topicsOf(plots.curves, scene);
    for (const [topic, end] of [...this.ends]) {
      if (wanted.includes(topic)) continue;
      end();
      this.ends.delete(topic);
    }
    for (const topic of wanted) {
      if (this.ends.has(topic)) continue;
      this.ends.set(topic, this.subscribe(topic));
    }
    this.takeStatus();
    this.onData();
  }

  private subscribe(topic: string): () => void {
    if (topic === POSES_TOPIC) {
      return this.topics.subscribe<PosesMessage>(topic, (message) => {
        this.takePoses(message);
        this.takeReading(topic, message);
      });
    }
    return this.topics.subscribe<unknown>(topic, (message) => this.takeReading(topic, message));
  }

  private forget(): void {
    for (const end of this.ends.values()) end();
    this.ends.clear();
    this.series.clear();
    this.whole.clear();
    this.last.clear();
    this.newest = -Infinity;
  }
}

// Those of the sensors that are there, and the poses of robots.
function topicsOf(curves: readonly Curve[], scene: SceneDescription | null): string[] {
  const plotted = new Set(curves.flatMap(({ source }) => (source.kind === "sensor" ? [source.topic] : [])));
  const present = robotsOf(scene).flatMap(({ sensors }) => sensors.map(({ topic }) => topic));
  const needsPoses = scene !== null && curves.some(({ source }) => source.kind === "robot");
  const fields = new Set(curves.flatMap(({ source }) => (source.kind === "topic" ? [source.topic] : [])));
  const readings = new Set([...present.filter((topic) => plotted.has(topic)), ...(scene ? fields : [])]);
  return [...readings, ...(needsPoses && !readings.has(POSES_TOPIC) ? [POSES_TOPIC] : [])];
}
