// Draws the bodies of a scene, all from one list of poses. A link that moves relative to its model
// has a separate pose in this list.
import type { Box3, Intersection, Material, Mesh, PerspectiveCamera } from "three";
import { Group, InstancedMesh, Matrix4, Raycaster, Vector3 } from "three";
import type { SceneBody, SceneDescription } from "../api/scene";
import { BodyFrames } from "./BodyFrames";
import { CrowdDetail } from "./CrowdDetail";
import { ModelInstances, alikeBodies } from "./ModelInstances";
import type { ModelTemplate } from "./ModelTemplate";

export class BodyLayer {
  readonly group = new Group();
  readonly frames: BodyFrames;
  private readonly templates = new Map<string, ModelTemplate>();
  private readonly bodiesOfMesh = new Map<Mesh, readonly number[]>();
  private readonly instances: ModelInstances[] = [];
  private readonly indices: Map<string, number>;
  private readonly poseEntries: Map<string, number>;
  private readonly detail: CrowdDetail;

  constructor(readonly scene: SceneDescription) {
    this.frames = new BodyFrames(scene);
    this.detail = new CrowdDetail(this.frames);
    this.group.add(this.detail.group);
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
    const all = this.scene.bodies.flatMap((body, index) => (body.model === id ? [index] : []));
    for (const bodies of alikeBodies(all, this.frames)) {
      const isFixed = (body: number) => this.scene.bodies[body]!.isFixed;
      const instances = new ModelInstances(template, this.frames, { bodies, isFixed });
      this.instances.push(instances);
      for (const mesh of instances.meshes) this.bodiesOfMesh.set(mesh, bodies);
      if (instances.meshes.length > 0) this.group.add(...instances.meshes);
      this.detail.add(instances, sizeOf(template.bounds) / 2);
    }
  }

  // Chooses the level of detail of crowds from their distance to the camera. `height` is the height
  // of the view in pixels.
  chooseDetail(camera: PerspectiveCamera, height: number): void {
    this.detail.choose(camera, height);
  }

  // Takes the poses in the order of the scene's list, with seven numbers for each pose.
  setPoses(poses: Float64Array): void {
    this.frames.numbers.set(poses);
    this.place();
  }

  // Copies the poses of another layer of the same scene.
  standLike(other: BodyLayer): void {
    this.setPoses(other.frames.numbers);
  }

  // Shows one body and its links at another pose until the next poses arrive.
  moveBody(body: number, worldFromBody: Matrix4): void {
    const { frames } = this;
    const frame = frames.frameOf(body);
    const motion = worldFromBody.clone().multiply(frames.matrixOf(frame).invert());
    for (const link of frames.linksOf(body).values()) frames.setMatrix(link, frames.matrixOf(link).premultiply(motion));
    frames.setMatrix(frame, worldFromBody);
    this.place();
  }

  // Returns the index of a body; -1 if there is no body with this name.
  indexOf(name: string): number {
    return this.indices.get(name) ?? -1;
  }

  // Returns the index of the body in the pose messages; null if they do not contain it.
  poseEntryOf(name: string): number | null {
    return this.poseEntries.get(name) ?? null;
  }

  // Returns the displayed pose of a body: world_from_body.
  poseOf(body: number): Matrix4 | null {
    return this.scene.bodies[body] ? this.frames.matrixOf(this.frames.frameOf(body)) : null;
  }

  // Returns the displayed pose of a link that moves relative to its body; the pose is
  // world_from_link.
  linkPoseOf(body: number, link: string): Matrix4 | null {
    const frame = this.scene.bodies[body] && this.frames.linksOf(body).get(link);
    return frame === undefined ? null : this.frames.matrixOf(frame);
  }

  // Returns the displayed poses of the links that move relative to their body: world_from_link.
  movingLinksOf(body: number): Matrix4[] {
    return [...this.frames.linksOf(body).values()].map((frame) => this.frames.matrixOf(frame));
  }

  templateOf(body: number): ModelTemplate | null {
    const model = this.scene.bodies[body]?.model;
    return (model !== undefined && this.templates.get(model)) || null;
  }

  // Returns the first body on the ray.
  pick(raycaster: Raycaster): SceneBody | null {
    const hit = this.hitsOf(raycaster)[0];
    return hit ? this.bodyAt(hit) : null;
  }

  // Returns the point at which the ray hits a body that is fixed to the world.
  pointOf(raycaster: Raycaster): Vector3 | null {
    return this.staticHitsOf(raycaster)[0]?.point ?? null;
  }

  // Returns the free distance from a place in a direction (unit length) to the next static body
  // that is not transparent; Infinity if there is none within `far`.
  freeAlong(from: Vector3, direction: Vector3, far: number): number {
    const blocks = ({ object }: Intersection) => !((object as Mesh).material as Material).transparent;
    return this.staticHitsOf(new Raycaster(from, direction, 0, far)).find(blocks)?.distance ?? Infinity;
  }

  dispose(): void {
    this.detail.dispose();
    for (const each of this.instances) each.dispose();
    this.group.removeFromParent();
  }

  private place(): void {
    for (const each of this.instances) each.place();
    this.detail.moved();
  }

  private staticHitsOf(raycaster: Raycaster): Intersection[] {
    const isStatic = (body: number | undefined) => body !== undefined && this.scene.bodies[body]!.isStatic;
    const hits = this.hitsOf(raycaster, (bodies) => bodies.some(isStatic));
    return hits.filter((hit) => this.bodyAt(hit)?.isStatic);
  }

  private hitsOf(raycaster: Raycaster, isMeant: (bodies: readonly number[]) => boolean = () => true): Intersection[] {
    const meshes = [...this.bodiesOfMesh].flatMap(([mesh, bodies]) => (isMeant(bodies) ? [mesh] : []));
    for (const mesh of meshes) if (mesh instanceof InstancedMesh) mesh.computeBoundingSphere();
    return raycaster.intersectObjects(meshes, false);
  }

  private bodyAt(hit: Intersection): SceneBody | null {
    const index = this.bodiesOfMesh.get(hit.object as Mesh)?.[hit.instanceId ?? 0];
    return index === undefined ? null : (this.scene.bodies[index] ?? null);
  }
}

// Returns the length of the box's diagonal.
function sizeOf(bounds: Box3): number {
  return bounds.getSize(new Vector3()).length();
}
