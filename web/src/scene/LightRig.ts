// The lights of a scene, as in the robots' cameras (gsv/rendering). As in the world file, an
// intensity of 1 lights a white surface that faces the light to full white. The factor pi cancels
// the division by pi in three.js's reflectance. Light colours are linear, not sRGB.
import type { Box3, Light } from "three";
import {
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
import { FittedShadow } from "./FittedShadow";

const MOST_LOCAL_LIGHTS = 6; // limit, because each light costs time for every pixel
const AMBIENT_FLOOR = 0.3;
export const AMBIENT_FROM_BELOW = 0.55; // fraction of the ambient light from above
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

// Returns the colour of a surface or of the background.
export function colourOf([r, g, b]: Triple): Color {
  return new Color().setRGB(r, g, b, SRGBColorSpace);
}

function lightOf([r, g, b]: Triple): Color {
  return new Color(r, g, b);
}

export class LightRig {
  readonly group = new Group();
  // The shadow of the first sun that casts shadows.
  private readonly shadow: FittedShadow | null = null;

  // `focus` is the part of the world that shadows must cover. If `hasEnvironment` is true, the
  // ambient light comes from the scene's environment map.
  constructor(scene: SceneDescription, focus: Box3, hasEnvironment = false) {
    if (!hasEnvironment) this.group.add(ambient(scene.look.ambient));
    const lights = scene.lights.length > 0 ? scene.lights : [WITHOUT_LIGHTS];
    const suns = lights.filter(({ kind }) => kind === "directional");
    const local = lights.filter(({ kind }) => kind !== "directional").slice(0, MOST_LOCAL_LIGHTS);
    const sphere = focus.getBoundingSphere(new Sphere());
    for (const light of suns) {
      const sun = new DirectionalLight(lightOf(light.colour), light.intensity * Math.PI);
      const direction = new Vector3(...light.direction).normalize();
      sun.position.copy(sphere.center).sub(direction);
      sun.target.position.copy(sphere.center);
      if (scene.look.shadows && light.castShadows && !this.shadow) this.shadow = new FittedShadow(sun, direction, sphere);
      this.group.add(sun, sun.target);
    }
    for (const light of local) {
      const lamp = light.kind === "spot" ? spot(light) : point(light);
      this.group.add(lamp);
      if (lamp instanceof SpotLight) this.group.add(lamp.target);
    }
  }

  // Fits the shadows to the view of a camera at `eye` with this target. Returns whether the shadows
  // must be drawn again.
  fitShadow(eye: Vector3, target: Vector3): boolean {
    return this.shadow?.fit(eye, target) ?? false;
  }

  dispose(): void {
    this.group.traverse((each) => (each as Light).isLight && (each as Light).dispose());
    this.group.removeFromParent();
  }
}

// Ambient light has a minimum. Many worlds define almost none, because other simulators add their
// own.
export function ambientOf(asked: Triple): Color {
  const above = lightOf(asked);
  const brightness = 0.2126 * above.r + 0.7152 * above.g + 0.0722 * above.b;
  if (brightness < AMBIENT_FLOOR) {
    above.lerp(new Color(AMBIENT_FLOOR, AMBIENT_FLOOR, AMBIENT_FLOOR), 1 - brightness / AMBIENT_FLOOR);
  }
  return above;
}

// Returns ambient light that is weaker from below, so that shapes are visible.
function ambient(asked: Triple): HemisphereLight {
  const above = ambientOf(asked);
  const light = new HemisphereLight(above, above, Math.PI);
  light.groundColor.multiplyScalar(AMBIENT_FROM_BELOW);
  light.position.set(0, 0, 1);
  return light;
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
