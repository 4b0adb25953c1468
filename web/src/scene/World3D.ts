// The 3D view, the only interface between three.js and the rest of the page. It draws frames only
// after changes. Screen positions are in CSS pixels of the page.
import type { Matrix4, Object3D, PerspectiveCamera } from "three";
import { Scene } from "three";
import type { SceneDescription } from "../api/scene";
import type { Expectation } from "../state/expectations";
import type { MarkerArrayMessage, PosesMessage, TransformsMessage } from "../protocol/messages";
import type { OverlayColours, Shown } from "../state/overlays";
import { FIRST_SHOWN } from "../state/overlays";
import type { Viewpoint } from "../state/link";
import type { Point, ViewMode } from "../state/State";
import { AmbientOcclusion } from "./AmbientOcclusion";
import type { ArrangerEvents } from "./Arranger";
import type { EditToolsEvents } from "./EditTools";
import { EditTools } from "./EditTools";
import { isAdding } from "./RectangleChoice";
import { Arranger } from "./Arranger";
import type { BodyLayer } from "./BodyLayer";
import { BodyPicker } from "./BodyPicker";
import { CollisionLayer } from "./CollisionLayer";
import { CameraRig } from "./CameraRig";
import { fenceOf } from "./fence";
import { Environment } from "./Environment";
import { environmentOf } from "./framing";
import { FrameRate } from "./FrameRate";
import { GhostLayer } from "./GhostLayer";
import type { ModelLibrary } from "./ModelLibrary";
import { OverlayLayers } from "./OverlayLayers";
import type { ScreenPlace } from "./picking";
import { onClick } from "./picking";
import { makeBareRenderer, makeRenderer } from "./renderer";
import { RenderLoop } from "./RenderLoop";
import { RobotPlaces } from "./RobotPlaces";
import type { RobotStates } from "./RobotSigns";
import { RobotSigns } from "./RobotSigns";
import { RobotWatch } from "./RobotWatch";
import { SceneParts } from "./SceneParts";
import { ShadowPace } from "./ShadowPace";
import { ShownPoses } from "./ShownPoses";
import { Surface } from "./Surface";
import type { DrawnView } from "../view/DrawnView";

// The limits on beams with and without a graphics card: without one, the beams of a crowd would
// take longer than everything else.
const MOST_BEAMS = 20_000;
const MOST_BEAMS_IN_SOFTWARE = 2000;
// A scene is first drawn together with its shapes, unless they take longer than this.
const LONGEST_WAIT_FOR_SHAPES_MS = 400;
// Poses for which no image comes from the server are shown after this time.
const LATE_POSES_MS = 150;

export interface WorldEvents extends Pick<ArrangerEvents, "onPlace">, Omit<EditToolsEvents, "onPlacePoint"> {
  onPick(robot: string | null): void;
  onModelsMissing(count: number): void;
  onProblem(sentence: string): void;
  onFrameRate(framesPerSecond: number): void;
  // called with each frame; the scale is that at the camera's target
  onScale(metresPerPixel: number): void;
  onGraphics(isThere: boolean): void; // the browser has removed WebGL, or restored it
}

export interface WorldOptions {
  library: ModelLibrary;
  inSoftware: boolean; // whether images are drawn without a graphics card
  fixedQuality: boolean;
  // whether there are an environment map, ambient occlusion and fitted shadows
  hasFineLight: boolean;
}

export class World3D {
  readonly canDraw: boolean; // whether the browser has WebGL 2
  private readonly surface: Surface;
  private readonly scene = new Scene();
  private readonly rig: CameraRig;
  private readonly library: ModelLibrary;
  private readonly loop: RenderLoop;
  private readonly picker: BodyPicker;
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
  private hasGraphics = true;
  private latePoses: ReturnType<typeof setTimeout> | undefined;
  private readonly frameRate: FrameRate;
  private readonly environment: Environment | null; // null: there is no environment map
  private readonly shadows = new ShadowPace();

  constructor(
    readonly host: HTMLElement,
    options: WorldOptions,
    private readonly events: WorldEvents,
  ) {
    const isFine = options.fixedQuality || !options.inSoftware;
    const gl = makeRenderer(isFine);
    this.canDraw = gl !== null;
    const occlusion = gl && options.hasFineLight ? new AmbientOcclusion(gl) : null;
    this.surface = new Surface(gl ?? makeBareRenderer(), options.fixedQuality, occlusion);
    this.environment = gl && options.hasFineLight ? new Environment(gl, this.scene) : null;
    this.overlays = new OverlayLayers(isFine ? MOST_BEAMS : MOST_BEAMS_IN_SOFTWARE, !isFine);
    const { canvas } = this.surface;
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
    this.picker = new BodyPicker({ host, camera: () => this.shownCamera, bodies: () => this.bodies, robots: () => this.watch.robots });
    this.arranger = new Arranger(this.arrangerView(), events);
    this.tools = new EditTools(this.toolsView(), { ...events, onPlacePoint: (point) => this.arranger.placeAt(point) });
    this.scene.add(this.ghosts.group, this.overlays.group, this.signs.marks.points, this.watch.ring.mesh, this.arranger.handle.group, this.tools.group);
    // the canvas is below the elements that lie over the image
    host.prepend(canvas, this.signs.labels.element);
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
    if (!this.surface.isDrawnByServer) return this.loop.request();
    // The server draws these poses too, and its image requests a frame. While the simulation is
    // paused, the poses may come after their image.
    clearTimeout(this.latePoses);
    this.latePoses = setTimeout(() => this.loop.request(), LATE_POSES_MS);
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

  setOverlayColours(colours: OverlayColours): void {
    this.overlays.setColours(colours);
    this.loop.request();
  }

  // Sets the states of the robots, and those that a filter selects.
  setStates(states: RobotStates): void {
    this.signs.setStates(states);
    this.loop.request();
  }

  // Sets the expectations, which are drawn at their places in the world.
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
    this.surface.drawBy(drawn, () => this.loop.request());
    this.refresh();
  }

  // The times from a state of the world to its image on the screen, in ms, of the last images of
  // the server.
  get imageDelaysMs(): readonly number[] {
    return this.surface.imageDelaysMs;
  }

  // Returns the present view with the names, as PNG.
  picture(): Promise<Blob> {
    this.draw(performance.now());
    return this.surface.picture((context) => {
      if (this.shown.labels) this.signs.labels.paint(context, this.surface.width);
    });
  }

  // Returns a stream of the view, without the names.
  video(): MediaStream {
    return this.surface.video();
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
    return this.picker.robotOnScreen(robot);
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
      canvas: this.surface.canvas,
      camera: this.rig.camera,
      orbit: this.rig.controls,
      bodies: () => this.bodies,
      robots: () => this.watch.robots,
      bodyAt: (at) => this.picker.robotAt(at) ?? this.picker.movableAt(at),
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
    this.environment?.show(scene.look);
    this.parts = new SceneParts(scene, this.scene, this.environment !== null);
    const { bodies, focus } = this.parts;
    this.watch.robots = new RobotPlaces(bodies, this.overlays.frames);
    this.signs.setRobots(this.watch.robots);
    this.overlays.setScene(bodies);
    this.collisions.setScene(scene);
    const environment = environmentOf(scene);
    if (this.framedFor !== environment) {
      this.rig.frame(focus, false);
      this.loop.await(LONGEST_WAIT_FOR_SHAPES_MS);
    }
    this.framedFor = environment;
    this.poses.setScene(bodies);
    if (this.lastBeams) this.takeBeams(this.lastBeams);
    this.parts.load(this.library, {
      onMissing: (count) => {
        this.signs.measure();
        this.refresh();
        if (count === 0) this.loop.hurry();
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
    this.surface.renewShadows();
    this.loop.request();
  }

  private setGraphics(isThere: boolean): void {
    this.hasGraphics = isThere;
    this.events.onGraphics(isThere);
    if (!isThere) return;
    this.environment?.renew();
    this.refresh();
  }

  private resize(): void {
    this.surface.resize(this.host.clientWidth, this.host.clientHeight);
    this.rig.resize(this.surface.width, this.surface.height);
    this.loop.request();
  }

  private tookFrame(milliseconds: number): void {
    this.shadows.frameTook(milliseconds);
    if (this.surface.frameTook(milliseconds)) this.loop.request();
  }

  // The camera of what is on the screen: images of the server show where the camera was.
  private get shownCamera(): PerspectiveCamera {
    return this.surface.drawnImage?.camera ?? this.rig.camera;
  }

  private showPoses(now: number): boolean {
    if (this.arranger.holds || this.tools.holds) return false;
    const stamp = this.surface.drawnImage?.stamp ?? null;
    return stamp === null ? this.poses.show(now) : this.poses.showAt(stamp);
  }

  private draw(now: number): boolean {
    if (!this.hasGraphics && !this.surface.isDrawnByServer) return false;
    this.surface.advance();
    if (this.showPoses(now)) {
      this.shadows.moved();
      this.watch.move();
    }
    const { width, height } = this.surface;
    const isFlying = this.rig.update(now);
    this.overlays.place(this.rig.camera.position);
    if (this.bodies) this.collisions.place(this.bodies);
    this.bodies?.chooseDetail(this.rig.camera, height);
    if (this.parts) this.parts.grid.visible = this.shown.grid;
    this.watch.showRing();
    this.arranger.showHandle();
    this.tools.show();
    const isMoving = !this.poses.isSettled(now);
    const isFitted = this.environment !== null && this.parts?.lights.fitShadow(this.rig.camera.position, this.rig.controls.target);
    if (this.shadows.areDue(isMoving) || isFitted) this.surface.renewShadows();
    this.surface.prepare();
    this.signs.placeMarks(this.shownCamera, height, this.surface.pixelRatio, this.shown);
    this.surface.render(this.scene, this.rig.camera, () => this.painted());
    this.signs.placeLabels(this.shownCamera, width, height, this.watch.selection, this.shown, isMoving);
    this.events.onScale(this.rig.metresPerPixel);
    this.frameRate.count(this.surface.images ?? this.frames, now);
    return isFlying || (isMoving && !this.surface.isDrawnByServer);
  }

  // The objects that the page draws over an image from the server.
  private painted(): Object3D[] {
    const { overlays, signs, watch, arranger, tools } = this;
    const objects: Object3D[] = [overlays.group, signs.marks.points, watch.ring.mesh, arranger.handle.group, tools.group];
    return this.parts && this.shown.grid ? [this.parts.grid, ...objects] : objects;
  }

  private click(place: ScreenPlace): void {
    if (this.tools.isHandleAt(place) || this.tools.click(place)) return;
    const robot = this.picker.robotAt(place);
    const added = robot === null && this.arranger.isOn ? this.picker.addedStaticAt(place) : null;
    const firm = added === this.watch.selection ? null : added;
    // In edit mode, a click beside all bodies keeps the selection, because the user wants to move
    // it.
    if (firm === null && robot === null && this.arranger.isOn && this.watch.selection !== null) return;
    this.events.onPick(firm ?? robot);
  }
}
