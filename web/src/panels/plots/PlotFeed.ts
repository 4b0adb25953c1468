// Collects the values of the plotted curves as they arrive, by simulated time. A sensor is
// subscribed only while one of its values is plotted. For a recording, the server computes the
// whole curve. This curve then replaces the values from playback.
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
import type { Expression } from "../../live/expression";
import { parseExpression } from "../../live/expression";
import type { Curve } from "../../state/plots";
import { curveId, inputsOf, referredTo } from "../../state/plots";
import type { State } from "../../state/State";
import type { StateReader } from "../../state/Store";
import { shallowEqual } from "../../state/Store";

const POSES_TOPIC = "/gsv/poses";
const LONGEST_GAP_S = 1; // maximum time between two poses from which a speed is computed

type Input = Pick<Curve, "id" | "source" | "key">;

interface Formula {
  id: string; // id of the curve
  inputs: readonly string[]; // ids of the inputs, in the order in which the expression names them
  evaluate: Expression["evaluate"];
}

interface PlacedAt {
  time: number;
  x: number;
  y: number;
  z: number;
  yaw: number;
}

export class PlotFeed {
  private readonly series = new Map<string, Series>(); // samples by curve
  // Whole curves that the server has computed.
  private readonly whole = new Map<string, WholeCurve>();
  // Curves of the second recording of a comparison.
  private readonly compared = new Map<string, Series>();
  private readonly ends = new Map<string, () => void>(); // functions that end subscriptions, by topic
  private readonly last = new Map<string, PlacedAt>(); // last position, by robot
  // The values to collect: those of plotted curves, and those that expressions use.
  private inputs: readonly Input[] = [];
  private formulas: readonly Formula[] = [];
  // The newest value of each input that expressions use.
  private readonly newestValues = new Map<string, number>();
  private simulation: string | null = null;
  private newest = -Infinity; // s, simulated

  // `onData` is called when there are new values to draw.
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
    // If the page changes between live data and a replay (also a replay of the run's own past), the
    // curves are cleared. So live values and replayed values are not mixed.
    this.state.watch(
      ({ replay }) => replay !== null,
      () => this.forgetRecorded(),
    );
    this.state.watch(
      ({ comparison }) => comparison?.recording,
      () => {
        this.compared.clear();
        this.onData();
      },
    );
    this.state.watch(
      ({ status }) => status,
      () => this.takeStatus(),
    );
  }

  private forgetRecorded(): void {
    this.whole.clear();
    for (const series of this.series.values()) series.clear();
    this.last.clear();
    this.onData();
  }

  seriesOf(id: string): Series | null {
    return this.series.get(id) ?? null;
  }

  // The curve of the same value in the second recording of a comparison; null if there is none.
  comparedOf(id: string): Series | null {
    return this.compared.get(id) ?? null;
  }

  // Whether the recording has more values than are plotted.
  isThinned(id: string): boolean {
    return this.whole.get(id)?.isWhole === false;
  }

  // Stores the curve that the server has computed for a recording.
  takeWhole(id: string, curve: WholeCurve): void {
    const series = this.series.get(id);
    if (!series) return;
    this.whole.set(id, curve);
    series.clear();
    curve.times.forEach((time, i) => series.push(time, curve.values[i]!));
    this.onData();
  }

  // Adds the earlier part of a run's curve, before the values that were received live.
  takePast(id: string, curve: WholeCurve): void {
    const series = this.series.get(id);
    if (!series) return;
    const first = series.length > 0 ? series.timeAt(0) : Infinity;
    const later = Array.from({ length: series.length }, (_, i) => [series.timeAt(i), series.valueAt(i)] as const);
    series.clear();
    curve.times.forEach((time, i) => time < first && series.push(time, curve.values[i]!));
    for (const [time, value] of later) series.push(time, value);
    this.onData();
  }

  takeCompared(id: string, curve: WholeCurve): void {
    const series = new Series();
    curve.times.forEach((time, i) => series.push(time, curve.values[i]!));
    this.compared.set(id, series);
    this.onData();
  }

  private takePoses({ stamp, layout_version, poses }: PosesMessage): void {
    const { scene } = this.state.get();
    if (!scene || scene.layoutVersion !== layout_version) return;
    const time = seconds(stamp);
    this.goOn(time);
    for (const robot of new Set(
      this.inputs.flatMap(({ source: s }) => (s.kind === "robot" ? [s.robot] : [])),
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
    const isField = ({ source }: Input) => source.kind === "topic" && source.topic === topic;
    const fields: Record<string, number> = {};
    for (const { key } of this.inputs.filter(isField)) {
      // The expression may also use the name that the inspector shows for a value, such as
      // "ranges.min".
      const value = numberAt(message, parsePath(key) ?? []) ?? values[key];
      if (value !== undefined) fields[key] = value;
    }
    this.add(isField, time, fields);
  }

  private add(isMeant: (input: Input) => boolean, time: number, values: Record<string, number>): void {
    const changed = new Set<string>();
    for (const input of this.inputs) {
      const value = isMeant(input) ? values[input.key] : undefined;
      if (value === undefined) continue;
      changed.add(input.id);
      this.newestValues.set(input.id, value);
      this.push(input.id, time, value);
    }
    for (const { id, inputs, evaluate } of this.formulas) {
      if (!inputs.some((each) => changed.has(each))) continue;
      const given = inputs.map((each) => this.newestValues.get(each));
      if (given.every((each) => each !== undefined)) this.push(id, time, evaluate(given));
    }
    if (changed.size > 0) this.onData();
  }

  private push(id: string, time: number, value: number): void {
    if (!this.whole.has(id)) this.series.get(id)?.push(time, value);
  }

  // If simulated time decreases, a run was reset, so its values are removed. In a replay, the user
  // may go back in time, and the values remain valid.
  private goOn(time: number): void {
    const wasReset = time < this.newest - LONGEST_GAP_S && this.state.get().replay === null;
    if (wasReset) {
      for (const series of this.series.values()) series.clear();
      this.last.clear();
      this.newestValues.clear();
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
      this.compared.delete(id);
    }
    for (const id of ids) if (!this.series.has(id)) this.series.set(id, new Series());
    this.formulas = plots.curves.flatMap(formulaOf);
    this.inputs = distinctInputs(plots.curves);
    const wanted = topicsOf(this.inputs, scene);
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
    this.newestValues.clear();
    this.newest = -Infinity;
  }
}

function idOf({ source, key }: Pick<Curve, "source" | "key">): string {
  return curveId(source, key);
}

function distinctInputs(curves: readonly Curve[]): Input[] {
  const inputs = new Map(curves.flatMap(inputsOf).map(({ source, key }) => [curveId(source, key), { source, key }]));
  return [...inputs].map(([id, input]) => ({ id, ...input }));
}

function formulaOf({ id, source, key }: Curve): Formula[] {
  if (source.kind !== "expression") return [];
  const { references, evaluate } = parseExpression(key);
  return [{ id, inputs: references.map((each) => idOf(referredTo(each))), evaluate }];
}

// Returns the topics to subscribe to: those of the plotted sensors that exist in the scene, those
// of plotted fields, and the topic of poses if a robot's value is plotted.
function topicsOf(curves: readonly Input[], scene: SceneDescription | null): string[] {
  const plotted = new Set(curves.flatMap(({ source }) => (source.kind === "sensor" ? [source.topic] : [])));
  const present = robotsOf(scene).flatMap(({ sensors }) => sensors.map(({ topic }) => topic));
  const needsPoses = scene !== null && curves.some(({ source }) => source.kind === "robot");
  const fields = new Set(curves.flatMap(({ source }) => (source.kind === "topic" ? [source.topic] : [])));
  const readings = new Set([...present.filter((topic) => plotted.has(topic)), ...(scene ? fields : [])]);
  return [...readings, ...(needsPoses && !readings.has(POSES_TOPIC) ? [POSES_TOPIC] : [])];
}
