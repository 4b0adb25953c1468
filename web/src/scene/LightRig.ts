// The lights of a scene, as in the robots' cameras (gsv/rendering). An intensity of 1 lights a
// white surface that faces the light to full white, as in the world file. Therefore the factor pi,
// which cancels the one in three's reflectance. Light colours are linear, not sRGB.
import type { Light } from "three";
import {
  Box3,
  Color,
  DirectionalLight,
  Group,
  HemisphereLight,
  PointLight,
  Sphere,
  SpotLight,
  SRGBColorSpace,
  Vector3,
} from "three";
import type { SceneDescription, SceneLight, Triple } from "../api/scene";

const MOST_LOCAL_LIGHTS = 6; // each costs every pixel
const SMALL_SHADOW_MAP = 1024; // texels; enough for a room
const LARGE_SHADOW_MAP = 2048;
const ROOM_RADIUS = 12; // m
const LARGEST_SHADOWED_RADIUS = 40; // m: beyond, a shadow map's texel is wider than a robot's wheel
const AMBIENT_FLOOR = 0.3;
const AMBIENT_FROM_BELOW = 0.55;
const WITHOUT_LIGHTS: SceneLight = {
  name: "",
  kind: "directional",
  position: [0, 0, 10],
  direction: [-0.4, 0.3, -0.87],
  colour: [0.9, 0.88, 0.84],
  intensity: 1,
  range: 0,
  innerAngle: 0,
  outerAngle: 0,
  castShadows: true,
};

// The colour of a surface or of the background.
export function colourOf([r, g, b]: Triple): Color {
  return new Color().setRGB(r, g, b, SRGBColorSpace);
}

function lightOf([r, g, b]: Triple): Color {
  return new Color(r, g, b);
}

// `focus`: the part of the world that shadows must cover.
export function makeLights(scene: SceneDescription, focus: Box3): Group {
  const group = new Group();
  group.add(ambient(scene.look.ambient));
  const lights = scene.lights.length > 0 ? scene.lights : [WITHOUT_LIGHTS];
  const suns = lights.filter(({ kind }) => kind === "directional");
  const local = lights.filter(({ kind }) => kind !== "directional").slice(0, MOST_LOCAL_LIGHTS);
  let hasShadow = false;
  for (const light of suns) {
    const sun = directional(light, focus);
    // There is one shadow map, for the first sun that requests it.
    sun.castShadow = scene.look.shadows && light.castShadows && !hasShadow;
    hasShadow ||= sun.castShadow;
    group.add(sun, sun.target);
  }
  for (const light of local) {
    const lamp = light.kind === "spot" ? spot(light) : point(light);
    group.add(lamp);
    if (lamp instanceof SpotLight) group.add(lamp.target);
  }
  return group;
}

export function disposeLights(group: Group): void {
  group.traverse((each) => (each as Light).isLight && (each as Light).dispose());
  group.removeFromParent();
}

// Ambient light, weaker from below, so that shapes are visible. It has a minimum, because many
// worlds define almost none: their authors' tools add their own.
function ambient(asked: Triple): HemisphereLight {
  const above = lightOf(asked);
  const brightness = 0.2126 * above.r + 0.7152 * above.g + 0.0722 * above.b;
  if (brightness < AMBIENT_FLOOR) {
    above.lerp(new Color(AMBIENT_FLOOR, AMBIENT_FLOOR, AMBIENT_FLOOR), 1 - brightness / AMBIENT_FLOOR);
  }
  const light = new HemisphereLight(above, above, Math.PI);
  light.groundColor.multiplyScalar(AMBIENT_FROM_BELOW);
  light.position.set(0, 0, 1);
  return light;
}

function directional(light: SceneLight, focus: Box3): DirectionalLight {
  const sun = new DirectionalLight(lightOf(light.colour), light.intensity * Math.PI);
  const sphere = focus.getBoundingSphere(new Sphere());
  const radius = Math.min(LARGEST_SHADOWED_RADIUS, Math.max(1, sphere.radius));
  sun.target.position.copy(sphere.center);
  sun.position.copy(sphere.center).addScaledVector(new Vector3(...light.direction).normalize(), -2 * radius);
  const texels = radius <= ROOM_RADIUS ? SMALL_SHADOW_MAP : LARGE_SHADOW_MAP;
  sun.shadow.mapSize.set(texels, texels);
  const { camera } = sun.shadow;
  camera.left = camera.bottom = -radius;
  camera.right = camera.top = radius;
  camera.near = 0.1;
  camera.far = 4 * radius;
  // An offset of one texel along the normal prevents surfaces from shading themselves.
  sun.shadow.normalBias = (2 * radius * 1.5) / texels;
  sun.shadow.bias = -0.0004;
  return sun;
}

function point(light: SceneLight): PointLight {
  const lamp = new PointLight(lightOf(light.colour), light.intensity * Math.PI, light.range, 1);
  lamp.position.set(...light.position);
  return lamp;
}

function spot(light: SceneLight): SpotLight {
  const lamp = new SpotLight(
    lightOf(light.colour),
    light.intensity * Math.PI,
    light.range,
    Math.min(Math.PI / 2, light.outerAngle / 2),
    light.outerAngle > 0 ? 1 - Math.min(1, light.innerAngle / light.outerAngle) : 0,
    1,
  );
  lamp.position.set(...light.position);
  lamp.target.position.set(...light.position).add(new Vector3(...light.direction));
  return lamp;
}
