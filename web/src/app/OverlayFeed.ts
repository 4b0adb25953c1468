// Subscribes to the data of the visible overlays only: sensor poses, and the readings of lidars,
// depth cameras, bumpers and actuators.
import { robotsOf } from "../api/scene";
import type { SceneBody, SceneDescription, SceneSensor } from "../api/scene";
import type { Points } from "../live/clouds";
import { CURRENT_CONTACTS_TOPIC } from "../live/clouds";
import type { RobotBeams } from "../protocol/beams";
import type { TransformsMessage } from "../protocol/messages";
import type { TopicSource } from "../protocol/SharedTopics";
import type { State } from "../state/State";
import type { Store } from "../state/Store";
import { shallowEqual } from "../state/Store";

const MOST_READINGS = 16; // maximum number of sensors whose readings are drawn at a time
const FRAMES_TOPIC = "/tf_static";
const BEAMS_TOPIC = "/gsv/beams";
// If there are more robots than this, only the beams of the selected robot are drawn. The beams of
// all robots would hide everything else.
export const MOST_ROBOTS_WITH_BEAMS = 20;
const BUMPERS = ["contact", "bumper"];
const RADIO_TOPIC = "/gsv/radio";
const MOST_ACTUATORS = 32;
const SPEAKERS = ["speaker", "buzzer"];
const ACTUATORS = ["gripper", "lamp", "led", ...SPEAKERS];

// The part of the 3D view that receives the data.
export interface OverlayView {
  setSensorFrames(message: TransformsMessage): void;
  setBeams(beams: readonly RobotBeams[]): void;
  forgetBeams(): void;
  setPoints(topic: string, points: Points): void;
  setReading(topic: string, message: unknown): void;
  keepReadings(topics: ReadonlySet<string>): void;
}

// Returns the topics that the visible overlays need.
export function topicsToDraw({ scene, shown, selection, viewMode, replay }: State): string[] {
  const wants = (sensor: SceneSensor) =>
    (shown.points && sensor.overlay === "points") || (shown.contacts && replay !== null && BUMPERS.includes(sensor.type));
  const acts = ({ type }: SceneSensor) =>
    (shown.actuators && ACTUATORS.includes(type)) || (shown.sound && SPEAKERS.includes(type));
  const sensors = sensorsOf(scene, selection);
  const readings = [
    ...sensors.filter(wants).slice(0, MOST_READINGS),
    ...sensors.filter(acts).slice(0, MOST_ACTUATORS),
  ];
  const needsFrames = readings.length > 0 || shown.cameras || shown.frames || viewMode === "eye";
  // The scene may not list all radios, because a behaviour may create one at any time.
  const mayHaveRadio = shown.actuators && robotsOf(scene).length > 0;
  const beams = shown.beams && scene ? beamsToDraw(robotsOf(scene), selection, replay !== null) : null;
  return [
    ...(beams === null ? [] : [beams]),
    ...(needsFrames && scene ? [FRAMES_TOPIC] : []),
    ...(mayHaveRadio ? [RADIO_TOPIC] : []),
    // The present contacts are drawn for a running simulation only. A recording contains when other
    // contacts than those of bumpers began, but not when they ended.
    ...(shown.contacts && scene && replay === null ? [CURRENT_CONTACTS_TOPIC] : []),
    ...readings.map(({ topic }) => topic),
  ];
}

// A recording has one topic with the beams of all robots, and not one topic per robot.
function beamsToDraw(robots: readonly SceneBody[], selection: string | null, isReplay: boolean): string | null {
  if (robots.length <= MOST_ROBOTS_WITH_BEAMS) return BEAMS_TOPIC;
  if (!robots.some(({ name }) => name === selection)) return null;
  return isReplay ? BEAMS_TOPIC : `${BEAMS_TOPIC}/${selection}`;
}

// Returns the sensors. The sensors of the selected robot are first.
function sensorsOf(scene: SceneDescription | null, selection: string | null): SceneSensor[] {
  const robots = robotsOf(scene);
  const first = robots.filter(({ name }) => name === selection);
  return [...first, ...robots.filter(({ name }) => name !== selection)].flatMap(({ sensors }) => sensors);
}

export class OverlayFeed {
  private readonly ends = new Map<string, () => void>(); // functions that end subscriptions, by topic
  private simulation: string | null = null;

  constructor(
    private readonly store: Store<State>,
    private readonly topics: TopicSource,
    private readonly view: OverlayView,
  ) {}

  start(): void {
    // Watches only the members on which the topics depend. The whole state changes many times per
    // second and may contain thousands of sensors.
    this.store.watch(
      ({ simulation, scene, shown, selection, viewMode, replay }) => ({
        simulation,
        scene,
        shown,
        selection,
        viewMode,
        isReplay: replay !== null,
      }),
      ({ simulation }) => this.listen(simulation, topicsToDraw(this.store.get())),
      shallowEqual,
    );
  }

  private listen(simulation: string | null, topics: string[]): void {
    // If the simulation changes, a topic with the same name is another stream. So it is subscribed
    // again.
    const kept = new Set(simulation === this.simulation ? topics : []);
    this.simulation = simulation;
    for (const [topic, end] of [...this.ends]) {
      if (kept.has(topic)) continue;
      end();
      this.ends.delete(topic);
    }
    this.view.keepReadings(kept);
    for (const topic of topics) if (!this.ends.has(topic)) this.ends.set(topic, this.subscribe(topic));
  }

  private subscribe(topic: string): () => void {
    if (topic.startsWith(BEAMS_TOPIC)) {
      const end = this.topics.subscribe<RobotBeams[]>(topic, (beams) => this.takeBeams(beams), { form: "beams" });
      return () => {
        end();
        this.view.forgetBeams();
      };
    }
    if (topic === FRAMES_TOPIC) {
      return this.topics.subscribe<TransformsMessage>(topic, (message) =>
        this.view.setSensorFrames(message),
      );
    }
    if (this.isOfPoints(topic)) {
      return this.topics.subscribe<Points>(topic, (points) => this.view.setPoints(topic, points), { form: "points" });
    }
    return this.topics.subscribe<unknown>(topic, (message) => this.view.setReading(topic, message));
  }

  private isOfPoints(topic: string): boolean {
    const { scene } = this.store.get();
    return sensorsOf(scene, null).some((sensor) => sensor.topic === topic && sensor.overlay === "points");
  }

  private takeBeams(beams: readonly RobotBeams[]): void {
    const { scene, selection } = this.store.get();
    const isCrowd = robotsOf(scene).length > MOST_ROBOTS_WITH_BEAMS;
    this.view.setBeams(isCrowd ? beams.filter(({ robot }) => robot === selection) : beams);
  }
}
