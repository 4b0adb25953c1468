// The 3D view. It is the only interface between three.js and the rest of the page. It draws frames
// only after changes. Screen positions are in CSS pixels of the page.
import type { Matrix4 } from "three";
import { Scene } from "three";
import type { SceneDescription } from "../api/scene";
import { LabelHover } from "../labels/LabelHover";
import type { ShownLabel } from "../labels/LabelLayer";
import { onLookChange } from "../labels/onLookChange";
import type { Points } from "../live/clouds";
import type { Expectation } from "../state/expectations";
import type { RobotBeams } from "../protocol/beams";
import type { PosesMessage, TransformsMessage } from "../protocol/messages";
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
import { FrameDrawer } from "./FrameDrawer";
import { FrameRate } from "./FrameRate";
import { GhostLayer } from "./GhostLayer";
import type { ModelLibrary } from "./ModelLibrary";
import { OverlayLayers } from "./OverlayLayers";
import type { ScreenPlace } from "./picking";
import { onClick } from "./picking";
import { makeBareRenderer, makeRenderer } from "./renderer";
import { RenderLoop } from "./RenderLoop";
import type { RobotStates } from "./RobotSigns";
import { RobotSigns } from "./RobotSigns";
import { RobotFollower } from "./RobotFollower";
import { SceneStage } from "./SceneStage";
import { ShownPoses } from "./ShownPoses";
import { Surface } from "./Surface";
import type { DrawnView } from "../view/DrawnView";

// The maximum number of beams that are drawn with a graphics card, and without a graphics card.
// Without a card, more beams would take longer than everything else.
const MOST_BEAMS = 20_000;
const MOST_BEAMS_IN_SOFTWARE = 2000;
// If the server draws the view, the page draws its own part of the view, such as the labels, this
// long after the last poses. It does so even if no new image has arrived.
const LATE_POSES_MS = 150;

export interface WorldEvents extends Pick<ArrangerEvents, "onPlace">, Omit<EditToolsEvents, "onPlacePoint"> {
  onPick(robot: string | null): void;
  onModelsMissing(count: number): void;
  onProblem(sentence: string): void;
  onFrameRate(framesPerSecond: number): void;
  // Called with each frame. The scale is the scale at the camera's target.
  onScale(metresPerPixel: number): void;
  onGraphics(isThere: boolean): void; // the browser has removed WebGL, or restored it
}

export interface WorldOptions {
  library: ModelLibrary;
  inSoftware: boolean; // whether images are drawn without a graphics card
  fixedQuality: boolean;
  // Whether there are an environment map, ambient occlusion and fitted shadows.
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
  private readonly hover: LabelHover;
  private readonly ghosts = new GhostLayer();
  private readonly follower: RobotFollower;
  private readonly arranger: Arranger;
  readonly tools: EditTools;
  private readonly stage: SceneStage;
  private readonly drawer: FrameDrawer;
  private shown: Shown = FIRST_SHOWN;
  private latePoses: ReturnType<typeof setTimeout> | undefined;
  private readonly environment: Environment | null; // null: there is no environment map

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
    this.signs = new RobotSigns(() => this.loop.request());
    this.hover = new LabelHover(canvas, this.signs.labels);
    this.loop = new RenderLoop(
      (now) => this.draw(now),
      (took) => {
        if (this.drawer.tookFrame(took)) this.loop.request();
      },
      gl ? fenceOf(gl.getContext() as WebGL2RenderingContext) : undefined,
    );
    this.rig = new CameraRig(
      canvas,
      () => this.loop.request(),
      (from, direction, far) => this.bodies?.freeAlong(from, direction, far) ?? Infinity,
    );
    this.follower = new RobotFollower(this.rig);
    this.picker = new BodyPicker({ host, camera: () => this.drawer.shownCamera, bodies: () => this.bodies, robots: () => this.follower.robots });
    this.arranger = new Arranger(this.arrangerView(), events);
    this.tools = new EditTools(this.toolsView(), { ...events, onPlacePoint: (point) => this.arranger.placeAt(point) });
    this.stage = this.makeStage();
    this.drawer = this.makeDrawer();
    this.scene.add(this.ghosts.group, this.overlays.group, this.signs.marks.points, this.follower.ring.mesh, this.arranger.handle.group, this.tools.group);
    // The canvas comes first in the host, so that the other elements lie over the image.
    host.prepend(canvas, this.signs.labels.element);
    for (const press of ["pointerdown", "pointerup", "keydown"] as const) {
      addEventListener(press, (event) => "repeat" in event && event.repeat ? undefined : this.loop.holdBack(), { capture: true });
    }
    // three.js itself requests the context again and sets it up.
    canvas.addEventListener("webglcontextlost", () => this.setGraphics(false));
    canvas.addEventListener("webglcontextrestored", () => this.setGraphics(true));
    onClick(canvas, (place) => this.click(place));
    new ResizeObserver(() => this.resize()).observe(host);
    onLookChange(() => {
      this.signs.labels.renewLook();
      this.loop.request();
    });
    this.resize();
  }

  // Whether the browser can draw at present. It may have lost WebGL.
  get hasGraphics(): boolean {
    return this.drawer.hasGraphics;
  }

  get frames(): number {
    return this.loop.frames;
  }

  // Whether a frame is being drawn or requested.
  get isDrawing(): boolean {
    return this.loop.isBusy;
  }

  // Shows another scene, or none. If only the layout has changed, the camera does not move.
  setScene(scene: SceneDescription | null): void {
    this.stage.setScene(scene);
  }

  setPoses(message: PosesMessage): void {
    this.poses.take(message);
    if (!this.surface.isDrawnByServer) return this.loop.request();
    // The server draws these poses too, and the arrival of its image requests a frame. While the
    // simulation is paused, the poses may arrive after their image. So a timer requests a frame.
    clearTimeout(this.latePoses);
    this.latePoses = setTimeout(() => this.loop.request(), LATE_POSES_MS);
  }

  setBeams(beams: readonly RobotBeams[]): void {
    this.stage.setBeams(beams);
    this.loop.request();
  }

  setSensorFrames(message: TransformsMessage): void {
    this.overlays.takeFrames(message);
    this.follower.update();
    this.loop.request();
  }

  // Shows the points of a lidar or depth camera.
  setPoints(topic: string, points: Points): void {
    this.overlays.takePoints(topic, points);
    this.loop.request();
  }

  // Shows a reading in the world: contacts or the state of an actuator.
  setReading(topic: string, message: unknown): void {
    this.overlays.takeReading(topic, message);
    this.loop.request();
  }

  keepReadings(topics: ReadonlySet<string>): void {
    this.overlays.keepReadings(topics);
    this.loop.request();
  }

  select(robot: string | null): void {
    this.follower.select(robot);
    this.overlays.select(robot);
    this.collisions.select(robot);
    this.loop.request();
  }

  // Sets the object that the user can move.
  choose(object: string | null): void {
    this.follower.choose(object);
    this.loop.request();
  }

  setViewMode(mode: ViewMode): void {
    this.follower.setMode(mode);
    this.loop.request();
  }

  // Sets whether the user may move bodies by hand. If `hasArrow` is true and there is no gizmo, an
  // arrow is shown that rotates the body.
  setArranging(isOn: boolean, hasArrow = true): void {
    this.arranger.isOn = isOn;
    this.arranger.hasArrow = hasArrow;
    this.signs.labels.isPickable = !isOn; // robots that the user moves may be behind labels
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

  // Sets the states of the robots, and the robots that a filter selects.
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
    this.stage.forgetBeams();
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
    if (this.stage.parts) this.rig.top(this.stage.parts.focus);
  }

  // Whether the view is a map: from above, north up.
  setMap(isOn: boolean): void {
    this.rig.setMap(isOn);
    this.refresh();
  }

  resetView(): void {
    if (this.stage.parts) this.rig.frame(this.stage.parts.focus, true);
  }

  // The point that the camera looks at, in metres in the world.
  get lookedAt(): { x: number; y: number } {
    const { x, y } = this.rig.controls.target;
    return { x, y };
  }

  // The position and target of the camera, in metres. Setting them moves the camera at once.
  get viewpoint(): Viewpoint {
    return this.rig.viewNumbers;
  }

  set viewpoint(numbers: Viewpoint) {
    this.rig.viewNumbers = numbers;
    this.loop.request();
  }

  // Shows images of the server from now on. With null, the browser draws again.
  drawBy(drawn: DrawnView | null): void {
    this.surface.drawBy(drawn, () => this.loop.request());
    this.refresh();
  }

  // The delays of the server's last images, in ms: from a state of the world to its image on the
  // screen.
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

  // Returns the last reported pose of a robot (world_from_robot), with its simulated time; null
  // while unknown.
  latestPose(robot: string): { pose: Matrix4; stamp: number } | null {
    return this.poses.latestOf(robot);
  }

  // Returns the last reported pose of any body: world_from_body; null while unknown.
  bodyPose(body: string): Matrix4 | null {
    return this.poses.reportedOf(body);
  }

  // The place on the page where a robot's centre is drawn; null if it is outside the view.
  screenPosition(robot: string): ScreenPlace | null {
    return this.picker.robotOnScreen(robot);
  }

  // The labels that are shown, the most important one first. The places are on the page.
  get labels(): ShownLabel[] {
    const { left, top } = this.host.getBoundingClientRect();
    return this.signs.labels.shown.map((label) => ({ ...label, x: left + label.x, y: top + label.y }));
  }

  // The place on the page where the tip of the selected robot's arrow is drawn.
  turnHandle(): ScreenPlace | null {
    return this.arranger.tipOnScreen();
  }

  private get bodies(): BodyLayer | null {
    return this.stage.parts?.bodies ?? null;
  }

  private makeStage(): SceneStage {
    const { scene: root, library, rig, loop, overlays, collisions, poses, signs, follower, environment } = this;
    return new SceneStage(
      { root, library, rig, loop, overlays, collisions, poses, signs, follower, environment },
      {
        onModelsMissing: (count) => this.events.onModelsMissing(count),
        onProblem: (sentence) => this.events.onProblem(sentence),
        onChange: () => this.refresh(),
      },
    );
  }

  private makeDrawer(): FrameDrawer {
    const { scene: root, surface, rig, poses, overlays, ghosts, collisions, signs, follower, arranger, tools, environment } = this;
    return new FrameDrawer({
      ...{ root, surface, rig, poses, overlays, ghosts, collisions, signs, follower, arranger, tools },
      frameRate: new FrameRate((rate) => this.events.onFrameRate(rate)),
      hasFineLight: environment !== null,
      parts: () => this.stage.parts,
      frames: () => this.frames,
    });
  }

  private draw(now: number): boolean {
    const follows = this.drawer.draw(now, this.shown);
    this.hover.update();
    this.events.onScale(this.rig.metresPerPixel);
    return follows;
  }

  private arrangerView(): ConstructorParameters<typeof Arranger>[0] {
    return {
      host: this.host,
      camera: this.rig.camera,
      bodies: () => this.bodies,
      robots: () => this.follower.robots,
      selection: () => this.follower.selection,
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
      robots: () => this.follower.robots,
      bodyAt: (at) => this.picker.robotAt(at) ?? this.picker.movableAt(at),
      pointAt: (at) => this.arranger.floorAt(at),
      redraw: () => this.refresh(),
    };
  }

  private refresh(): void {
    this.surface.renewShadows();
    this.loop.request();
  }

  private setGraphics(isThere: boolean): void {
    this.drawer.hasGraphics = isThere;
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

  private click(place: ScreenPlace): void {
    if (this.tools.click(place)) return;
    const { left, top } = this.host.getBoundingClientRect();
    const label = this.signs.labels.at(place.x - left, place.y - top);
    if (label !== null) return this.events.onPick(label);
    const robot = this.picker.robotAt(place);
    const added = robot === null && this.arranger.isOn ? this.picker.addedStaticAt(place) : null;
    const firm = added === this.follower.selection ? null : added;
    // In edit mode, a click outside of all bodies does not change the selection, because the user
    // wants to move the selected body.
    if (firm === null && robot === null && this.arranger.isOn && this.follower.selection !== null) return;
    this.events.onPick(firm ?? robot ?? (this.arranger.isOn ? null : this.picker.objectAt(place)));
  }
}
