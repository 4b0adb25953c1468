// The parts of a model as a few geometries, each in the frame with which it moves. Parts of one
// material are one geometry, so that all instances of them are one draw call.
import type { BufferGeometry, Material } from "three";
import { Matrix4 } from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import type { ModelPart } from "./ModelTemplate";

export interface FramedPart {
  part: ModelPart;
  frameFromPart: Matrix4;
}

export interface BakedPart {
  geometry: BufferGeometry; // a copy: the caller disposes of it
  material: Material;
}

export function bakeParts(parts: readonly FramedPart[]): BakedPart[] {
  const groups = new Map<Material, Map<string, BufferGeometry[]>>();
  for (const { part, frameFromPart } of parts) {
    const geometry = bake(part.geometry, frameFromPart);
    const alike = groups.get(part.material) ?? new Map<string, BufferGeometry[]>();
    groups.set(part.material, alike);
    const kind = layoutOf(geometry);
    alike.set(kind, [...(alike.get(kind) ?? []), geometry]);
  }
  return [...groups].flatMap(([material, alike]) =>
    [...alike.values()].map((geometries) => ({ geometry: merge(geometries), material })),
  );
}

function bake(geometry: BufferGeometry, frameFromPart: Matrix4): BufferGeometry {
  const copy = geometry.clone().applyMatrix4(frameFromPart);
  if (frameFromPart.determinant() < 0) turnFaces(copy);
  return copy;
}

// Reverses the triangles of a mirrored part. Otherwise, the backs of the triangles would be
// visible.
function turnFaces(geometry: BufferGeometry): void {
  const vertices = geometry.getAttribute("position").count;
  if (!geometry.index) geometry.setIndex(Array.from({ length: vertices }, (_, i) => i));
  const corners = geometry.index!.array;
  for (let i = 0; i + 2 < corners.length; i += 3) [corners[i], corners[i + 1]] = [corners[i + 1]!, corners[i]!];
}

// Geometries with equal layouts can be merged.
function layoutOf(geometry: BufferGeometry): string {
  const attributes = Object.entries(geometry.attributes).map(
    ([name, { itemSize, array, normalized }]) => `${name} ${itemSize} ${array.constructor.name} ${normalized}`,
  );
  return [geometry.index ? "indexed" : "plain", ...attributes.sort()].join(", ");
}

function merge(geometries: BufferGeometry[]): BufferGeometry {
  if (geometries.length === 1) return geometries[0]!;
  const merged = mergeGeometries(geometries);
  for (const each of geometries) each.dispose();
  return merged;
}
