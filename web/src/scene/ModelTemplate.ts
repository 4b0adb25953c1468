// The shape of one model, fetched once and drawn many times: the drawable parts of its links.
import type { BufferGeometry, Material, Mesh, Object3D } from "three";
import { Box3, Matrix4 } from "three";
import type { ModelVisual } from "../api/visuals";

// A mesh of a model that is drawn.
export interface ModelPart {
  visual: ModelVisual; // shared by the parts of a visual with several materials
  geometry: BufferGeometry;
  material: Material;
  link: string | null; // null: the part belongs to the model itself
  linkFromPart: Matrix4;
  modelFromPart: Matrix4;
}

export interface ModelTemplate {
  parts: ModelPart[];
  bounds: Box3; // in the model's frame; empty when nothing is drawn
}

// `root` has one node for each link, with the link's name. GLTFLoader changes names, and stores the
// original names in the nodes' userData.
export function makeTemplate(root: Object3D, links: readonly string[]): ModelTemplate {
  root.updateMatrixWorld(true);
  const modelFromWorld = root.matrixWorld.clone().invert();
  const linkNames = new Set(links);
  const visuals = new Map<Object3D, ModelVisual>();
  const template: ModelTemplate = { parts: [], bounds: new Box3() };
  root.traverse((node) => {
    const mesh = node as Mesh;
    if (!mesh.isMesh) return;
    const linkNode = linkAbove(node, root, linkNames);
    const frame = linkNode ?? root;
    const link = linkNode ? originalName(linkNode) : null;
    const visualNode = visualAbove(node, frame);
    const { visual: name, shape } = visualNode.userData as { visual?: unknown; shape?: unknown };
    const visual = visuals.get(visualNode) ?? {
      name: typeof name === "string" ? name : "",
      link,
      shape: typeof shape === "object" && shape !== null ? (shape as ModelVisual["shape"]) : {},
    };
    visuals.set(visualNode, visual);
    const part: ModelPart = {
      visual,
      geometry: mesh.geometry,
      material: Array.isArray(mesh.material) ? mesh.material[0]! : mesh.material,
      link,
      linkFromPart: frame.matrixWorld.clone().invert().multiply(mesh.matrixWorld),
      modelFromPart: modelFromWorld.clone().multiply(mesh.matrixWorld),
    };
    template.parts.push(part);
    template.bounds.union(boundsOf(part));
  });
  return template;
}

export function disposeTemplate(template: ModelTemplate): void {
  for (const { geometry, material } of template.parts) {
    geometry.dispose();
    for (const value of Object.values(material)) {
      if ((value as { isTexture?: boolean } | null)?.isTexture) value.dispose();
    }
    material.dispose();
  }
}

function originalName(node: Object3D): string {
  const name: unknown = node.userData.name;
  return typeof name === "string" ? name : node.name;
}

// Returns the node of the visual that contains a mesh. If there is none, returns the mesh itself.
function visualAbove(mesh: Object3D, frame: Object3D): Object3D {
  for (let each: Object3D | null = mesh; each && each !== frame; each = each.parent) {
    if (each.userData.visual !== undefined) return each;
  }
  return mesh;
}

function linkAbove(node: Object3D, root: Object3D, links: Set<string>): Object3D | null {
  for (let each: Object3D | null = node; each && each !== root; each = each.parent) {
    if (links.has(originalName(each))) return each;
  }
  return null;
}

// Returns the bounds of a part in the model's frame.
export function boundsOf(part: ModelPart): Box3 {
  if (!part.geometry.boundingBox) part.geometry.computeBoundingBox();
  return (part.geometry.boundingBox ?? new Box3()).clone().applyMatrix4(part.modelFromPart);
}
