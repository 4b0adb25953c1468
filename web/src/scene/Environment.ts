// The environment map lights the scene from all directions. Smooth and metallic surfaces reflect
// it. It is a sky with bright windows over a darker ground. The page computes it, and the graphics
// filter it once (PMREM). On diffuse surfaces, it is as bright as the world's ambient light. From
// above, it has the colour of the ambient light. From below, it is darker.
import type { Scene, WebGLRenderer, WebGLRenderTarget } from "three";
import { BackSide, Color, Float32BufferAttribute, Mesh, MeshBasicMaterial, PMREMGenerator, Scene as EnvironmentScene, SphereGeometry, Vector3 } from "three";
import type { SceneDescription } from "../api/scene";
import { AMBIENT_FROM_BELOW, ambientOf, colourOf } from "./LightRig";
import { shadesOfSky } from "./Sky";

type Look = SceneDescription["look"];

const SIZE_PX = 128; // side of a face of the cube map
const TINT = 0.5; // fraction of the light that has the sky's colour; the rest is white
const WINDOWS = 5; // number of windows around the horizon
const WINDOW_RADIANCE = 3; // as a multiple of the sky's radiance
// A window reaches from this z coordinate of the unit direction up to HIGHEST_WINDOW.
const LOWEST_WINDOW = 0.25;
const HIGHEST_WINDOW = 0.75;
const SAMPLES = 64; // samples around a hemisphere; half as many from its rim to its pole

export class Environment {
  private target: WebGLRenderTarget | null = null;
  private look: Look | null = null;

  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly scene: Scene,
  ) {}

  // Lights the scene as `look` describes.
  show(look: Look): void {
    const isSame = this.look !== null && JSON.stringify(look) === JSON.stringify(this.look);
    this.look = look;
    if (!isSame || !this.target) this.renew();
  }

  // Computes the map again. Call this when the browser has restored WebGL.
  renew(): void {
    if (!this.look) return;
    this.target?.dispose();
    this.target = filtered(this.renderer, radianceOf(this.look));
    this.scene.environment = this.target.texture;
  }
}

type Radiance = (direction: Vector3, out: Color) => Color;

// Returns a function that computes the light (radiance) from a direction: a unit vector, z up.
export function radianceOf(look: Look): Radiance {
  const above = ambientOf(look.ambient);
  const { zenith, horizon } = shadesOfSky(look.sky ? null : colourOf(look.background));
  const white = new Color(1, 1, 1);
  const [top, side] = [zenith, horizon].map((shade) => white.clone().lerp(shade.clone().multiplyScalar(1 / brightness(shade)), TINT)) as [Color, Color];
  const sky: Radiance = (direction, out) =>
    out.lerpColors(side, top, Math.sqrt(Math.max(0, direction.z))).multiplyScalar(1 + (WINDOW_RADIANCE - 1) * windowAt(direction));
  const mean = meanOf(sky);
  return (direction, out) => {
    if (direction.z < 0) return out.copy(above).multiplyScalar(AMBIENT_FROM_BELOW);
    sky(direction, out);
    return out.setRGB((out.r * above.r) / mean.r, (out.g * above.g) / mean.g, (out.b * above.b) / mean.b);
  };
}

// Returns the light that a white diffuse surface reflects if it faces up (`sign` 1) or down (-1).
export function meanOf(radiance: Radiance, sign = 1): Color {
  const sum = new Color(0, 0, 0);
  const one = new Color();
  const direction = new Vector3();
  const rings = SAMPLES / 2;
  for (let ring = 0; ring < rings; ring++) {
    const z = Math.sqrt((ring + 0.5) / rings); // each ring receives an equal part of the light
    for (let i = 0; i < SAMPLES; i++) {
      direction.setFromCylindricalCoords(Math.sqrt(1 - z * z), (2 * Math.PI * (i + 0.5)) / SAMPLES, 0);
      direction.set(direction.x, direction.z, sign * z);
      sum.add(radiance(direction, one));
    }
  }
  return sum.multiplyScalar(1 / (rings * SAMPLES));
}

// Returns 1 inside a window and 0 outside of it, with soft edges.
function windowAt({ x, y, z }: Vector3): number {
  const across = smooth(0.1, 0.3, Math.sin(WINDOWS * Math.atan2(y, x)));
  return across * smooth(LOWEST_WINDOW - 0.05, LOWEST_WINDOW + 0.05, z) * smooth(HIGHEST_WINDOW + 0.05, HIGHEST_WINDOW - 0.05, z);
}

function smooth(from: number, to: number, value: number): number {
  const part = Math.min(1, Math.max(0, (value - from) / (to - from)));
  return part * part * (3 - 2 * part);
}

function brightness({ r, g, b }: Color): number {
  return Math.max(1e-3, 0.2126 * r + 0.7152 * g + 0.0722 * b);
}

function filtered(renderer: WebGLRenderer, radiance: Radiance): WebGLRenderTarget {
  const sphere = new SphereGeometry(1, 96, 64).rotateX(Math.PI / 2);
  const positions = sphere.getAttribute("position");
  const colours = new Float32Array(3 * positions.count);
  const direction = new Vector3();
  const colour = new Color();
  for (let i = 0; i < positions.count; i++) {
    radiance(direction.fromBufferAttribute(positions, i).normalize(), colour).toArray(colours, 3 * i);
  }
  sphere.setAttribute("color", new Float32BufferAttribute(colours, 3));
  const material = new MeshBasicMaterial({ side: BackSide, vertexColors: true, toneMapped: false, depthTest: false });
  const generator = new PMREMGenerator(renderer);
  const target = generator.fromScene(new EnvironmentScene().add(new Mesh(sphere, material)), 0, 0.1, 10, { size: SIZE_PX });
  generator.dispose();
  sphere.dispose();
  material.dispose();
  return target;
}
