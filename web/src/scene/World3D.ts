// The 3D view, the only interface between three.js and the rest of the page. It draws frames only
// after changes. Screen positions are in CSS pixels of the page.
import type { Matrix4, Object3D } from "three";
import { Scene } from "three";
import type { SceneDescription } from "../api/scene";
import { hasAgent } from "../api/scene";
import type { Expectation } from "../state/expectations";
import type { MarkerArrayMessage, PosesMessage, TransformsMessage } from "../protocol/messages";
import type { Shown } from "../state/overlays";
import { FIRST_SHOWN } from "../state/overlays";
import type { Viewpoint } from "../state/link";
import type { Point, ViewMode } from "../state/State";
import type { ArrangerEvents } from "./Arranger";
import type { EditToolsEvents } from "./EditTools";
import { EditTools } from "./EditTools";
import { isAdding } from "./RectangleChoice";
import { Arranger } from "./Arranger";
import type { BodyLayer } from "./BodyLayer";
import { CollisionLayer } from "./CollisionLayer";
import { CameraRig } from "./CameraRig";
import { fenceOf } from "./fence";
import { environmentOf } from "./framing";
import { FrameRate } from "./FrameRate";
import { GhostLayer } from "./GhostLayer";
import type { ModelLibrary } from "./ModelLibrary";
import { OverlayLayers } from "./OverlayLayers";
import type { ScreenPlace } from "./picking";
import { nearest, onClick, rayThrough, screenPlaceOf } from "./picking";
import { pngOf, videoOf } from "./capture";
import { Quality } from "./Quality";
import type { ViewRenderer } from "./renderer";
import { makeBareRenderer, makeRenderer } from "./renderer";
import { RenderLoop } from "./RenderLoop";
import { RobotPlaces } from "./RobotPlaces";
import type { RobotStates } from "./RobotSigns";
import { RobotSigns } from "./RobotSigns";
import { RobotWatch } from "./RobotWatch";
import { SceneParts } from "./SceneParts";
import { ShadowPace } from "./ShadowPace";
import { ShownPoses } from "./ShownPoses";
import type { DrawnView } from "../view/DrawnView";

// Settings with and without a graphics card: without one, the beams of a crowd would take longer
// than everything else.
const MOST_BEAMS = 20_000;
const MOST_BEAMS_IN_SOFTWARE = 2000;

export interface WorldEvents extends Pick<ArrangerEvents, "onPlace">, Omit<EditToolsEvents, "onPlacePoint"> {
  onPick(robot: string | null): void;
  onModelsMissing(count: number): void;
  onProblem(sentence: string): void;
  onFrameRate(framesPerSecond: number): void;
  onScale(metresPerPixel: number): void; // at what one looks at; with each picture
  onGraphics(isThere: boolean): void; // the browser has taken WebGL away, or given it back
}

export interface WorldOptions {
  library: ModelLibrary;
  inSoftware: boolean; // no graphics card draws
  fixedQuality: boolean;
}

export class World3D {
  readonly canDraw: boolean; // the browser has WebGL 2
  private readonly renderer: ViewRenderer;
  private drawn: DrawnView | null = null; // not null: the server draws
  private readonly scene = new Scene();
  private readonly rig: CameraRig;
  private readonly library: ModelLibrary;
  private readonly loop: RenderLoop;
  private readonly quality: Quality;
  private readonly overlays: OverlayLayers;
  private readonly collisions: CollisionLayer;
  private readonly poses = new ShownPoses((sample) => this.overlays.takePoses(sample));
  private readonly signs: RobotSigns;
  private readonly ghosts = new GhostLayer();
  private readonly watch: RobotWatch;
  private readonly arranger: Arranger;
  readonly tools: EditTools;
  private parts: SceneParts | null = null;
  private lastBeams: MarkerArrayMessage | null = null;
  private shown: Shown = FIRST_SHOWN;
  private framedFor = ""; // the environment that the camera was set up for
  private width = 1;
  private height = 1;
  private isResized = false; // since the last frame
  private hasGraphics = true;
  private readonly frameRate: FrameRate;
  private readonly shadows = new ShadowPace();

  constructor(
    readonly host: HTMLElement,
    options: WorldOptions,
    private readonly events: WorldEvents,
  ) {
    const isFine = options.fixedQuality || !options.inSoftware;
    const gl = makeRenderer(isFine);
    this.canDraw = gl !== null;
    this.renderer = gl ?? makeBareRenderer();
    this.overlays = new OverlayLayers(isFine ? MOST_BEAMS : MOST_BEAMS_IN_SOFTWARE, !isFine);
    const canvas = this.renderer.domElement;
    this.quality = new Quality(devicePixelRatio, options.fixedQuality);
    this.library = options.library;
    this.collisions = new CollisionLayer(this.scene, this.library, {
      onChange: () => this.loop.request(),
      onProblem: (sentence) => events.onProblem(sentence),
    });
    this.frameRate = new FrameRate((rate) => events.onFrameRate(rate));
    this.signs = new RobotSigns((name) => events.onPick(name));
    this.loop = new RenderLoop(
      (now) => this.draw(now),
      (took) => this.tookFrame(took),
      gl ? fenceOf(gl.getContext() as WebGL2RenderingContext) : undefined,
    );
    this.rig = new CameraRig(
      canvas,
      () => this.loop.request(),
      (from, direction, far) => this.bodies?.freeAlong(from, direction, far) ?? Infinity,
    );
    this.watch = new RobotWatch(this.rig);
    this.arranger = new Arranger(this.arrangerView(), events);
    this.tools = new EditTools(this.toolsView(), { ...events, onPlacePoint: (point) => this.arranger.placeAt(point) });
    this.scene.add(this.ghosts.group, this.overlays.group, this.signs.marks.points, this.watch.ring.mesh, this.arranger.handle.group, this.tools.group);
    host.prepend(canvas, this.signs.labels.element); // below what lies over the picture
    for (const press of ["pointerdown", "pointerup", "keydown"] as const) {
      addEventListener(press, (event) => "repeat" in event && event.repeat ? undefined : this.loop.holdBack(), { capture: true });
    }
    // three.js itself requests the context again and sets it up.
    canvas.addEventListener("webglcontextlost", () => this.setGraphics(false));
    canvas.addEventListener("webglcontextrestored", () => this.setGraphics(true));
    onClick(canvas, (place) => this.click(place));
    new ResizeObserver(() => this.resize()).observe(host);
    this.resize();
  }

  get frames(): number {
    return this.loop.frames;
  }

  // Whether a frame is being drawn or requested.
  get isDrawing(): boolean {
    return this.loop.isBusy;
  }

  // Shows another scene, or none. If only the layout has changed, the camera stays where it is.
  setScene(scene: SceneDescription | null): void {
    this.clear();
    this.library.keepOnly(new Set(scene?.bodies.flatMap(({ model, collisions }) => [model, collisions ?? model])));
    if (!scene) this.lastBeams = null;
    if (scene) this.build(scene);
    else this.poses.setScene(null);
    this.refresh();
  }

  setPoses(message: PosesMessage): void {
    this.poses.take(message);
    this.loop.request();
  }

  setBeams(message: MarkerArrayMessage): void {
    this.lastBeams = message;
    this.takeBeams(message);
    this.loop.request();
  }

  setSensorFrames(message: TransformsMessage): void {
    this.overlays.takeFrames(message);
    this.watch.update();
    this.loop.request();
  }

  // Shows a reading in the world: points or contacts.
  setReading(topic: string, message: unknown): void {
    this.overlays.takeReading(topic, message);
    this.loop.request();
  }

  keepReadings(topics: ReadonlySet<string>): void {
    this.overlays.keepReadings(topics);
    this.loop.request();
  }

  select(robot: string | null): void {
    this.watch.select(robot);
    this.overlays.select(robot);
    this.collisions.select(robot);
    this.loop.request();
  }

  // Sets the object that the user can move.
  choose(object: string | null): void {
    this.watch.choose(object);
    this.loop.request();
  }

  setViewMode(mode: ViewMode): void {
    this.watch.setMode(mode);
    this.loop.request();
  }

  // Sets whether the user may move bodies by hand. `hasArrow`: with an arrow that rotates the body,
  // if there is no gizmo.
  setArranging(isOn: boolean, hasArrow = true): void {
    this.arranger.isOn = isOn;
    this.arranger.hasArrow = hasArrow;
    this.signs.labels.element.classList.toggle("in-the-way", isOn);
    this.loop.request();
  }

  show(shown: Shown): void {
    this.shown = shown;
    this.overlays.show(shown);
    this.collisions.show(shown.collisions);
    this.signs.labels.element.hidden = !shown.labels;
    this.loop.request();
  }

  // Shows the points of a ruler or a wall.
  showPoints(points: readonly Point[]): void {
    this.tools.marks.show(points);
    this.loop.request();
  }

  // Sets the states of the robots, and those that a filter selects.
  setStates(states: RobotStates): void {
    this.signs.setStates(states);
    this.loop.request();
  }

  // Sets the expectations, which are drawn at their places.
  setExpectations(expectations: readonly Expectation[]): void {
    this.overlays.expectations.set(expectations);
    this.loop.request();
  }

  // Removes the beams of a topic that is no longer read.
  forgetBeams(): void {
    this.lastBeams = null;
    this.overlays.forgetBeams();
    this.loop.request();
  }

  // Shows the robots of a second recording, whose models are in `library`; null: none.
  setGhosts(scene: SceneDescription | null, library: ModelLibrary): void {
    this.ghosts.setScene(scene, library, () => this.loop.request());
    this.loop.request();
  }

  setGhostPoses(layoutVersion: number, poses: Float64Array): void {
    this.ghosts.setPoses(layoutVersion, poses);
    this.loop.request();
  }

  // The place where the ghost of a robot is drawn, in metres in the world; null: there is no ghost.
  ghostPlace(robot: string): [number, number, number] | null {
    return this.ghosts.placeOf(robot);
  }

  topView(): void {
    if (this.parts) this.rig.top(this.parts.focus);
  }

  // Whether the view is a map: from above, north up.
  setMap(isOn: boolean): void {
    this.rig.setMap(isOn);
    this.refresh();
  }

  resetView(): void {
    if (this.parts) this.rig.frame(this.parts.focus, true);
  }

  // Moves the camera at once: its position and target, in metres.
  get viewpoint(): Viewpoint {
    return this.rig.viewNumbers;
  }

  set viewpoint(numbers: Viewpoint) {
    this.rig.viewNumbers = numbers;
    this.loop.request();
  }

  // Shows images of the server from now on; null: the browser draws.
  drawBy(drawn: DrawnView | null): void {
    this.drawn?.dispose();
    this.drawn = drawn;
    if (drawn) this.renderer.domElement.after(drawn.canvas);
    this.refresh();
  }

  private get surface(): HTMLCanvasElement {
    return this.drawn?.canvas ?? this.renderer.domElement;
  }

  // The present view with the names, as PNG.
  picture(): Promise<Blob> {
    this.draw(performance.now());
    return pngOf(this.surface, (context) => {
      if (this.shown.labels) this.signs.labels.paint(context, this.width);
    });
  }

  // A stream of the view, without the names.
  video(): MediaStream {
    return videoOf(this.surface);
  }

  // world_from_robot as last reported, with its simulated time; null while unknown.
  latestPose(robot: string): { pose: Matrix4; stamp: number } | null {
    return this.poses.latestOf(robot);
  }

  // world_from_body of any body; null while unknown.
  bodyPose(body: string): Matrix4 | null {
    const index = this.bodies?.indexOf(body) ?? -1;
    return this.poses.latestOf(body)?.pose ?? this.bodies?.poseOf(index) ?? null;
  }

  // The place on the page where a robot's centre is drawn; null if it is outside the view.
  screenPosition(robot: string): ScreenPlace | null {
    const middle = this.watch.robots?.middleOf(robot);
    if (!middle) return null;
    return screenPlaceOf(middle, this.rig.camera, this.host.getBoundingClientRect());
  }

  // The place on the page where the tip of the selected robot's arrow is drawn.
  turnHandle(): ScreenPlace | null {
    return this.arranger.tipOnScreen();
  }

  private get bodies(): BodyLayer | null {
    return this.parts?.bodies ?? null;
  }

  private arrangerView(): ConstructorParameters<typeof Arranger>[0] {
    return {
      host: this.host,
      camera: this.rig.camera,
      bodies: () => this.bodies,
      robots: () => this.watch.robots,
      selection: () => this.watch.selection,
      isTaken: (event) => isAdding(event) || this.tools.clickUse !== "choose" || this.tools.isHandleAt({ x: event.clientX, y: event.clientY }),
      redraw: () => this.refresh(),
    };
  }

  private toolsView(): ConstructorParameters<typeof EditTools>[0] {
    return {
      host: this.host,
      canvas: this.renderer.domElement,
      camera: this.rig.camera,
      orbit: this.rig.controls,
      bodies: () => this.bodies,
      robots: () => this.watch.robots,
      bodyAt: (at) => this.robotAt(at) ?? this.movableAt(at),
      pointAt: (at) => this.arranger.floorAt(at),
      redraw: () => this.refresh(),
    };
  }

  private clear(): void {
    this.parts?.dispose();
    this.parts = null;
    this.overlays.setScene(null);
    this.collisions.setScene(null);
    this.watch.robots = null;
    this.signs.setRobots(null);
  }

  private build(scene: SceneDescription): void {
    this.parts = new SceneParts(scene, this.scene);
    const { bodies, focus } = this.parts;
    this.watch.robots = new RobotPlaces(bodies, this.overlays.frames);
    this.signs.setRobots(this.watch.robots);
    this.overlays.setScene(bodies);
    this.collisions.setScene(scene);
    const environment = environmentOf(scene);
    if (this.framedFor !== environment) this.rig.frame(focus, false);
    this.framedFor = environment;
    this.poses.setScene(bodies);
    if (this.lastBeams) this.takeBeams(this.lastBeams);
    this.parts.load(this.library, {
      onMissing: (count) => {
        this.signs.measure();
        this.refresh();
        this.events.onModelsMissing(count);
      },
      onProblem: (sentence) => this.events.onProblem(sentence),
    });
    this.watch.update();
  }

  private takeBeams(message: MarkerArrayMessage): void {
    this.overlays.takeBeams(message, (at) => this.poses.at(at));
  }

  private refresh(): void {
    this.renderer.shadowMap.needsUpdate = true;
    this.loop.request();
  }

  private setGraphics(isThere: boolean): void {
    this.hasGraphics = isThere;
    this.events.onGraphics(isThere);
    if (isThere) this.refresh();
  }

  private resize(): void {
    this.width = Math.max(1, this.host.clientWidth);
    this.height = Math.max(1, this.host.clientHeight);
    this.rig.resize(this.width, this.height);
    this.isResized = true;
    this.loop.request();
  }

  // Called just before a frame is drawn, because a canvas that gets another size is empty until
  // then.
  private resizeCanvas(): void {
    if (!this.isResized) return;
    this.isResized = false;
    this.renderer.setPixelRatio(this.quality.pixelRatio);
    this.renderer.setSize(this.width, this.height);
  }

  private tookFrame(milliseconds: number): void {
    this.shadows.frameTook(milliseconds);
    if (this.quality.frameTook(milliseconds)) this.resize();
  }

  private draw(now: number): boolean {
    if (!this.hasGraphics && !this.drawn) return false;
    if (!this.arranger.holds && !this.tools.holds && this.poses.show(now)) {
      this.shadows.moved();
      this.watch.move();
    }
    const isFlying = this.rig.update(now);
    this.overlays.place(this.rig.camera.position);
    if (this.bodies) this.collisions.place(this.bodies);
    this.bodies?.chooseDetail(this.rig.camera, this.height);
    if (this.parts) this.parts.grid.visible = this.shown.grid;
    this.watch.showRing();
    this.arranger.showHandle();
    this.tools.show();
    const isMoving = !this.poses.isSettled(now);
    if (this.shadows.areDue(isMoving)) this.renderer.shadowMap.needsUpdate = true;
    this.resizeCanvas();
    this.signs.placeMarks(this.rig.camera, this.height, this.renderer.getPixelRatio(), this.shown);
    this.render();
    this.signs.placeLabels(this.rig.camera, this.width, this.height, this.watch.selection, this.shown);
    this.events.onScale(this.rig.metresPerPixel);
    this.frameRate.count(this.drawn?.images ?? this.frames, now);
    return isFlying || isMoving;
  }

  private render(): void {
    if (!this.drawn) return this.renderer.render(this.scene, this.rig.camera);
    const { overlays, signs, watch, arranger, tools } = this;
    const painted: Object3D[] = [overlays.group, signs.marks.points, watch.ring.mesh, arranger.handle.group, tools.group];
    if (this.parts && this.shown.grid) painted.unshift(this.parts.grid);
    this.drawn.show(this.rig.camera, this.width, this.height, painted);
  }

  private click(place: ScreenPlace): void {
    if (this.tools.isHandleAt(place) || this.tools.click(place)) return;
    const robot = this.robotAt(place);
    const firm = robot === null ? this.firmAt(place) : null;
    // In edit mode, a click beside all bodies keeps the selection, because the user wants to move
    // it.
    if (firm === null && robot === null && this.arranger.isOn && this.watch.selection !== null) return;
    this.events.onPick(firm ?? robot);
  }

  private movableAt(place: ScreenPlace): string | null {
    const hit = this.bodies?.pick(rayThrough(place, this.host.getBoundingClientRect(), this.rig.camera));
    return hit && !hit.isFixed ? hit.name : null;
  }

  // An object that was placed by the user, so that it can be removed again.
  private firmAt(place: ScreenPlace): string | null {
    if (!this.arranger.isOn) return null;
    const ray = rayThrough(place, this.host.getBoundingClientRect(), this.rig.camera);
    const hit = this.bodies?.pick(ray);
    return hit?.isStatic && !hit.isFixed && hit.name !== this.watch.selection ? hit.name : null;
  }

  private robotAt(place: ScreenPlace): string | null {
    if (!this.bodies) return null;
    const hit = this.bodies.pick(rayThrough(place, this.host.getBoundingClientRect(), this.rig.camera));
    if (hit && hasAgent(hit)) return hit.name;
    return nearest(
      place,
      (this.watch.robots?.names ?? []).map((name) => ({ name, at: this.screenPosition(name) })),
    );
  }
}
