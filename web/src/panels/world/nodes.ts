// The nodes in the tree of the world: bodies with their links, joints and sensors, and transforms.
import type { SceneBody, SceneDescription, SceneJoint, SceneSensor } from "../../api/scene";
import type { WorldPart } from "../../state/worldPart";
import { bodyPart } from "../../state/parts";

export type WorldNode =
  | { kind: "body"; body: SceneBody }
  | { kind: "link"; body: SceneBody; name: string }
  | { kind: "joint"; body: SceneBody; joint: SceneJoint }
  | { kind: "sensor"; body: SceneBody; sensor: SceneSensor }
  | { kind: "transform"; child: string };

// Returns the ID of a node. The same part has the same ID in a later scene.
export function nodeId(node: WorldNode): string {
  switch (node.kind) {
    case "body":
      return node.body.name;
    case "link":
      return `${node.body.name}::link::${node.name}`;
    case "joint":
      return `${node.body.name}::joint::${node.joint.name}`;
    case "sensor":
      return `${node.body.name}::sensor::${node.sensor.name}`;
    case "transform":
      return `tf::${node.child}`;
  }
}

// Returns the node of the selected part. Null if the scene has no such part.
export function nodeOf(scene: SceneDescription | null, part: WorldPart | null): WorldNode | null {
  const body = part && scene?.bodies.find(({ name }) => name === part.body);
  if (!body) return null;
  const { kind, name } = part;
  if (kind === "body") return { kind, body };
  if (kind === "link") return body.links.includes(name) ? { kind, body, name } : null;
  if (kind === "joint") {
    const joint = body.joints.find((each) => each.name === name);
    return joint ? { kind, body, joint } : null;
  }
  const sensor = body.sensors.find((each) => each.name === name);
  return sensor ? { kind, body, sensor } : null;
}

// Returns null for a transform, because it is not a part of the scene.
export function partOf(node: WorldNode): WorldPart | null {
  switch (node.kind) {
    case "body":
      return bodyPart(node.body.name);
    case "link":
      return { body: node.body.name, kind: "link", name: node.name };
    case "joint":
      return { body: node.body.name, kind: "joint", name: node.joint.name };
    case "sensor":
      return { body: node.body.name, kind: "sensor", name: node.sensor.name };
    case "transform":
      return null;
  }
}

export function kindOf(body: SceneBody): string {
  if (body.isAvatar) return "avatar";
  if (body.isRobot) return "robot";
  if (body.isStation) return "station";
  return body.isStatic ? "static" : "dynamic";
}

// Returns the bodies with `text` in their name, or in the name of a link, joint or sensor. They
// are ordered by kind (robots, avatars, sensor stations, dynamic bodies, static bodies), then by
// name.
export function bodiesOf(scene: SceneDescription | null, text: string): SceneBody[] {
  const order = ["robot", "avatar", "station", "dynamic", "static"];
  const wanted = text.trim().toLowerCase();
  const names = ({ name, links, joints, sensors }: SceneBody) => [name, ...links, ...joints.map((each) => each.name), ...sensors.map((each) => each.name)];
  const fits = (body: SceneBody) => wanted === "" || names(body).some((name) => name.toLowerCase().includes(wanted));
  return (scene?.bodies ?? [])
    .filter(fits)
    .sort((a, b) => order.indexOf(kindOf(a)) - order.indexOf(kindOf(b)) || a.name.localeCompare(b.name));
}
