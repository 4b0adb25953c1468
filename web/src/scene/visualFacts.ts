// Describes the visuals of a model for inspectors.
import type { Material, MeshStandardMaterial } from "three";
import { Box3, Vector3 } from "three";
import type { MaterialFacts, VisualFacts } from "../api/visuals";
import type { ModelTemplate } from "./ModelTemplate";
import { boundsOf } from "./ModelTemplate";

const MAPS = {
  map: "colour",
  normalMap: "normals",
  roughnessMap: "roughness and metalness",
  emissiveMap: "emission",
  aoMap: "ambient occlusion",
  lightMap: "light",
} as const;

export function visualFacts(template: ModelTemplate): VisualFacts[] {
  const visuals = [...new Set(template.parts.map(({ visual }) => visual))];
  return visuals.map((visual) => {
    const parts = template.parts.filter((part) => part.visual === visual);
    const materials = [...new Set(parts.map(({ material }) => material))].map(materialFacts);
    if (visual.shape.kind !== undefined) return { ...visual, materials };
    const size = parts.reduce((box, part) => box.union(boundsOf(part)), new Box3()).getSize(new Vector3());
    return { ...visual, shape: { kind: "mesh", size: size.toArray() }, materials };
  });
}

function materialFacts(material: Material): MaterialFacts {
  const { color, opacity, metalness, roughness, ...rest } = material as MeshStandardMaterial;
  const held = rest as Readonly<Record<string, unknown>>;
  return {
    colour: `#${color.getHexString()}`,
    opacity,
    metalness: metalness ?? 0,
    roughness: roughness ?? 1,
    maps: Object.entries(MAPS).flatMap(([key, name]) => (held[key] ? [name] : [])),
  };
}
