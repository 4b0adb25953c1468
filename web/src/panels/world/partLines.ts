// The facts about a part of the world, as lines of an inspector.
import type { SceneBody, SceneDescription, SceneSensor } from "../../api/scene";
import { anglesOf } from "../../live/values";
import type { PosesMessage, TransformsMessage } from "../../protocol/messages";
import { seconds } from "../../protocol/messages";
import type { MaterialFacts, VisualFacts } from "../../api/visuals";
import { formatNumber } from "../../ui/format";
import { kindOf } from "./nodes";

export type Line = [name: string, value: string];

const DEGREES = 180 / Math.PI;
const MAX_ENTRIES = 8; // maximum number of shapes or materials that are listed

export function positionText(position: readonly number[]): string {
  return `${position.map((value) => formatNumber(value, 3)).join(", ")} m`;
}

export function orientationText({ roll, pitch, yaw }: { roll: number; pitch: number; yaw: number }): string {
  return `${[roll, pitch, yaw].map((value) => formatNumber(value * DEGREES, 1)).join(", ")} ° (roll, pitch, yaw)`;
}

export function factsOf(body: SceneBody, link: string | null): Line[] {
  if (link !== null) return [["Of", body.name]];
  return [
    ["Kind", kindOf(body)],
    ["Links", String(body.links.length)],
    ["Joints", String(body.joints.length)],
    ["Sensors", String(body.sensors.length)],
  ];
}

// Returns the lines about the pose of a body or of one of its links, in the world. A link that has
// no pose in the message moves together with its model. A static body keeps its initial pose.
export function poseLines(scene: SceneDescription | null, message: PosesMessage | null, body: SceneBody, link: string | null, now: number): Line[] {
  const entry = scene?.poses.findIndex((each) => scene.bodies[each.body]?.name === body.name && each.link === link) ?? -1;
  const isFresh = message !== null && scene?.layoutVersion === message.layout_version && entry >= 0;
  if (link !== null && entry < 0) return [["Pose", "does not move relative to the model"]];
  const pose = isFresh ? Array.from(message.poses.subarray(7 * entry, 7 * entry + 7)) : link === null ? body.pose : null;
  if (!pose || pose.length < 7) return [];
  const [x, y, z, qx, qy, qz, qw] = pose as [number, number, number, number, number, number, number];
  const lines: Line[] = [
    ["Position", positionText([x, y, z])],
    ["Orientation", orientationText(anglesOf({ x: qx, y: qy, z: qz, w: qw }))],
  ];
  return isFresh ? [...lines, ["Age", `${Math.max(0, now - seconds(message.stamp)).toFixed(2)} s`]] : lines;
}

export function massLines(scene: SceneDescription | null, body: SceneBody, link: string | null): Line[] {
  if (body.isStatic) return [["Mass", "none: the object is static and does not move"]];
  const known = scene?.inertials?.get(body.model);
  if (!known) return [];
  const meant = known.filter((each) => link === null || each.link === link);
  const mass = meant.reduce((sum, each) => sum + each.mass, 0);
  if (link === null || meant.length === 0) return [["Mass", `${numberText(mass)} kg`]];
  const { pose, inertia } = meant[0]!;
  return [
    ["Mass", `${numberText(mass)} kg`],
    ["Centre of mass", `${positionText(pose.slice(0, 3))} in the link`],
    ["Moments of inertia", `${inertia.slice(0, 3).map(numberText).join(", ")} kg m² (ixx, iyy, izz)`],
  ];
}

export function visualLines(visuals: readonly VisualFacts[]): Line[] {
  const materials = [...new Set(visuals.flatMap((visual) => visual.materials).map(materialText))];
  return [
    ["Geometry", listText(visuals.map(({ shape }) => shapeText(shape)))],
    ...(materials.length > 0 ? [["Material", listText(materials)] as Line] : []),
  ];
}

export function collisionLines(collisions: readonly VisualFacts[]): Line[] {
  return [["Collision", listText(collisions.map(({ shape }) => shapeText(shape)))]];
}

// The sensor with its parameters, in the units of SDFormat: metres, radians and hertz.
export function sensorLines(body: SceneBody, sensor: SceneSensor): Line[] {
  const parameters = Object.entries(sensor.parameters ?? {});
  return [
    ["Of", body.name],
    ["Type", sensor.type.replaceAll("_", " ")],
    ["Link", sensor.link],
    ["Topic", sensor.topic],
    ...(sensor.pose ? poseInLink(sensor.pose) : []),
    ...parameters.map(([name, value]): Line => [name === "update_rate" ? "Update rate" : `Parameter ${name}`, parameterText(name, value)]),
  ];
}

function poseInLink([x, y, z, qx, qy, qz, qw]: readonly number[]): Line[] {
  const angles = anglesOf({ x: qx!, y: qy!, z: qz!, w: qw! });
  return [
    ["Position in the link", positionText([x!, y!, z!])],
    ["Orientation in the link", orientationText(angles)],
  ];
}

// The transform of the sensor in /tf_static.
export function mountLines({ transforms }: TransformsMessage, body: SceneBody, sensor: SceneSensor): Line[] {
  const found = transforms.find(({ child_frame_id: child }) => child === `${body.name}/${sensor.name}`);
  if (!found) return [];
  const { x, y, z } = found.transform.translation;
  return [["Transform", `${positionText([x, y, z])} in ${found.header.frame_id}, static`]];
}

// Returns a text such as "box, 1 × 2 × 3 m", "cylinder, radius 0.5 m, length 1 m", "mesh, 1 × 1 × 2
// m, 1,204 triangles".
export function shapeText(shape: VisualFacts["shape"]): string {
  const { kind, size, radius, length, radii, triangles } = shape;
  const parts = [
    typeof kind === "string" ? kind : "unknown",
    Array.isArray(size) && `${size.map(numberText).join(" × ")} m`,
    typeof radius === "number" && `radius ${numberText(radius)} m`,
    typeof length === "number" && `length ${numberText(length)} m`,
    Array.isArray(radii) && `radii ${radii.map(numberText).join(", ")} m`,
    typeof triangles === "number" && `${triangles.toLocaleString("en")} triangles`,
  ];
  return parts.filter((part) => part !== false).join(", ");
}

export function materialText({ colour, opacity, metalness, roughness, maps }: MaterialFacts): string {
  const parts = [
    colour,
    opacity < 1 && `opacity ${numberText(opacity)}`,
    `metalness ${numberText(metalness)}`,
    `roughness ${numberText(roughness)}`,
    maps.length > 0 && `maps of ${maps.join(", ")}`,
  ];
  return parts.filter((part) => part !== false).join(", ");
}

// Equal entries are counted: "box, 1 × 1 × 1 m (4 times)".
function listText(entries: readonly string[]): string {
  if (entries.length === 0) return "none";
  const counts = new Map<string, number>();
  for (const entry of entries) counts.set(entry, (counts.get(entry) ?? 0) + 1);
  const texts = [...counts].map(([entry, times]) => (times === 1 ? entry : `${entry} (${times} times)`));
  const left = texts.length - MAX_ENTRIES;
  return [...texts.slice(0, MAX_ENTRIES), ...(left > 0 ? [`and ${left} more`] : [])].join("\n");
}

// Writes at most four digits after the point, without zeros at the end.
function numberText(value: unknown): string {
  return typeof value === "number" ? String(Number(value.toFixed(4))) : "?";
}

function parameterText(name: string, value: string | number | boolean): string {
  if (name === "update_rate") return `${value} Hz`;
  return typeof value === "number" ? String(Number(value.toPrecision(6))) : String(value);
}
