// Paints the lines, points and plain surfaces of overlays on an image, projected with the image's
// camera. The depths of the image hide the parts behind surfaces, except those of materials without
// a depth test. If the image has no depths, everything is on top.
import type { BufferAttribute, BufferGeometry, Camera, InterleavedBufferAttribute, Object3D, Side } from "three";
import { Color, FrontSide, InstancedMesh, LineSegments, Matrix4, Mesh, Points, Vector4 } from "three";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import type { ImageDepths } from "./ImageDepths";

type Attribute = BufferAttribute | InterleavedBufferAttribute;
type Corner = readonly [x: number, y: number, w: number];
type LineEnds = readonly [ax: number, ay: number, bx: number, by: number]; // in pixels

const NEAR_W = 1e-3;
const MOST = 20_000; // maximum number of segments, points or triangles of one object
const MOST_INSTANCES = 200;
const LINE_PX = 1.5;
const POINT_PX = 3;
// Number of tests of a line against the depths, per distance between two samples of the depths.
const TESTS_PER_SAMPLE = 3;
// Maximum number of tests in an image. When it is reached, each further line is tested only
// once, in its middle.
const MAX_TESTS = 200_000;

export class OverlayPainter {
  private readonly clipFromWorld = new Matrix4();
  private readonly clipFromObject = new Matrix4();
  private readonly testPx: number; // distance between the tests of a line
  private testsLeft = MAX_TESTS;
  private hiding: ImageDepths | null = null; // the depths that may hide the present object

  constructor(
    private readonly context: CanvasRenderingContext2D,
    private readonly width: number,
    private readonly height: number,
    camera: Camera,
    private readonly depths: ImageDepths | null = null,
  ) {
    this.testPx = depths ? (depths.spacing * width) / depths.width / TESTS_PER_SAMPLE : Infinity;
    this.clipFromWorld.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
  }

  // Paints the visible parts of these objects and their children.
  paint(roots: readonly Object3D[]): void {
    for (const root of roots) {
      root.updateMatrixWorld();
      root.traverseVisible((object) => this.paintObject(object));
    }
  }

  private paintObject(object: Object3D): void {
    if ((object as Partial<Mesh>).material && isInvisible((object as Mesh).material)) return;
    this.clipFromObject.multiplyMatrices(this.clipFromWorld, object.matrixWorld);
    this.hiding = hasDepthTest((object as Partial<Mesh>).material) ? this.depths : null;
    // Wide lines are also meshes in three.js.
    if (object instanceof LineSegments2) this.paintWideLines(object);
    else if (object instanceof LineSegments) this.paintLines(object);
    else if (object instanceof Points) this.paintPoints(object);
    else if (object instanceof InstancedMesh) this.paintInstances(object);
    else if (object instanceof Mesh) this.paintSurface(object);
  }

  private paintInstances(mesh: InstancedMesh): void {
    const clipFromMesh = this.clipFromObject.clone();
    const meshFromInstance = new Matrix4();
    for (let i = 0; i < Math.min(mesh.count, MOST_INSTANCES); i++) {
      mesh.getMatrixAt(i, meshFromInstance);
      this.clipFromObject.multiplyMatrices(clipFromMesh, meshFromInstance);
      this.paintSurface(mesh);
    }
  }

  private paintWideLines({ geometry, material }: LineSegments2): void {
    const { instanceStart: from, instanceEnd: to, instanceColorStart: colours } = geometry.attributes;
    if (!from || !to) return;
    this.context.globalAlpha = opacityOf(material);
    for (let i = 0; i < Math.min(geometry.instanceCount, from.count, MOST); i++) {
      this.paintLine(this.corner(from, i), this.corner(to, i), colourAt(colours, i));
    }
    this.context.globalAlpha = 1;
  }

  private paintLines({ geometry, material }: LineSegments): void {
    const { position, color } = geometry.attributes;
    if (!position) return;
    const plain = plainColour(material);
    this.context.globalAlpha = opacityOf(material);
    const end = Math.min(geometry.drawRange.count, position.count, 2 * MOST);
    for (let i = 0; i + 1 < end; i += 2) {
      this.paintLine(this.corner(position, i), this.corner(position, i + 1), color ? colourAt(color, i) : plain);
    }
    this.context.globalAlpha = 1;
  }

  private paintPoints({ geometry, material }: Points): void {
    const { position, color } = geometry.attributes;
    if (!position) return;
    const plain = plainColour(material);
    for (let i = 0; i < Math.min(geometry.drawRange.count, position.count, MOST); i++) {
      const [x, y, w] = this.corner(position, i);
      if (w < NEAR_W || this.isHidden(x / w, y / w, w)) continue;
      this.context.fillStyle = color ? colourAt(color, i) : plain;
      this.context.fillRect(x / w - POINT_PX / 2, y / w - POINT_PX / 2, POINT_PX, POINT_PX);
    }
  }

  private paintSurface({ geometry, material }: Mesh): void {
    const { position } = geometry.attributes;
    if (!position) return;
    const plain = plainColour(material);
    this.context.fillStyle = plain;
    const isMirrored = this.clipFromObject.determinant() * this.clipFromWorld.determinant() < 0;
    this.context.globalAlpha = opacityOf(material);
    for (const [a, b, c] of trianglesOf(geometry)) {
      const corners = [a, b, c].map((index) => this.corner(position, index));
      if (isWireframe(material)) {
        corners.forEach((corner, i) => this.paintLine(corner, corners[(i + 1) % 3]!, plain));
        continue;
      }
      if (corners.some(([, , w]) => w < NEAR_W)) continue;
      if (isOneSided(material) && showsItsBack(corners) !== isMirrored) continue;
      if (this.hiding && [...corners, middleOf(corners)].every(([x, y, w]) => this.isHidden(x / w, y / w, w))) continue;
      this.context.beginPath();
      for (const [x, y, w] of corners) this.context.lineTo(x / w, y / w);
      this.context.fill();
    }
    this.context.globalAlpha = 1;
  }

  // Returns a corner in pixels, multiplied by w, which is positive in front of the camera.
  private corner(attribute: Attribute, index: number): Corner {
    const { x, y, w } = new Vector4(attribute.getX(index), attribute.getY(index), attribute.getZ(index), 1).applyMatrix4(
      this.clipFromObject,
    );
    return [((x + w) / 2) * this.width, ((w - y) / 2) * this.height, w];
  }

  private paintLine(from: Corner, to: Corner, colour: string): void {
    if (from[2] < NEAR_W && to[2] < NEAR_W) return;
    const [a, b] = from[2] < NEAR_W ? [cut(from, to), to] : to[2] < NEAR_W ? [from, cut(to, from)] : [from, to];
    const ends = [a[0] / a[2], a[1] / a[2], b[0] / b[2], b[1] / b[2]] as const;
    const inImage = this.hiding ? shareInside(ends, this.width, this.height) : ([0, 1] as const);
    if (!inImage) return;
    this.context.strokeStyle = colour;
    this.context.lineWidth = LINE_PX;
    this.context.beginPath();
    for (const [start, end] of this.visibleParts(ends, 1 / a[2], 1 / b[2], inImage)) {
      this.context.moveTo(ends[0] + start * (ends[2] - ends[0]), ends[1] + start * (ends[3] - ends[1]));
      this.context.lineTo(ends[0] + end * (ends[2] - ends[0]), ends[1] + end * (ends[3] - ends[1]));
    }
    this.context.stroke();
  }

  // Returns the parts of a line that no surface hides, as shares of the line in the image. The
  // inverse depth is linear along a line in the image.
  private visibleParts(
    [ax, ay, bx, by]: LineEnds,
    inverseA: number,
    inverseB: number,
    [first, last]: readonly [number, number],
  ): (readonly [number, number])[] {
    if (!this.hiding) return [[first, last]];
    const pixels = (last - first) * Math.hypot(bx - ax, by - ay);
    const tests = this.testsLeft > 0 ? Math.max(1, Math.ceil(pixels / this.testPx)) : 1;
    this.testsLeft -= tests;
    const step = (last - first) / tests;
    const parts: (readonly [number, number])[] = [];
    let start: number | null = null;
    for (let i = 0; i <= tests; i++) {
      const share = first + (i + 0.5) * step;
      const depth = 1 / (inverseA + share * (inverseB - inverseA));
      const isVisible = i < tests && !this.isHidden(ax + share * (bx - ax), ay + share * (by - ay), depth);
      if (isVisible) start ??= first + i * step;
      else if (start !== null) {
        parts.push([start, first + i * step]);
        start = null;
      }
    }
    return parts;
  }

  private isHidden(x: number, y: number, depth: number): boolean {
    return this.hiding !== null && this.hiding.hides(x / this.width, y / this.height, depth);
  }
}

// Returns the part of a line inside the image, as shares of the line; null if there is none.
function shareInside([ax, ay, bx, by]: LineEnds, width: number, height: number): [number, number] | null {
  let [first, last] = [0, 1];
  for (const [from, to, size] of [
    [ax, bx, width],
    [ay, by, height],
  ] as const) {
    if (from === to && (from < 0 || from > size)) return null;
    if (from === to) continue;
    const atEdges = [-from / (to - from), (size - from) / (to - from)];
    first = Math.max(first, Math.min(...atEdges));
    last = Math.min(last, Math.max(...atEdges));
  }
  return first < last ? [first, last] : null;
}

function middleOf(corners: readonly Corner[]): Corner {
  const mean = (of: 0 | 1 | 2) => corners.reduce((sum, corner) => sum + corner[of], 0) / corners.length;
  return [mean(0), mean(1), mean(2)];
}

// Returns the point of the line just in front of the camera.
function cut(behind: Corner, ahead: Corner): Corner {
  const share = (NEAR_W - behind[2]) / (ahead[2] - behind[2]);
  return [behind[0] + share * (ahead[0] - behind[0]), behind[1] + share * (ahead[1] - behind[1]), NEAR_W];
}

function* trianglesOf(geometry: BufferGeometry): Generator<[number, number, number]> {
  const { index } = geometry;
  const count = Math.min(index?.count ?? geometry.attributes.position!.count, 3 * MOST);
  const at = (i: number) => (index ? index.getX(i) : i);
  for (let i = 0; i + 2 < count; i += 3) yield [at(i), at(i + 1), at(i + 2)];
}

const colour = new Color();

function colourAt(colours: Attribute | undefined, index: number): string {
  if (!colours) return "white";
  return colour.setRGB(colours.getX(index), colours.getY(index), colours.getZ(index)).getStyle();
}

function plainColour(material: unknown): string {
  const its = (material as { color?: Color }).color;
  return its instanceof Color ? its.getStyle() : "white";
}

// Returns whether a material is invisible. For example, an object that only receives the pointer is
// invisible.
function isInvisible(material: unknown): boolean {
  return (material as { visible?: boolean }).visible === false;
}

function hasDepthTest(material: unknown): boolean {
  return (material as { depthTest?: boolean } | undefined)?.depthTest !== false;
}

function isWireframe(material: unknown): boolean {
  return (material as { wireframe?: boolean }).wireframe === true;
}

function isOneSided(material: unknown): boolean {
  return (material as { side?: Side }).side === FrontSide;
}

// Returns whether the camera sees the back of a triangle. The corners of the triangle are then in
// clockwise order.
function showsItsBack([a, b, c]: readonly Corner[]): boolean {
  const [ax, ay, bx, by, cx, cy] = [a!, b!, c!].flatMap(([x, y, w]) => [x / w, y / w]) as [number, number, number, number, number, number];
  return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax) >= 0; // y is downwards
}

function opacityOf(material: unknown): number {
  const { transparent, opacity } = material as { transparent?: boolean; opacity?: number };
  return transparent ? (opacity ?? 1) : 1;
}
