// Draws one frame of the view. Updates the objects that have moved, and draws the shadows again if
// they are due. Draws the scene, or draws overlays on an image of the server.
import type { Object3D, Scene } from "three";
import { PerspectiveCamera } from "three";
import type { Shown } from "../state/overlays";
import type { Arranger } from "./Arranger";
import type { CameraRig } from "./CameraRig";
import type { CollisionLayer } from "./CollisionLayer";
import type { EditTools } from "./EditTools";
import type { FrameRate } from "./FrameRate";
import type { GhostLayer } from "./GhostLayer";
import type { OverlayLayers } from "./OverlayLayers";
import type { RobotSigns } from "./RobotSigns";
import type { RobotFollower } from "./RobotFollower";
import type { SceneParts } from "./SceneParts";
import { ShadowPace } from "./ShadowPace";
import type { ShownPoses } from "./ShownPoses";
import type { Surface } from "./Surface";

export interface DrawnLayers {
  surface: Surface;
  root: Scene;
  rig: CameraRig;
  poses: ShownPoses;
  overlays: OverlayLayers;
  ghosts: GhostLayer;
  collisions: CollisionLayer;
  signs: RobotSigns;
  follower: RobotFollower;
  arranger: Arranger;
  tools: EditTools;
  frameRate: FrameRate;
  hasFineLight: boolean;
  parts(): SceneParts | null;
  frames(): number; // number of frames drawn so far
}

export class FrameDrawer {
  hasGraphics = true; // whether the browser can draw at present
  private readonly shadows = new ShadowPace();
  private readonly fitted = new PerspectiveCamera();

  constructor(private readonly layers: DrawnLayers) {}

  // The camera of the image on the screen. If the server has drawn the image, this is the camera at
  // the time of the request. If the aspect ratio of the view has changed since the request, the
  // image is as high as the view, and its sides are cut off or empty.
  get shownCamera(): PerspectiveCamera {
    const { surface, rig } = this.layers;
    const camera = surface.drawnImage?.camera;
    const aspect = surface.width / surface.height;
    if (!camera || Math.abs(camera.aspect - aspect) < 1e-3) return camera ?? rig.camera;
    this.fitted.copy(camera);
    this.fitted.aspect = aspect;
    this.fitted.updateProjectionMatrix();
    return this.fitted;
  }

  // Returns whether another frame must follow. `now` is a time in ms, as from performance.now().
  draw(now: number, shown: Shown): boolean {
    const { surface, root, rig, poses, overlays, collisions, signs, follower, arranger, tools, frameRate } = this.layers;
    if (!this.hasGraphics && !surface.isDrawnByServer) return false;
    const parts = this.layers.parts();
    surface.advance();
    if (this.showPoses(now)) {
      this.shadows.moved();
      follower.move();
    }
    const { width, height } = surface;
    const isFlying = rig.update(now);
    overlays.place(rig.camera.position);
    if (parts) collisions.place(parts.bodies);
    parts?.bodies.chooseDetail(rig.camera, height);
    if (parts) parts.grid.visible = shown.grid;
    follower.showRing();
    arranger.showHandle();
    tools.show();
    const isMoving = !poses.isSettled(now);
    const isFitted = this.layers.hasFineLight && parts?.lights.fitShadow(rig.camera.position, rig.controls.target);
    if (this.shadows.areDue(isMoving) || isFitted) surface.renewShadows();
    surface.prepare();
    signs.placeMarks(this.shownCamera, height, surface.pixelRatio, shown);
    surface.render(root, rig.camera, () => this.painted(parts, shown));
    signs.placeLabels(this.shownCamera, width, height, follower.selection, shown, isMoving);
    frameRate.count(surface.images ?? this.layers.frames(), now);
    return isFlying || (isMoving && !surface.isDrawnByServer);
  }

  // Returns whether the quality has changed, so that a frame must follow.
  tookFrame(milliseconds: number): boolean {
    this.shadows.frameTook(milliseconds);
    return this.layers.surface.frameTook(milliseconds);
  }

  private showPoses(now: number): boolean {
    const { arranger, tools, surface, poses } = this.layers;
    if (arranger.holds || tools.holds) return false;
    const stamp = surface.drawnImage?.stamp ?? null;
    return stamp === null ? poses.show(now) : poses.showAt(stamp);
  }

  // The objects that the page draws over an image from the server.
  private painted(parts: SceneParts | null, shown: Shown): Object3D[] {
    const { overlays, ghosts, collisions, signs, follower, arranger, tools } = this.layers;
    const objects: Object3D[] = [ghosts.group, overlays.group, signs.marks.points, follower.ring.mesh, arranger.handle.group, tools.group];
    if (collisions.group) objects.unshift(collisions.group);
    return parts && shown.grid ? [parts.grid, ...objects] : objects;
  }
}
