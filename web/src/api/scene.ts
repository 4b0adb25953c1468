// The scene of a simulation: its bodies, its lights, and the meaning of each entry of /gsv/poses.
// Metres, radians, z up. A pose has seven numbers: x y z qx qy qz qw.
import type { Units } from "../live/values";
import type { JsonObject } from "./json";
import { listAt, numberAt, numberOr, numbersAt, objectAt, textAt, textOr } from "./json";

export type Triple = [number, number, number];
export type PoseNumbers = number[]; // seven

export interface SceneLight {
  name: string;
  kind: "directional" | "point" | "spot";
  position: Triple;
  direction: Triple; // in the world frame
  colour: Triple; // sRGB
  intensity: number;
  range: number;
  innerAngle: number;
  outerAngle: number;
  castShadows: boolean;
}

export type Overlay = "none" | "lines" | "points" | "picture";

// The field of view of a camera in radians, and the aspect ratio (width by height).
export interface CameraView {
  horizontalFov: number;
  aspect: number;
}

// A sensor of a body: its topic, its type, and where it is mounted.
export interface SceneSensor {
  name: string;
  type: string;
  overlay: Overlay;
  link: string;
  topic: string;
  view: CameraView | null; // null if the sensor is not a camera, or if its angles are unknown
  units?: Units; // absent in recordings of versions without units
  pose?: PoseNumbers; // in the frame of its link
  parameters?: Readonly<Record<string, string | number | boolean>>; // as in the model file; absent in old recordings
}

// A body: a robot, an avatar, or another object.
export interface SceneBody {
  name: string;
  model: string; // the identifier with which its shape is fetched
  isStatic: boolean;
  isFixed: boolean; // a static body of the world file, which cannot be moved or removed
  isRobot: boolean;
  hasDrive: boolean; // false for a robot whose base does not move, such as an arm
  isOfWorld: boolean; // a robot of the world file, without a model file of its own
  isAvatar: boolean;
  isStation: boolean; // an object with sensors and without a drive
  pose: PoseNumbers;
  links: string[];
  sensors: SceneSensor[];
  collisions: string | null; // the identifier with which its collision shapes are fetched; null if there are none
  joints: SceneJoint[]; // only joints that can move
}

export interface SceneJoint {
  name: string;
  kind: string; // "revolute", "prismatic", …
  link: string | null; // the link in whose frame the pose is; null for the body's frame
  pose: PoseNumbers;
  axis: Triple; // in the frame of the joint
}

// The mass of a link.
export interface SceneInertial {
  link: string;
  mass: number; // kg
  pose: PoseNumbers; // pose of the frame of `inertia` (origin: centre of mass) relative to the link
  poseInModel: PoseNumbers; // the same pose relative to the model, at zero joint positions
  inertia: readonly [number, number, number, number, number, number]; // kg m²: ixx iyy izz ixy ixz iyz
}

// The meaning of one pose in /gsv/poses: the pose of a body or of a link.
export interface PoseEntry {
  body: number;
  link: string | null; // null for the pose of the body itself
}

export interface SceneDescription {
  layoutVersion: number;
  name: string;
  bounds: { min: Triple; max: Triple };
  look: { ambient: Triple; background: Triple; shadows: boolean; sky: boolean };
  lights: SceneLight[];
  bodies: SceneBody[];
  poses: PoseEntry[];
  inertials?: ReadonlyMap<string, readonly SceneInertial[]>; // by model; absent in old recordings
}

export function parseScene(json: unknown): SceneDescription {
  const scene = objectAt(json, "scene");
  const bounds = objectAt(scene.bounds, "bounds");
  const look = objectAt(scene.look, "look");
  const parameters = Array.isArray(scene.sensor_parameters) ? scene.sensor_parameters.map(parseParameters) : [];
  const bodies = listAt(scene.bodies, "bodies").map((body, i) => parseBody(body, `bodies[${i}]`, parameters));
  return {
    layoutVersion: numberAt(scene.layout_version, "layout_version"),
    name: textOr(scene.name, ""),
    bounds: { min: triple(bounds.min, "bounds.min"), max: triple(bounds.max, "bounds.max") },
    look: {
      ambient: triple(look.ambient, "look.ambient"),
      background: triple(look.background, "look.background"),
      shadows: look.shadows !== false,
      sky: look.sky === true,
    },
    lights: listAt(scene.lights, "lights").map((light, i) => parseLight(light, `lights[${i}]`)),
    bodies,
    poses: listAt(scene.poses, "poses").map((entry, i) =>
      parsePoseEntry(entry, bodies.length, `poses[${i}]`),
    ),
    inertials: parseInertials(scene.inertials),
  };
}

// The robots, avatars and stations.
export function robotsOf(scene: SceneDescription | null): readonly SceneBody[] {
  return scene ? robotsOfScene(scene) : [];
}

const robotsOfScene = oncePerScene((scene) => scene.bodies.filter(hasAgent));

// Caches the result per scene. A scene never changes, and the computation takes a long time for a
// thousand robots.
function oncePerScene<Result>(compute: (scene: SceneDescription) => Result): (scene: SceneDescription) => Result {
  const known = new WeakMap<SceneDescription, { result: Result }>();
  return (scene) => {
    let found = known.get(scene);
    if (!found) known.set(scene, (found = { result: compute(scene) }));
    return found.result;
  };
}

export function hasAgent({ isRobot, isAvatar, isStation }: SceneBody): boolean {
  return isRobot || isAvatar || isStation;
}

// A camera that can be shown.
export interface CameraChoice {
  robot: string;
  sensor: string;
  topic: string;
}

export function camerasOf(scene: SceneDescription | null): readonly CameraChoice[] {
  return scene ? camerasOfScene(scene) : [];
}

const camerasOfScene = oncePerScene((scene) =>
  robotsOf(scene).flatMap((body) =>
    body.sensors
      .filter((sensor) => sensor.overlay === "picture")
      .map((sensor) => ({ robot: body.name, sensor: sensor.name, topic: sensor.topic })),
  ),
);

// The cameras, followed by the depth cameras. The point clouds of depth cameras are shown as depth
// images.
export function imagesOf(scene: SceneDescription | null): readonly CameraChoice[] {
  return scene ? imagesOfScene(scene) : [];
}

const imagesOfScene = oncePerScene((scene) => [
  ...camerasOf(scene),
  ...robotsOf(scene).flatMap(({ name, sensors }) =>
    sensors.filter(({ type }) => type === "depth_camera").map(({ name: sensor, topic }) => ({ robot: name, sensor, topic })),
  ),
]);

function parseBody(value: unknown, where: string, parameters: readonly SceneSensor["parameters"][]): SceneBody {
  const body = objectAt(value, where);
  return {
    name: textAt(body.name, `${where}.name`),
    model: textAt(body.model, `${where}.model`),
    isStatic: body.is_static === true,
    isFixed: body.is_static === true && body.is_fixed !== false,
    isRobot: body.is_robot === true,
    hasDrive: body.has_drive !== false,
    isOfWorld: body.is_of_world === true,
    isAvatar: body.is_avatar === true,
    isStation: body.is_station === true,
    pose: numbersAt(body.pose, 7, `${where}.pose`),
    links: listAt(body.links ?? [], `${where}.links`).map((link) => textAt(link, `${where}.links`)),
    sensors: listAt(body.sensors ?? [], `${where}.sensors`).map((sensor, i) =>
      parseSensor(objectAt(sensor, `${where}.sensors[${i}]`), `${where}.sensors[${i}]`, parameters),
    ),
    collisions: textOr(body.collisions, "") || null,
    joints: listAt(body.joints ?? [], `${where}.joints`).map((joint, i) =>
      parseJoint(objectAt(joint, `${where}.joints[${i}]`), `${where}.joints[${i}]`),
    ),
  };
}

function parseJoint(joint: JsonObject, where: string): SceneJoint {
  return {
    name: textOr(joint.name, ""),
    kind: textOr(joint.kind, ""),
    link: typeof joint.link === "string" ? joint.link : null,
    pose: numbersAt(joint.pose, 7, `${where}.pose`),
    axis: triple(joint.axis, `${where}.axis`),
  };
}

function parseInertials(value: unknown): SceneDescription["inertials"] {
  const models = typeof value === "object" && value !== null ? Object.entries(value) : [];
  return new Map(
    models.map(([model, links]) => [
      model,
      listAt(links, `inertials.${model}`).map((link, i) => parseInertial(link, `inertials.${model}[${i}]`)),
    ]),
  );
}

function parseInertial(value: unknown, where: string): SceneInertial {
  const inertial = objectAt(value, where);
  return {
    link: textAt(inertial.link, `${where}.link`),
    mass: numberAt(inertial.mass_kg, `${where}.mass_kg`),
    pose: numbersAt(inertial.pose, 7, `${where}.pose`),
    poseInModel: numbersAt(inertial.pose_in_model, 7, `${where}.pose_in_model`),
    inertia: numbersAt(inertial.inertia_kg_m2, 6, `${where}.inertia_kg_m2`) as unknown as SceneInertial["inertia"],
  };
}

// A parameter is a number, a flag or a text. The server writes nothing else.
function parseParameters(value: unknown): SceneSensor["parameters"] {
  const entries = typeof value === "object" && value !== null ? Object.entries(value) : [];
  return Object.fromEntries(entries.filter(([, each]) => ["number", "boolean", "string"].includes(typeof each)));
}

function parseSensor(sensor: JsonObject, where: string, parameters: readonly SceneSensor["parameters"][]): SceneSensor {
  const overlay = textOr(sensor.overlay, "none");
  return {
    name: textAt(sensor.name, `${where}.name`),
    type: textOr(sensor.type, ""),
    overlay: overlay === "lines" || overlay === "points" || overlay === "picture" ? overlay : "none",
    link: textOr(sensor.link, ""),
    topic: textAt(sensor.topic, `${where}.topic`),
    view: parseView(sensor),
    units: parseUnits(sensor.units),
    ...(Array.isArray(sensor.pose) && { pose: numbersAt(sensor.pose, 7, `${where}.pose`) }),
    ...(typeof sensor.parameters === "number" && { parameters: parameters[sensor.parameters] ?? {} }),
  };
}

function parseUnits(value: unknown): Units {
  const entries = typeof value === "object" && value !== null ? Object.entries(value) : [];
  return Object.fromEntries(entries.filter(([, unit]) => typeof unit === "string"));
}

function parseView(sensor: JsonObject): CameraView | null {
  const horizontalFov = numberOr(sensor.horizontal_fov_rad, 0);
  const aspect = numberOr(sensor.aspect_ratio, 0);
  return horizontalFov > 0 && horizontalFov < Math.PI && aspect > 0 ? { horizontalFov, aspect } : null;
}

function parseLight(value: unknown, where: string): SceneLight {
  const light = objectAt(value, where);
  const kind = textAt(light.kind, `${where}.kind`);
  if (kind !== "directional" && kind !== "point" && kind !== "spot") {
    throw new Error(`${where}.kind: expected directional, point or spot, found ${kind}`);
  }
  const pose = numbersAt(light.pose, 7, `${where}.pose`);
  return {
    name: textOr(light.name, ""),
    kind,
    position: pose.slice(0, 3) as Triple,
    direction: triple(light.direction, `${where}.direction`),
    colour: triple(light.colour, `${where}.colour`),
    intensity: numberOr(light.intensity, 1),
    range: numberOr(light.range_m, 0),
    innerAngle: numberOr(light.inner_angle_rad, 0),
    outerAngle: numberOr(light.outer_angle_rad, 0.8),
    castShadows: light.cast_shadows === true,
  };
}

function parsePoseEntry(value: unknown, bodies: number, where: string): PoseEntry {
  const entry = objectAt(value, where);
  const body = numberAt(entry.body, `${where}.body`);
  if (!Number.isInteger(body) || body < 0 || body >= bodies) {
    throw new Error(`${where}.body: expected a body index from 0 to ${bodies - 1}, found ${body}`);
  }
  return { body, link: typeof entry.link === "string" ? entry.link : null };
}

function triple(value: unknown, where: string): Triple {
  return numbersAt(value, 3, where) as Triple;
}
