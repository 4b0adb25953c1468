// The 3D view: the only place where three.js and the rest of the page meet. Frames are drawn when
// something changed. Positions on the screen are in CSS pixels of the page.
import type { Group, LineSegments, Matrix4 } from "three";
import { Box3, NeutralToneMapping, PCFShadowMap, Scene, Vector3, WebGLRenderer } from "three";
import type { SceneDescription } from "../api/scene";
import type { MarkerArrayMessage, PosesMessage, TransformsMessage } from "../protocol/messages";
import { seconds } from "../protocol/messages";
import type { Shown } from "../state/overlays";
import { FIRST_SHOWN } from "../state/overlays";
import type { ViewMode } from "../state/State";
import { BodyLayer, matrixOf } from "./BodyLayer";
import { CameraRig } from "./CameraRig";
import { focusOf } from "./framing";
import { SelectionRing, disposeGrid, makeGrid } from "./Ground";
import { LabelLayer } from "./LabelLayer";
import { disposeLights, makeLights } from "./LightRig";
import { ModelLibrary } from "./ModelLibrary";
import { OverlayLayers } from "./OverlayLayers";
import { PoseInterpolator } from "./PoseInterpolator";
import type { ScreenPlace } from "./picking";
import { nearest, onClick, rayThrough } from "./picking";
import { pngOf, videoOf } from "./capture";
import { Quality, drawsInSoftware } from "./Quality";
import { RenderLoop } from "./RenderLoop";
import { RobotPlaces } from "./RobotPlaces";
import { Sky } from "./Sky";

export interface WorldEvents {
  onPick(robot: string | null): void;
  onModelsMissing(count: number): void;
  onProblem(sentence: string): void;
  onFrameRate(framesPerSecond: number): void;
}

export interface WorldOptions {
  urlOfModel(id: string): string;
  fixedQuality: boolean;
}

const FRAME_RATE_WINDOW_MS = 1000;

// x y z of where one stands and of what one looks at.
export type Viewpoint = [number, number, number, number, number, number];

export class World3D {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly rig: CameraRig;
  private readonly library: ModelLibrary;
  private readonly loop: RenderLoop;
  private readonly quality: Quality;
  private readonly interpolator = new PoseInterpolator();
  private readonly overlays = new OverlayLayers();
  private readonly labels: LabelLayer;
  private readonly ring = new SelectionRing();
  private bodies: BodyLayer | null = null;
  private lights: Group | null = null;
  private grid: LineSegments | null = null;
  private sky: Sky | null = null;
  private focus = new Box3();
  private shownPoses = new Float64Array(0);
  private lastPoses: PosesMessage | null = null;
  private lastBeams: MarkerArrayMessage | null = null;
  private robots: RobotPlaces | null = null;
  private selection: string | null = null;
  private viewMode: ViewMode = "orbit";
  private shown: Shown = FIRST_SHOWN;
  private framedFor = ""; // the name of the scene that the camera was set up for
  private width = 1;
  private height = 1;
  private frameRateSince = { ms: 0, frames: 0 };

  // Throws where the browser has no WebGL 2.
  constructor(
    private readonly host: HTMLElement,
    options: WorldOptions,
    private readonly events: WorldEvents,
  ) {
    const canvas = document.createElement("canvas");
    canvas.setAttribute("aria-label", "The simulated world");
    canvas.setAttribute("role", "img");
    const antialias = options.fixedQuality || !drawsInSoftware();
    this.renderer = new WebGLRenderer({ canvas, antialias, powerPreference: "high-performance" });
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.quality = new Quality(devicePixelRatio, options.fixedQuality);
    this.library = new ModelLibrary((id) => options.urlOfModel(id));
    this.labels = new LabelLayer((name) => events.onPick(name));
    this.loop = new RenderLoop(
      (now) => this.draw(now),
      (took) => this.quality.frameTook(took) && this.resize(),
    );
    this.rig = new CameraRig(canvas, () => this.loop.request());
    this.scene.add(this.overlays.group, this.ring.mesh);
    host.append(canvas, this.labels.element);
    canvas.addEventListener("webglcontextrestored", () => this.refresh());
    onClick(canvas, (place) => events.onPick(this.robotAt(place)));
    new ResizeObserver(() => this.resize()).observe(host);
    this.resize();
  }

  get frames(): number {
    return this.loop.frames;
  }

  // Shows another scene, or none. The camera stays where it is when only the layout changed.
  setScene(scene: SceneDescription | null): void {
    this.clear();
    this.library.keepOnly(new Set(scene?.bodies.map(({ model }) => model)));
    if (scene) this.build(scene);
    else this.lastPoses = this.lastBeams = null;
    this.refresh();
  }

  setPoses(message: PosesMessage): void {
    this.lastPoses = message;
    if (!this.bodies || this.bodies.scene.layoutVersion !== message.layout_version) return;
    if (message.poses.length !== this.shownPoses.length) return;
    const sample = { step: Number(message.step), stamp: seconds(message.stamp), poses: message.poses };
    this.interpolator.push(sample, performance.now());
    this.overlays.takePoses(sample);
    this.loop.request();
  }

  setBeams(message: MarkerArrayMessage): void {
    this.lastBeams = message;
    this.takeBeams(message);
    this.loop.request();
  }

  setSensorFrames(message: TransformsMessage): void {
    this.overlays.takeFrames(message);
    this.updateRig();
    this.loop.request();
  }

  // A reading that is drawn in the world: points, contacts.
  setReading(topic: string, message: unknown): void {
    this.overlays.takeReading(topic, message);
    this.loop.request();
  }

  keepReadings(topics: ReadonlySet<string>): void {
    this.overlays.keepReadings(topics);
    this.loop.request();
  }

  select(robot: string | null): void {
    if (robot !== this.selection) this.rig.follow(null); // the next one is flown to
    this.selection = robot;
    this.overlays.select(robot);
    this.updateRig();
    this.loop.request();
  }

  setViewMode(mode: ViewMode): void {
    this.viewMode = mode;
    this.updateRig();
    this.loop.request();
  }

  show(shown: Shown): void {
    this.shown = shown;
    this.overlays.show(shown);
    this.labels.element.hidden = !shown.labels;
    this.loop.request();
  }

  topView(): void {
    this.rig.top(this.focus);
  }

  resetView(): void {
    this.rig.frame(this.focus, true);
  }

  // Where the eye stands and what it looks at, in metres; it stands there at once.
  get viewpoint(): Viewpoint {
    const { position, target } = this.rig.viewpoint;
    return [...position.toArray(), ...target.toArray()];
  }

  set viewpoint([x, y, z, tx, ty, tz]: Viewpoint) {
    this.rig.viewpoint = { position: new Vector3(x, y, z), target: new Vector3(tx, ty, tz) };
    this.loop.request();
  }

  // What is seen at present, with the names, as PNG.
  picture(): Promise<Blob> {
    this.draw(performance.now());
    return pngOf(this.renderer.domElement, (context) => {
      if (this.shown.labels) this.labels.paint(context, this.width);
    });
  }

  // What is seen from now on, without the names.
  video(): MediaStream {
    return videoOf(this.renderer.domElement);
  }

  // world_from_robot as last reported and its simulated time; null while unknown.
  latestPose(robot: string): { pose: Matrix4; stamp: number } | null {
    const { latest } = this.interpolator;
    const entry = this.bodies?.poseEntryOf(robot) ?? null;
    if (!latest || entry === null) return null;
    return { pose: matrixOf(latest.poses, 7 * entry), stamp: latest.stamp };
  }

  // Where a robot's middle is drawn on the page; null when it is not in the picture.
  screenPosition(robot: string): ScreenPlace | null {
    const middle = this.robots?.middleOf(robot);
    if (!middle) return null;
    const { x, y, z } = middle.project(this.rig.camera);
    if (z > 1 || Math.abs(x) > 1 || Math.abs(y) > 1) return null;
    const frame = this.host.getBoundingClientRect();
    return {
      x: frame.left + ((x + 1) / 2) * this.width,
      y: frame.top + ((1 - y) / 2) * this.height,
    };
  }

  private clear(): void {
    this.bodies?.dispose();
    this.bodies = null;
    if (this.lights) disposeLights(this.lights);
    this.lights = null;
    if (this.grid) disposeGrid(this.grid);
    this.grid = null;
    this.sky?.dispose();
    this.sky = null;
    this.interpolator.clear();
    this.overlays.setScene(null);
    this.robots = null;
  }

  private build(scene: SceneDescription): void {
    const bodies = new BodyLayer(scene);
    this.bodies = bodies;
    this.robots = new RobotPlaces(bodies, this.overlays.frames);
    this.overlays.setScene(bodies);
    this.focus = focusOf(scene);
    this.lights = makeLights(scene, this.focus);
    this.grid = makeGrid(this.focus);
    this.sky = new Sky(scene.look);
    this.scene.add(this.sky.mesh, bodies.group, this.lights, this.grid);
    this.shownPoses = new Float64Array(7 * scene.poses.length);
    if (this.framedFor !== scene.name) this.rig.frame(this.focus, false);
    this.framedFor = scene.name;
    if (this.lastPoses) this.setPoses(this.lastPoses);
    if (this.lastBeams) this.takeBeams(this.lastBeams);
    this.loadModels(bodies);
    this.updateRig();
  }

  private loadModels(bodies: BodyLayer): void {
    const links = new Map(bodies.scene.bodies.map((body) => [body.model, body.links]));
    let missing = links.size;
    this.events.onModelsMissing(missing);
    for (const [id, linkNames] of links) {
      void this.library
        .get(id, linkNames)
        .then((template) => this.bodies === bodies && bodies.addModel(id, template))
        .catch((error: Error) => this.events.onProblem(error.message))
        .finally(() => {
          if (this.bodies !== bodies) return;
          missing -= 1;
          this.refresh();
          this.events.onModelsMissing(missing);
        });
    }
  }

  private takeBeams(message: MarkerArrayMessage): void {
    const { interpolator } = this;
    this.overlays.takeBeams(message, (at) => interpolator.at(at) ?? interpolator.latest?.poses ?? null);
  }

  // Lets the eye do what the mode asks for, with the selected robot as it is shown now.
  private updateRig(): void {
    const { robots, selection, viewMode } = this;
    const robot = viewMode === "orbit" ? null : selection;
    const isEye = viewMode === "eye";
    this.rig.lookFrom((isEye && robot && robots?.eyeOf(robot)) || null);
    this.rig.follow((!isEye && robot && robots?.subjectOf(robot)) || null, viewMode === "chase");
  }

  private moveRig(robots: RobotPlaces): void {
    if (this.selection === null || this.viewMode === "orbit") return;
    const subject = robots.subjectOf(this.selection);
    if (this.viewMode === "eye") this.rig.lookFrom(robots.eyeOf(this.selection));
    else if (subject) this.rig.moveTo(subject);
  }

  private refresh(): void {
    this.renderer.shadowMap.needsUpdate = true;
    this.loop.request();
  }

  private resize(): void {
    this.width = Math.max(1, this.host.clientWidth);
    this.height = Math.max(1, this.host.clientHeight);
    this.renderer.setPixelRatio(this.quality.pixelRatio);
    this.renderer.setSize(this.width, this.height);
    this.rig.resize(this.width, this.height);
    this.loop.request();
  }

  private draw(now: number): boolean {
    if (this.bodies && this.interpolator.read(now, this.shownPoses)) this.showPoses(this.bodies);
    const isFlying = this.rig.update(now);
    this.overlays.place();
    if (this.grid) this.grid.visible = this.shown.grid;
    this.placeRing();
    this.renderer.render(this.scene, this.rig.camera);
    this.placeLabels();
    this.countFrame(now);
    return isFlying || !this.interpolator.isSettled(now);
  }

  private showPoses(bodies: BodyLayer): void {
    bodies.setPoses(this.shownPoses);
    this.renderer.shadowMap.needsUpdate = true;
    if (this.robots) this.moveRig(this.robots);
  }

  private placeRing(): void {
    const ring = this.selection === null ? null : this.robots?.ringOf(this.selection);
    if (ring && this.viewMode !== "eye") this.ring.place(ring.position, ring.radius);
    else this.ring.hide();
  }

  private placeLabels(): void {
    if (!this.shown.labels || !this.robots) return;
    this.labels.place(this.rig.camera, this.width, this.height, this.robots.labels(), this.selection);
  }

  private countFrame(now: number): void {
    const { ms, frames } = this.frameRateSince;
    if (now - ms < FRAME_RATE_WINDOW_MS) return;
    this.events.onFrameRate(((this.frames - frames) * 1000) / (now - ms));
    this.frameRateSince = { ms: now, frames: this.frames };
  }

  private robotAt(place: ScreenPlace): string | null {
    if (!this.bodies) return null;
    const hit = this.bodies.pick(rayThrough(place, this.host.getBoundingClientRect(), this.rig.camera));
    if (hit && (hit.isRobot || hit.isAvatar)) return hit.name;
    return nearest(
      place,
      (this.robots?.names ?? []).map((name) => ({ name, at: this.screenPosition(name) })),
    );
  }
}
