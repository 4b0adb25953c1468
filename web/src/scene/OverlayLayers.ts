// The overlays of the view: beams, points, contacts, camera views, trails, axes, actuators.
import { Group, Matrix4, Vector3 } from "three";
import type { SceneInertial, SceneSensor } from "../api/scene";
import { robotsOf } from "../api/scene";
import type { Points, TouchPoint } from "../live/clouds";
import { contactsOf, CURRENT_CONTACTS_TOPIC, worldContactsOf } from "../live/clouds";
import type { Sound } from "../live/devices";
import type { RobotBeams } from "../protocol/beams";
import type { TransformsMessage } from "../protocol/messages";
import type { OverlayColours, Shown } from "../state/overlays";
import { FIRST_COLOURS, FIRST_SHOWN } from "../state/overlays";
import { BeamLayer } from "./BeamLayer";
import type { BodyLayer } from "./BodyLayer";
import { matrixOf } from "./BodyFrames";
import { DeviceLayer } from "./DeviceLayer";
import { ExpectationMarks } from "./ExpectationMarks";
import type { EquivalentBox } from "./inertia";
import { equivalentBox } from "./inertia";
import { LineLayer } from "./LineLayer";
import { drawAxes, drawContact, drawJoint, drawMass, drawView } from "./markings";
import { PointLayer } from "./PointLayer";
import type { PoseSample } from "./PoseInterpolator";
import { RadioLinks } from "./RadioLinks";
import { SensorFrames } from "./SensorFrames";
import { SoundPlayer } from "./SoundPlayer";
import { Trails } from "./Trails";

const ROBOT_AXES = 0.45; // m
const LINK_AXES = 0.2;
const SENSOR_AXES = 0.14;
const IN_WORLD = new Matrix4(); // the identity
const MOST_VIEWS = 40; // cameras
const MOST_AXES = 400; // frames
const SILENCE: ReadonlyMap<string, Sound> = new Map();

export interface MountedSensor extends SceneSensor {
  robot: string;
}

export class OverlayLayers {
  readonly group = new Group();
  readonly frames = new SensorFrames();
  private readonly beams: BeamLayer;
  private readonly points = new PointLayer();
  private readonly lines: LineLayer;
  private readonly trailLines: LineLayer;
  private readonly trails = new Trails();
  private readonly devices = new DeviceLayer();
  private readonly player = new SoundPlayer();
  private readonly radio = new RadioLinks();
  readonly expectations: ExpectationMarks;
  private trailsOf = ""; // name of the scene to which the trails belong
  // By topic. The points are in the sensor's frame; those of CURRENT_CONTACTS_TOPIC are in the
  // world frame.
  private readonly contacts = new Map<string, TouchPoint[]>();
  private bodies: BodyLayer | null = null;
  private sensors = new Map<string, MountedSensor>(); // by topic
  private robots: { name: string; entry: number }[] = [];
  private shown: Shown = FIRST_SHOWN;
  private colours: OverlayColours = FIRST_COLOURS;
  private readonly boxes = new Map<SceneInertial, EquivalentBox>();
  private selection: string | null = null;

  // If `thin` is true, lines are one pixel wide, for browsers without a graphics card.
  constructor(mostBeams: number, thin = false) {
    this.beams = new BeamLayer(mostBeams, thin);
    this.lines = new LineLayer({ widthPx: 2, onTop: true, thin });
    this.trailLines = new LineLayer({ widthPx: 2.5, thin });
    this.expectations = new ExpectationMarks(thin);
    this.group.add(
      this.beams.lines,
      this.points.points,
      this.lines.lines,
      this.trailLines.lines,
      this.devices.group,
      this.expectations.lines,
    );
  }

  setScene(bodies: BodyLayer | null): void {
    this.bodies = bodies;
    const robots = robotsOf(bodies?.scene ?? null);
    const names = new Set(robots.map(({ name }) => name));
    this.sensors = new Map(
      robots.flatMap(({ name, sensors }) =>
        sensors.map((sensor) => [sensor.topic, { ...sensor, robot: name }] as const),
      ),
    );
    this.robots = robots.flatMap(({ name }) => {
      const entry = bodies?.poseEntryOf(name) ?? null;
      return entry === null ? [] : [{ name, entry }];
    });
    this.beams.keepOnly(new Set());
    this.boxes.clear();
    this.radio.clear();
    if (!bodies) return;
    if (bodies.scene.name === this.trailsOf) this.trails.keepOnly(names);
    else this.trails.clear();
    this.trailsOf = bodies.scene.name;
  }

  show(shown: Shown): void {
    this.shown = shown;
  }

  setColours(colours: OverlayColours): void {
    this.colours = colours;
    this.points.colour = colours.points;
  }

  select(robot: string | null): void {
    this.selection = robot;
  }

  takeFrames(message: TransformsMessage): void {
    this.frames.take(message);
  }

  // Shows the points of a lidar or depth camera.
  takePoints(topic: string, points: Points): void {
    this.points.set(topic, points);
  }

  // Shows a reading of a bumper or actuator.
  takeReading(topic: string, message: unknown): void {
    this.devices.take(topic, message);
    this.radio.take(message, performance.now());
    this.contacts.set(topic, topic === CURRENT_CONTACTS_TOPIC ? worldContactsOf(message) : contactsOf(message));
  }

  // Removes the readings of all other topics.
  keepReadings(topics: ReadonlySet<string>): void {
    this.points.keepOnly(topics);
    this.devices.keepOnly(topics);
    for (const topic of [...this.contacts.keys()]) if (!topics.has(topic)) this.contacts.delete(topic);
  }

  // Trails are also recorded while they are hidden, so that they show the past when they are
  // switched on.
  takePoses({ stamp, poses }: PoseSample): void {
    this.trails.push(
      stamp,
      this.robots.map(({ name, entry }) => {
        const at = 7 * entry;
        return { name, x: poses[at]!, y: poses[at + 1]!, z: poses[at + 2]! };
      }),
    );
  }

  // Takes beams. They are relative to the poses that the robots had at the time of measuring.
  takeBeams(beams: readonly RobotBeams[], posesAt: (stamp: number) => Float64Array | null): void {
    for (const each of beams) {
      const poses = posesAt(each.stamp);
      const entry = this.bodies?.poseEntryOf(each.robot) ?? null;
      if (poses && entry !== null) this.beams.setRobot(each, matrixOf(poses, 7 * entry));
    }
  }

  forgetBeams(): void {
    this.beams.keepOnly(new Set());
  }

  // Updates all overlays with the displayed poses of the bodies, for a camera at `eye`.
  place(eye: Vector3): void {
    const { bodies, shown } = this;
    this.beams.lines.visible = shown.beams;
    this.points.points.visible = shown.points;
    this.trailLines.lines.visible = shown.trails;
    this.devices.group.visible = shown.actuators;
    this.player.play(shown.sound ? this.devices.sounds : SILENCE);
    if (!bodies) return;
    if (shown.beams) this.placeBeams(bodies, eye);
    if (shown.points) this.points.place((topic) => this.worldFromSensor(topic, bodies));
    this.drawLines(bodies);
    if (shown.trails) {
      this.trailLines.begin();
      this.trails.draw(this.trailLines, this.colours.trails);
      this.trailLines.finish();
    }
  }

  // The beams of the selected robot have the highest priority, then the beams of the nearest
  // robots.
  private placeBeams(bodies: BodyLayer, eye: Vector3): void {
    const place = new Vector3();
    this.beams.place(
      (robot) => bodies.poseOf(bodies.indexOf(robot)),
      (robot, frame) => (robot === this.selection ? -1 : place.setFromMatrixPosition(frame).distanceToSquared(eye)),
    );
  }

  private drawLines(bodies: BodyLayer): void {
    const { lines, shown } = this;
    lines.begin();
    if (shown.contacts) this.drawContacts(bodies);
    if (shown.cameras) this.drawViews(bodies);
    if (shown.frames) this.drawFrames(bodies);
    if (shown.actuators) this.drawActuators(bodies);
    if (shown.joints) this.drawJoints(bodies);
    if (shown.masses) this.drawMasses(bodies);
    lines.finish();
    lines.lines.visible = lines.segments > 0;
  }

  private drawActuators(bodies: BodyLayer): void {
    this.devices.place((topic) => this.worldFromSensor(topic, bodies), this.lines);
    const poseOf = (robot: string) => bodies.poseOf(bodies.indexOf(robot));
    this.radio.draw(this.lines, poseOf, performance.now());
  }

  private drawContacts(bodies: BodyLayer): void {
    for (const [topic, contacts] of this.contacts) {
      const frame = topic === CURRENT_CONTACTS_TOPIC ? IN_WORLD : this.worldFromSensor(topic, bodies);
      if (frame) for (const contact of contacts) drawContact(this.lines, frame, contact);
    }
  }

  private drawViews(bodies: BodyLayer): void {
    const cameras = [...this.sensors.values()].filter(
      // Selects cameras by the content of their readings (images, or the objects in view), and not
      // by their type.
      ({ robot, overlay, view }) =>
        (overlay === "picture" || view !== null) && (this.selection ?? robot) === robot,
    );
    for (const { topic, view } of cameras.slice(0, MOST_VIEWS)) {
      const frame = this.worldFromSensor(topic, bodies);
      if (frame) drawView(this.lines, frame, view);
    }
  }

  // Draws all axes of the selected robot. If no robot is selected, draws only the robots' own axes.
  private drawFrames(bodies: BodyLayer): void {
    const robots = this.robots.filter(({ name }) => (this.selection ?? name) === name);
    for (const { name } of robots.slice(0, MOST_AXES)) {
      const body = bodies.indexOf(name);
      drawAxes(this.lines, bodies.poseOf(body)!, ROBOT_AXES);
      if (name !== this.selection) continue;
      for (const link of bodies.movingLinksOf(body)) drawAxes(this.lines, link, LINK_AXES);
      for (const sensor of bodies.scene.bodies[body]!.sensors) {
        const frame = this.frames.worldFrom(name, sensor.name, bodies);
        if (frame) drawAxes(this.lines, frame, SENSOR_AXES);
      }
    }
  }

  // Draws the joints of the selected robot. If no robot is selected, draws the joints of all
  // bodies.
  private drawJoints(bodies: BodyLayer): void {
    let left = MOST_AXES;
    bodies.scene.bodies.forEach(({ name, joints }, body) => {
      if ((this.selection ?? name) !== name) return;
      for (const joint of joints.slice(0, left)) {
        const parent = joint.link === null ? bodies.poseOf(body) : bodies.linkPoseOf(body, joint.link);
        if (!parent) continue;
        drawJoint(this.lines, parent.clone().multiply(matrixOf(joint.pose)), joint);
        left -= 1;
      }
    });
  }

  // Draws the masses of the selected robot's links. If no robot is selected, draws the masses of
  // all bodies that can move.
  private drawMasses(bodies: BodyLayer): void {
    let left = MOST_AXES;
    bodies.scene.bodies.forEach(({ name, model, isStatic }, body) => {
      if (isStatic || (this.selection ?? name) !== name) return;
      for (const inertial of (bodies.scene.inertials?.get(model) ?? []).slice(0, left)) {
        const link = bodies.linkPoseOf(body, inertial.link);
        const frame = (link ?? bodies.poseOf(body))!.clone().multiply(matrixOf(link ? inertial.pose : inertial.poseInModel));
        drawMass(this.lines, frame, this.boxOf(inertial));
        left -= 1;
      }
    });
  }

  private boxOf(inertial: SceneInertial): EquivalentBox {
    let box = this.boxes.get(inertial);
    if (!box) this.boxes.set(inertial, (box = equivalentBox(inertial)));
    return box;
  }

  private worldFromSensor(topic: string, bodies: BodyLayer): Matrix4 | null {
    const sensor = this.sensors.get(topic);
    return sensor ? this.frames.worldFrom(sensor.robot, sensor.name, bodies) : null;
  }
}
