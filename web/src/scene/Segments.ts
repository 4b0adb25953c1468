// Coloured line segments in one draw call, from arrays that are rewritten for each frame.
import type { InterleavedBuffer } from "three";
import {
  BufferAttribute,
  BufferGeometry,
  DynamicDrawUsage,
  InstancedInterleavedBuffer,
  InterleavedBufferAttribute,
  LineBasicMaterial,
  LineSegments,
} from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";

export interface SegmentsLook {
  widthPx: number;
  // If true, draws lines of one device pixel instead of wide lines. A wide line is an instance.
  // Without a graphics card, each instance is a draw call of about 40 µs.
  thin: boolean;
  opacity?: number;
  depthTest?: boolean;
}

const NUMBERS_PER_SEGMENT = 6;

export class Segments {
  readonly lines: LineSegments | LineSegments2;
  // The positions (x y z) and colours (r g b) of both ends of each segment.
  positions = new Float32Array(0);
  colours = new Float32Array(0);
  count = 0; // number of segments to draw

  constructor({ widthPx, thin, opacity = 1, depthTest = true }: SegmentsLook) {
    // Transparent lines hide no other lines behind them.
    const isTransparent = opacity < 1;
    const look = {
      vertexColors: true,
      transparent: isTransparent,
      opacity,
      depthTest,
      depthWrite: !isTransparent,
      toneMapped: false,
    };
    this.lines = thin
      ? new LineSegments(new BufferGeometry(), new LineBasicMaterial(look))
      : new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ ...look, linewidth: widthPx }));
    this.lines.frustumCulled = false;
    this.lines.raycast = () => {};
  }

  // Makes the arrays large enough for this number of segments. Their content is lost.
  allot(segments: number): void {
    this.positions = new Float32Array(NUMBERS_PER_SEGMENT * segments);
    this.colours = new Float32Array(NUMBERS_PER_SEGMENT * segments);
    this.lines.geometry.dispose();
    this.lines.geometry =
      this.lines instanceof LineSegments2
        ? wideGeometry(this.positions, this.colours)
        : thinGeometry(this.positions, this.colours);
  }

  // Draws the first `count` segments of the arrays.
  upload(segments: number): void {
    this.count = segments;
    const { geometry } = this.lines;
    if (geometry instanceof LineSegmentsGeometry) geometry.instanceCount = segments;
    else geometry.setDrawRange(0, 2 * segments);
    if (segments === 0) return;
    for (const attribute of Object.values(geometry.attributes)) {
      if (attribute instanceof InterleavedBufferAttribute) renew(attribute.data, segments);
      else if (attribute.usage === DynamicDrawUsage) renew(attribute, segments);
    }
  }

  dispose(): void {
    this.lines.geometry.dispose();
    (this.lines.material as LineBasicMaterial | LineMaterial).dispose();
    this.lines.removeFromParent();
  }
}

// Sends only the used part of the array to the graphics.
function renew(buffer: BufferAttribute | InterleavedBuffer, segments: number): void {
  buffer.clearUpdateRanges();
  buffer.addUpdateRange(0, NUMBERS_PER_SEGMENT * segments);
  buffer.needsUpdate = true;
}

function wideGeometry(positions: Float32Array, colours: Float32Array): LineSegmentsGeometry {
  const geometry = new LineSegmentsGeometry();
  const attach = (array: Float32Array, start: string, end: string) => {
    const buffer = new InstancedInterleavedBuffer(array, NUMBERS_PER_SEGMENT, 1);
    buffer.setUsage(DynamicDrawUsage);
    geometry.setAttribute(start, new InterleavedBufferAttribute(buffer, 3, 0));
    geometry.setAttribute(end, new InterleavedBufferAttribute(buffer, 3, 3));
  };
  attach(positions, "instanceStart", "instanceEnd");
  attach(colours, "instanceColorStart", "instanceColorEnd");
  geometry.instanceCount = 0;
  return geometry;
}

function thinGeometry(positions: Float32Array, colours: Float32Array): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3).setUsage(DynamicDrawUsage));
  geometry.setAttribute("color", new BufferAttribute(colours, 3).setUsage(DynamicDrawUsage));
  geometry.setDrawRange(0, 0);
  return geometry;
}
