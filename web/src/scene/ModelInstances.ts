// Draws the bodies of one model. Several bodies are drawn as instances: all parts that move with
// one frame (the body, or one of its links) share one buffer of matrices, and parts of one material
// are one draw call. A single body is drawn part by part. So three.js sorts transparent parts, and
// omits the parts of a fixed body that are outside of the view.
import type { BufferGeometry } from "three";
import { DynamicDrawUsage, InstancedBufferAttribute, InstancedMesh, Matrix4, Mesh } from "three";
import { OCCLUDING_LAYER } from "./AmbientOcclusion";
import type { FramedPart } from "./bakedParts";
import { bakeParts } from "./bakedParts";
import type { BodyFrames } from "./BodyFrames";
import { MATRIX_NUMBERS } from "./BodyFrames";
import type { ModelPart, ModelTemplate } from "./ModelTemplate";

// The parts of a model that move with the same frame: the model itself, or one of its links.
export interface Rig {
  frames: Int32Array; // index of this frame for each body
  parts: FramedPart[];
  matrices: InstancedBufferAttribute; // world_from_frame of each body
  isMoving: boolean;
}

export interface ModelBodies {
  bodies: readonly number[]; // bodies with the same moving links
  isFixed(body: number): boolean;
}

export class ModelInstances {
  readonly meshes: Mesh[] = [];
  readonly rigs: Rig[];
  private readonly singles: { mesh: Mesh; frame: number; frameFromPart: Matrix4 }[] = [];
  private readonly owned: BufferGeometry[] = [];

  constructor(
    template: ModelTemplate,
    private readonly frames: BodyFrames,
    private readonly of: ModelBodies,
  ) {
    this.rigs = this.makeRigs(template.parts);
    for (const rig of this.rigs) {
      if (of.bodies.length === 1) this.addSingle(rig);
      else this.addInstances(rig);
    }
    this.place(true);
  }

  get bodies(): readonly number[] {
    return this.of.bodies;
  }

  // Moves the meshes to the present poses of the frames. With `all`, also moves the meshes of fixed
  // bodies.
  place(all = false): void {
    for (const { frames, matrices, isMoving } of this.rigs) {
      if (!isMoving && !all) continue;
      const array = matrices.array as Float32Array;
      for (let i = 0; i < frames.length; i++) this.frames.writeMatrix(frames[i]!, array, MATRIX_NUMBERS * i);
      matrices.needsUpdate = true;
    }
    for (const { mesh, frame, frameFromPart } of this.singles) {
      if (!all && mesh.frustumCulled) continue; // the body is fixed
      this.frames.matrixOf(frame, mesh.matrix).multiply(frameFromPart);
      mesh.matrixWorldNeedsUpdate = true;
    }
  }

  dispose(): void {
    for (const mesh of this.meshes) {
      if (mesh instanceof InstancedMesh) mesh.dispose();
      mesh.removeFromParent();
    }
    for (const geometry of this.owned) geometry.dispose();
  }

  private makeRigs(parts: readonly ModelPart[]): Rig[] {
    const { bodies } = this.of;
    const links = this.frames.linksOf(bodies[0]!);
    const byLink = new Map<string | null, FramedPart[]>();
    for (const part of parts) {
      const link = part.link !== null && links.has(part.link) ? part.link : null;
      const framed = { part, frameFromPart: link === null ? part.modelFromPart : part.linkFromPart };
      byLink.set(link, [...(byLink.get(link) ?? []), framed]);
    }
    const isMoving = !bodies.every((body) => this.of.isFixed(body));
    return [...byLink].map(([link, framed]) => {
      const frames = Int32Array.from(bodies, (body) =>
        link === null ? this.frames.frameOf(body) : this.frames.linksOf(body).get(link)!,
      );
      const matrices = new InstancedBufferAttribute(new Float32Array(MATRIX_NUMBERS * bodies.length), MATRIX_NUMBERS);
      if (isMoving) matrices.setUsage(DynamicDrawUsage);
      return { frames, parts: framed, matrices, isMoving };
    });
  }

  private addInstances({ parts, matrices, isMoving }: Rig): void {
    for (const { geometry, material } of bakeParts(parts)) {
      const mesh = new InstancedMesh(geometry, material, 0);
      mesh.instanceMatrix = matrices;
      mesh.count = this.of.bodies.length;
      this.owned.push(geometry);
      this.add(mesh, isMoving);
    }
  }

  private addSingle({ parts, frames, isMoving }: Rig): void {
    for (const { part, frameFromPart } of parts) {
      const mesh = new Mesh(part.geometry, part.material);
      this.singles.push({ mesh, frame: frames[0]!, frameFromPart });
      this.add(mesh, isMoving);
    }
  }

  private add(mesh: Mesh, isMoving: boolean): void {
    mesh.matrixAutoUpdate = false;
    mesh.frustumCulled = !isMoving;
    const { material } = mesh;
    mesh.castShadow = mesh.receiveShadow = !Array.isArray(material) && !material.transparent;
    if (mesh.castShadow) mesh.layers.enable(OCCLUDING_LAYER);
    this.meshes.push(mesh);
  }
}

// Returns the bodies, grouped by the links that move.
export function alikeBodies(bodies: readonly number[], frames: BodyFrames): number[][] {
  const groups = new Map<string, number[]>();
  for (const body of bodies) {
    const links = [...frames.linksOf(body).keys()].sort().join("\n");
    const group = groups.get(links);
    if (group) group.push(body);
    else groups.set(links, [body]);
  }
  return [...groups.values()];
}
