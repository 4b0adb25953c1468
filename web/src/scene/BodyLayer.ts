// Draws the bodies of a scene. Bodies of one model share its geometry, and each part is drawn in
// one call. A link that moves relative to its model has its own pose.
import type { Box3, Intersection, Material, PerspectiveCamera } from "three";
import { Group, InstancedMesh, Matrix4, Mesh, Quaternion, Raycaster, Vector3 } from "three";
import type { PoseNumbers, SceneBody, SceneDescription } from "../api/scene";
import { CrowdDetail } from "./CrowdDetail";
import type { ModelPart, ModelTemplate } from "./ModelTemplate";
import { boundsOf } from "./ModelTemplate";

// A part of a moving body: where its matrix is written after each update.
interface MovingPart {
  mesh: Mesh | InstancedMesh;
  instance: number;
  frame: Matrix4;
  frameFromPart: Matrix4;
}

const UNIT_SCALE = new Vector3(1, 1, 1);

export class BodyLayer {
  readonly group = new Group();
  private readonly worldFromBody: Matrix4[];
  private readonly worldFromLink: Map<string, Matrix4>[];
  private readonly frames: Matrix4[]; // one for each entry of the scene's poses
  private readonly templates = new Map<string, ModelTemplate>();
  private readonly bodiesOfMesh = new Map<Mesh, number[]>();
  private readonly moving: MovingPart[] = [];
  private readonly indices: Map<string, number>;
  private readonly poseEntries: Map<string, number>;
  private readonly detail = new CrowdDetail();

  constructor(readonly scene: SceneDescription) {
    this.group.add(this.detail.group);
    this.worldFromBody = scene.bodies.map((body) => matrixOf(body.pose));
    this.worldFromLink = scene.bodies.map(() => new Map());
    this.frames = scene.poses.map(({ body, link }) => {
      if (link === null) return this.worldFromBody[body]!;
      const frame = new Matrix4().copy(this.worldFromBody[body]!);
      this.worldFromLink[body]!.set(link, frame);
      return frame;
    });
    this.indices = new Map(scene.bodies.map(({ name }, index) => [name, index]));
    this.poseEntries = new Map(
      scene.poses.flatMap(({ body, link }, entry) =>
        link === null ? [[scene.bodies[body]!.name, entry] as const] : [],
      ),
    );
  }

  // Shows all bodies of a model.
  addModel(id: string, template: ModelTemplate): void {
    this.templates.set(id, template);
    const bodies = this.scene.bodies.flatMap((body, index) => (body.model === id ? [index] : []));
    const meshes = template.parts.map((part) => ({ mesh: this.addPart(part, bodies), size: sizeOf(boundsOf(part)) }));
    const radius = sizeOf(template.bounds) / 2;
    this.detail.add(meshes, radius, bodies.map((body) => this.worldFromBody[body]!));
  }

  // Sets the level of detail for this distance, in a view with this height in pixels.
  chooseDetail(camera: PerspectiveCamera, height: number): void {
    this.detail.choose(camera, height);
  }

  // The poses in the order of the scene's list, with seven numbers each.
  setPoses(poses: Float64Array): void {
    this.frames.forEach((frame, index) => readMatrix(poses, 7 * index, frame));
    this.placeMoving();
  }

  private placeMoving(): void {
    for (const part of this.moving) place(part);
    for (const { mesh } of this.moving) {
      if (mesh instanceof InstancedMesh) mesh.instanceMatrix.needsUpdate = true;
    }
    this.detail.moved();
  }

  // Copies the poses of another layer of the same scene.
  standLike(other: BodyLayer): void {
    this.frames.forEach((frame, index) => frame.copy(other.frames[index]!));
    this.placeMoving();
  }

  // Shows one body with its links at another pose until the next poses arrive.
  moveBody(body: number, worldFromBody: Matrix4): void {
    const frame = this.worldFromBody[body]!;
    const motion = worldFromBody.clone().multiply(frame.clone().invert());
    const frames = new Set([frame, ...this.movingLinksOf(body)]);
    for (const each of frames) each.premultiply(motion);
    for (const part of this.moving) {
      if (!frames.has(part.frame)) continue;
      place(part);
      if (part.mesh instanceof InstancedMesh) part.mesh.instanceMatrix.needsUpdate = true;
    }
    this.detail.moved();
  }

  // -1 if there is no body with this name.
  indexOf(name: string): number {
    return this.indices.get(name) ?? -1;
  }

  // The body's entry in the scene's poses; null if it has none.
  poseEntryOf(name: string): number | null {
    return this.poseEntries.get(name) ?? null;
  }

  // world_from_body as displayed now; it changes with the next poses.
  poseOf(body: number): Matrix4 | null {
    return this.worldFromBody[body] ?? null;
  }

  // world_from_link as displayed now, for a link that moves relative to its body.
  linkPoseOf(body: number, link: string): Matrix4 | null {
    return this.worldFromLink[body]?.get(link) ?? null;
  }

  // The links that move relative to their bodies.
  movingLinksOf(body: number): Matrix4[] {
    return [...(this.worldFromLink[body]?.values() ?? [])];
  }

  templateOf(body: number): ModelTemplate | null {
    const model = this.scene.bodies[body]?.model;
    return (model !== undefined && this.templates.get(model)) || null;
  }

  // The first body on the ray.
  pick(raycaster: Raycaster): SceneBody | null {
    const hit = this.hitsOf(raycaster)[0];
    return hit ? this.bodyAt(hit) : null;
  }

  // The point at which the ray hits something that is fixed to the world.
  pointOf(raycaster: Raycaster): Vector3 | null {
    return this.hitsOf(raycaster).find((hit) => this.bodyAt(hit)?.isStatic)?.point ?? null;
  }

  // The free distance from a place in a direction (unit length) to the next fixed body; Infinity if
  // there is none within `far`.
  freeAlong(from: Vector3, direction: Vector3, far: number): number {
    const blocks = (hit: Intersection) =>
      this.bodyAt(hit)?.isStatic && !((hit.object as Mesh).material as Material).transparent;
    return this.hitsOf(new Raycaster(from, direction, 0, far)).find(blocks)?.distance ?? Infinity;
  }

  dispose(): void {
    this.detail.dispose();
    for (const mesh of this.bodiesOfMesh.keys()) if (mesh instanceof InstancedMesh) mesh.dispose();
    this.group.removeFromParent();
  }

  private hitsOf(raycaster: Raycaster): Intersection[] {
    for (const mesh of this.bodiesOfMesh.keys()) {
      if (mesh instanceof InstancedMesh) mesh.computeBoundingSphere();
    }
    return raycaster.intersectObject(this.group, true);
  }

  private bodyAt(hit: Intersection): SceneBody | null {
    const bodies = this.bodiesOfMesh.get(hit.object as Mesh);
    const index = bodies?.[hit.instanceId ?? 0];
    return index === undefined ? null : (this.scene.bodies[index] ?? null);
  }

  private addPart(part: ModelPart, bodies: number[]): Mesh {
    const mesh =
      bodies.length === 1
        ? new Mesh(part.geometry, part.material)
        : new InstancedMesh(part.geometry, part.material, bodies.length);
    mesh.matrixAutoUpdate = false;
    mesh.castShadow = mesh.receiveShadow = !part.material.transparent;
    bodies.forEach((body, instance) => {
      const placed = this.placedPart(part, body, mesh, instance);
      place(placed);
      if (this.scene.bodies[body]!.isFixed) return;
      this.moving.push(placed);
      mesh.frustumCulled = false;
    });
    this.bodiesOfMesh.set(mesh, bodies);
    this.group.add(mesh);
    return mesh;
  }

  private placedPart(part: ModelPart, body: number, mesh: Mesh, instance: number): MovingPart {
    const link = part.link === null ? undefined : this.worldFromLink[body]!.get(part.link);
    return link
      ? { mesh, instance, frame: link, frameFromPart: part.linkFromPart }
      : { mesh, instance, frame: this.worldFromBody[body]!, frameFromPart: part.modelFromPart };
  }
}

// The length of the diagonal.
function sizeOf(bounds: Box3): number {
  return bounds.getSize(new Vector3()).length();
}

const worldFromPart = new Matrix4();

function place({ mesh, instance, frame, frameFromPart }: MovingPart): void {
  worldFromPart.multiplyMatrices(frame, frameFromPart);
  if (mesh instanceof InstancedMesh) {
    mesh.setMatrixAt(instance, worldFromPart);
  } else {
    mesh.matrix.copy(worldFromPart);
    mesh.matrixWorldNeedsUpdate = true;
  }
}

const position = new Vector3();
const rotation = new Quaternion();

function readMatrix(numbers: ArrayLike<number>, at: number, out: Matrix4): Matrix4 {
  position.set(numbers[at]!, numbers[at + 1]!, numbers[at + 2]!);
  rotation.set(numbers[at + 3]!, numbers[at + 4]!, numbers[at + 5]!, numbers[at + 6]!);
  return out.compose(position, rotation, UNIT_SCALE);
}

export function matrixOf(pose: PoseNumbers | Float64Array, at = 0): Matrix4 {
  return readMatrix(pose, at, new Matrix4());
}
