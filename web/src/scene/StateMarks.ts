// Draws a mark at each robot that is far away or in trouble. If there is a filter, draws a mark at
// each robot that the filter selects, and at no other robot. The mark shows the state by colour, and
// also by shape for people who do not see colours. All marks are one draw call. They are drawn over
// everything else.
import type { PerspectiveCamera } from "three";
import {
  BufferAttribute,
  BufferGeometry,
  CanvasTexture,
  DynamicDrawUsage,
  Points,
  ShaderMaterial,
} from "three";
import type { ShownState } from "../state/health";
import { SHOWN_STATES, isTrouble } from "../state/health";

// A robot that is smaller than this in the image, in CSS pixels, is shown as a mark.
const FAR_PX = 14;
const SIZE_PX = 9;
const TROUBLE_SIZE_PX = 14;
const GLYPH_PX = 64;

export const STATE_COLOURS: Record<ShownState, string> = {
  moving: "#2da44e",
  standing: "#8c96a3",
  unknown: "#8c96a3",
  told: "#d4850a",
  late: "#d4850a",
  contact: "#d4850a",
  stuck: "#d1242f",
  dead: "#d1242f",
};

export interface MarkedRobots {
  states: ArrayLike<number>; // state of each robot, as an index of SHOWN_STATES
  radii: ArrayLike<number>; // m
  // Whether a filter selects the robot; null: there is no filter.
  isChosen: ((robot: number) => boolean) | null;
}

const VERTEX = `
attribute float state;
attribute float size;
varying float vState;
uniform float ratio;
void main() {
  vState = state;
  gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
  gl_PointSize = size * ratio;
}`;
const FRAGMENT = `
varying float vState;
uniform sampler2D glyphs;
uniform float count;
void main() {
  vec4 colour = texture2D(glyphs, vec2((vState + gl_PointCoord.x) / count, 1.0 - gl_PointCoord.y));
  if (colour.a < 0.3) discard;
  gl_FragColor = colour;
}`;

export class StateMarks {
  readonly points: Points<BufferGeometry, ShaderMaterial>;
  private capacity = 0;

  constructor() {
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { glyphs: { value: null }, count: { value: SHOWN_STATES.length }, ratio: { value: 1 } },
      depthTest: false,
      depthWrite: false,
      transparent: true,
    });
    this.points = new Points(new BufferGeometry(), material);
    this.points.frustumCulled = false;
    this.points.raycast = () => {};
    this.points.renderOrder = 3;
    this.points.visible = false;
  }

  // `tops` has x y z above each robot, in the world. `height` is the height of the view in CSS
  // pixels.
  place(tops: Float64Array, robots: MarkedRobots, camera: PerspectiveCamera, height: number, ratio: number): void {
    const total = tops.length / 3;
    if (total === 0) return this.hide();
    if (total > this.capacity) this.grow(total);
    const { geometry, material } = this.points;
    material.uniforms.glyphs!.value ??= glyphTexture();
    material.uniforms.ratio!.value = ratio;
    const [positions, states, sizes] = ["position", "state", "size"].map(
      (name) => geometry.getAttribute(name).array as Float32Array,
    ) as [Float32Array, Float32Array, Float32Array];
    const focal = height / 2 / Math.tan((camera.fov * Math.PI) / 360);
    const { x, y, z } = camera.position;
    let used = 0;
    for (let robot = 0, at = 0; robot < total; robot++, at += 3) {
      const state = robots.states[robot]!;
      const isBad = isTrouble(SHOWN_STATES[state]!);
      const isChosen = robots.isChosen?.(robot) ?? false;
      if (robots.isChosen && !isChosen) continue;
      if (!isBad && !isChosen) {
        const distance = Math.hypot(tops[at]! - x, tops[at + 1]! - y, tops[at + 2]! - z);
        if ((2 * robots.radii[robot]! * focal) / distance > FAR_PX) continue;
      }
      for (let k = 0; k < 3; k++) positions[3 * used + k] = tops[at + k]!;
      states[used] = state;
      sizes[used] = isBad || isChosen ? TROUBLE_SIZE_PX : SIZE_PX;
      used += 1;
    }
    geometry.setDrawRange(0, used);
    for (const name of ["position", "state", "size"]) geometry.getAttribute(name).needsUpdate = true;
    this.points.visible = used > 0;
  }

  hide(): void {
    this.points.visible = false;
  }

  // The number of marks that were drawn.
  get count(): number {
    return this.points.visible ? this.points.geometry.drawRange.count : 0;
  }

  private grow(robots: number): void {
    this.capacity = robots;
    this.points.geometry.dispose();
    const geometry = new BufferGeometry();
    const numbers = (each: number) =>
      new BufferAttribute(new Float32Array(each * robots), each).setUsage(DynamicDrawUsage);
    geometry.setAttribute("position", numbers(3));
    geometry.setAttribute("state", numbers(1));
    geometry.setAttribute("size", numbers(1));
    this.points.geometry = geometry;
  }
}

// Draws all shapes side by side on one texture.
function glyphTexture(): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = GLYPH_PX * SHOWN_STATES.length;
  canvas.height = GLYPH_PX;
  const context = canvas.getContext("2d");
  if (context) {
    SHOWN_STATES.forEach((state, i) => {
      context.setTransform(GLYPH_PX, 0, 0, GLYPH_PX, i * GLYPH_PX, 0);
      drawGlyph(context, state);
    });
  }
  const texture = new CanvasTexture(canvas);
  texture.generateMipmaps = false;
  texture.minFilter = texture.magFilter;
  return texture;
}

const SHAPES: Record<ShownState, "circle" | "square" | "frame" | "ring" | "diamond" | "triangle" | "cross"> = {
  moving: "circle",
  unknown: "circle",
  standing: "frame",
  told: "square",
  late: "ring",
  contact: "diamond",
  stuck: "triangle",
  dead: "cross",
};

// Draws a shape in a unit square, with a white edge that separates it from the background.
function drawGlyph(context: CanvasRenderingContext2D, state: ShownState): void {
  const shape = SHAPES[state];
  const path = new Path2D();
  if (shape === "circle" || shape === "ring") path.arc(0.5, 0.5, shape === "ring" ? 0.3 : 0.38, 0, 2 * Math.PI);
  else polygon(path, POLYGONS[shape]);
  const isOpen = shape === "ring" || shape === "frame";
  context.lineJoin = "round";
  context.strokeStyle = "#fff";
  context.lineWidth = isOpen ? 0.36 : 0.14;
  context.stroke(path);
  context.fillStyle = context.strokeStyle = STATE_COLOURS[state];
  context.lineWidth = 0.2;
  if (isOpen) context.stroke(path);
  else context.fill(path);
}

const POLYGONS = {
  square: [0.16, 0.16, 0.84, 0.16, 0.84, 0.84, 0.16, 0.84],
  frame: [0.24, 0.24, 0.76, 0.24, 0.76, 0.76, 0.24, 0.76],
  diamond: [0.5, 0.06, 0.94, 0.5, 0.5, 0.94, 0.06, 0.5],
  triangle: [0.5, 0.08, 0.94, 0.88, 0.06, 0.88],
  cross: [
    0.24, 0.08, 0.5, 0.34, 0.76, 0.08, 0.92, 0.24, 0.66, 0.5, 0.92, 0.76, 0.76, 0.92, 0.5, 0.66, 0.24, 0.92, 0.08, 0.76, 0.34, 0.5,
    0.08, 0.24,
  ],
};

function polygon(path: Path2D, corners: readonly number[]): void {
  for (let i = 0; i < corners.length; i += 2) path.lineTo(corners[i]!, corners[i + 1]!);
  path.closePath();
}
