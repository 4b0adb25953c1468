// Lines of some pixels' width, all in one draw call: the geometry over arrays that are written anew.
import { DynamicDrawUsage, InstancedInterleavedBuffer, InterleavedBufferAttribute } from "three";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";

// `positions` and `colours` hold six numbers for each segment, x y z or r g b of both ends.
export function segmentsGeometry(positions: Float32Array, colours: Float32Array): LineSegmentsGeometry {
  const geometry = new LineSegmentsGeometry();
  const attach = (array: Float32Array, start: string, end: string) => {
    const buffer = new InstancedInterleavedBuffer(array, 6, 1);
    buffer.setUsage(DynamicDrawUsage);
    geometry.setAttribute(start, new InterleavedBufferAttribute(buffer, 3, 0));
    geometry.setAttribute(end, new InterleavedBufferAttribute(buffer, 3, 3));
  };
  attach(positions, "instanceStart", "instanceEnd");
  attach(colours, "instanceColorStart", "instanceColorEnd");
  geometry.instanceCount = 0;
  return geometry;
}

// Draws the first so many segments as they stand in the arrays now.
export function uploadSegments(geometry: LineSegmentsGeometry, segments: number): void {
  geometry.instanceCount = segments;
  for (const name of ["instanceStart", "instanceColorStart"]) {
    (geometry.getAttribute(name) as InterleavedBufferAttribute).data.needsUpdate = true;
  }
}
