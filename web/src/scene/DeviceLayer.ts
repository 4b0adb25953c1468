// Draws the state of actuators at their places: lamps glow and light their surroundings, speakers
// emit rings, and grippers show their fingers.
import type { Matrix4 } from "three";
import {
  AdditiveBlending,
  CanvasTexture,
  Color,
  Group,
  Mesh,
  MeshBasicMaterial,
  PointLight,
  SphereGeometry,
  SpotLight,
  Sprite,
  SpriteMaterial,
  SRGBColorSpace,
} from "three";
import type { Glow, Jaws, Sound } from "../live/devices";
import { glowOf, jawsOf, soundOf } from "../live/devices";
import type { LineLayer } from "./LineLayer";
import { rgb } from "./LineLayer";

// Maximum number of lights of each kind. Each light costs time for every pixel.
const MOST_LIGHTS = 4;
const HALO = 10; // radii
const SOUND_COLOUR = rgb(0x00a7b5);
const EMPTY_COLOUR = rgb(0xf2b90f);
const HOLDING_COLOUR = rgb(0x1f9d3a);
const RINGS = 3;
const RING_SEGMENTS = 32;
const RING_SPEED = 0.6; // m/s: much slower than sound, so that it can be seen
const RING_REACH = 0.6; // m, at full volume

interface Lamp {
  ball: Mesh<SphereGeometry, MeshBasicMaterial>;
  halo: Sprite;
}

export class DeviceLayer {
  readonly group = new Group();
  readonly sounds = new Map<string, Sound>(); // by topic
  private readonly jaws = new Map<string, Jaws>(); // by topic
  private readonly glows = new Map<string, Glow>(); // by topic
  // lamps are reused, so their number is the maximum number of lamps that were on at once
  private readonly lamps: Lamp[] = [];
  private readonly points: PointLight[] = [];
  private readonly spots: SpotLight[] = [];
  private readonly ball = new SphereGeometry(1, 16, 12);
  private halo: CanvasTexture | null = null;

  take(topic: string, message: unknown): void {
    keep(this.glows, topic, glowOf(message));
    keep(this.sounds, topic, soundOf(message));
    keep(this.jaws, topic, jawsOf(message));
  }

  keepOnly(topics: ReadonlySet<string>): void {
    for (const map of [this.glows, this.sounds, this.jaws]) {
      for (const topic of [...map.keys()]) if (!topics.has(topic)) map.delete(topic);
    }
  }

  // Moves lamps with the displayed sensors, and draws rings and fingers.
  place(worldFromSensor: (topic: string) => Matrix4 | null, lines: LineLayer): void {
    const lit = [...this.glows].flatMap(([topic, glow]) => {
      const frame = worldFromSensor(topic);
      return frame ? [{ glow, frame }] : [];
    });
    while (this.lamps.length < lit.length) this.lamps.push(this.makeLamp());
    this.lamps.forEach((lamp, i) => placeLamp(lamp, lit[i]));
    const lighting = lit.filter(({ glow }) => glow.range > 0);
    const isSpot = ({ glow }: { glow: Glow }) => glow.angle < 2 * Math.PI;
    this.placePoints(lighting.filter((each) => !isSpot(each)));
    this.placeSpots(lighting.filter(isSpot));
    for (const [topic, sound] of this.sounds) {
      const frame = worldFromSensor(topic);
      if (frame) drawRings(lines, frame, sound);
    }
    for (const [topic, jaws] of this.jaws) {
      const frame = worldFromSensor(topic);
      if (frame) drawJaws(lines, frame, jaws);
    }
  }

  private makeLamp(): Lamp {
    const ball = new Mesh(this.ball, new MeshBasicMaterial({ toneMapped: false }));
    const halo = new Sprite(
      new SpriteMaterial({ map: this.haloTexture(), blending: AdditiveBlending, depthWrite: false }),
    );
    ball.raycast = halo.raycast = () => {};
    this.group.add(ball, halo);
    return { ball, halo };
  }

  private haloTexture(): CanvasTexture | null {
    if (this.halo || typeof document === "undefined") return this.halo;
    const canvas = document.createElement("canvas");
    canvas.width = canvas.height = 64;
    const context = canvas.getContext("2d");
    if (!context) return null;
    const gradient = context.createRadialGradient(32, 32, 0, 32, 32, 32);
    gradient.addColorStop(0, "rgba(255,255,255,0.9)");
    gradient.addColorStop(0.25, "rgba(255,255,255,0.35)");
    gradient.addColorStop(1, "rgba(255,255,255,0)");
    context.fillStyle = gradient;
    context.fillRect(0, 0, 64, 64);
    this.halo = new CanvasTexture(canvas);
    return this.halo;
  }

  // The number of lights never decreases, because each change of this number compiles every shader
  // again.
  private placePoints(lit: { glow: Glow; frame: Matrix4 }[]): void {
    while (this.points.length < Math.min(MOST_LIGHTS, lit.length)) {
      this.points.push(new PointLight());
      this.group.add(this.points.at(-1)!);
    }
    this.points.forEach((light, i) => {
      light.intensity = 0;
      if (lit[i]) setLight(light, lit[i]);
    });
  }

  private placeSpots(lit: { glow: Glow; frame: Matrix4 }[]): void {
    while (this.spots.length < Math.min(MOST_LIGHTS, lit.length)) {
      this.spots.push(new SpotLight());
      this.group.add(this.spots.at(-1)!, this.spots.at(-1)!.target);
    }
    this.spots.forEach((light, i) => {
      light.intensity = 0;
      const each = lit[i];
      if (!each) return;
      setLight(light, each);
      light.angle = Math.min(Math.PI / 2, each.glow.angle / 2);
      light.penumbra = 0.2;
      light.target.position.set(1, 0, 0).applyMatrix4(each.frame);
    });
  }
}

function keep<T>(map: Map<string, T>, topic: string, value: T | null): void {
  if (value) map.set(topic, value);
  else map.delete(topic);
}

function colourOf({ colour: [r, g, b] }: Glow): Color {
  return new Color().setRGB(r, g, b, SRGBColorSpace);
}

function placeLamp({ ball, halo }: Lamp, lit: { glow: Glow; frame: Matrix4 } | undefined): void {
  ball.visible = halo.visible = lit !== undefined;
  if (!lit) return;
  const { glow, frame } = lit;
  ball.position.setFromMatrixPosition(frame);
  ball.scale.setScalar(glow.radius);
  ball.material.color.copy(colourOf(glow)).multiplyScalar(glow.brightness);
  halo.position.copy(ball.position);
  halo.scale.setScalar(HALO * glow.radius);
  halo.material.color.copy(colourOf(glow));
  halo.material.opacity = glow.brightness;
}

// Sets a light by the formula of gsv/rendering/scene/lit_lamps.cc. The factor pi cancels the
// division by pi in three.js's reflectance.
function setLight(light: PointLight | SpotLight, { glow, frame }: { glow: Glow; frame: Matrix4 }): void {
  light.position.setFromMatrixPosition(frame);
  light.color.copy(colourOf(glow));
  light.intensity = glow.intensity * glow.brightness * Math.PI;
  light.distance = glow.range;
  light.decay = 2;
}

// Draws rings around the sensor's x axis. They expand and fade.
function drawRings(lines: LineLayer, worldFromSensor: Matrix4, { elapsed, volume }: Sound): void {
  const reach = RING_REACH * Math.max(0.2, volume);
  for (let ring = 0; ring < RINGS; ring++) {
    const radius = (RING_SPEED * elapsed + (ring * reach) / RINGS) % reach;
    const fade = 1 - radius / reach;
    const colour = SOUND_COLOUR.map((part) => part * fade + (1 - fade)) as [number, number, number];
    const at = (i: number): [number, number, number] => {
      const angle = (2 * Math.PI * i) / RING_SEGMENTS;
      return [radius / 2, radius * Math.cos(angle), radius * Math.sin(angle)];
    };
    for (let i = 0; i < RING_SEGMENTS; i++) lines.add(worldFromSensor, at(i), at(i + 1), colour);
  }
}

// Draws the inner face of each finger. It is green if a body is attached to the gripper.
function drawJaws(lines: LineLayer, worldFromSensor: Matrix4, { opening, reach, height, held }: Jaws): void {
  const colour = held === "" ? EMPTY_COLOUR : HOLDING_COLOUR;
  const z = height / 2;
  for (const y of [opening / 2, -opening / 2]) {
    const corners = [
      [0, y, -z],
      [reach, y, -z],
      [reach, y, z],
      [0, y, z],
    ];
    corners.forEach((corner, i) => lines.add(worldFromSensor, corner, corners[(i + 1) % 4]!, colour));
  }
}

// The number of lines that draw the rings of one sound.
export const RING_LINES = RINGS * RING_SEGMENTS;
