// Sets up the view for a scene: its bodies, lights, overlays and collision shapes, and the camera.
import type { Scene } from "three";
import type { SceneDescription } from "../api/scene";
import type { RobotBeams } from "../protocol/beams";
import type { CameraRig } from "./CameraRig";
import type { CollisionLayer } from "./CollisionLayer";
import type { Environment } from "./Environment";
import { environmentOf } from "./framing";
import type { ModelLibrary } from "./ModelLibrary";
import type { OverlayLayers } from "./OverlayLayers";
import type { RenderLoop } from "./RenderLoop";
import { RobotPlaces } from "./RobotPlaces";
import type { RobotSigns } from "./RobotSigns";
import type { RobotFollower } from "./RobotFollower";
import { SceneParts } from "./SceneParts";
import type { ShownPoses } from "./ShownPoses";

// A scene is first drawn when its shapes have arrived, or after this time.
const LONGEST_WAIT_FOR_SHAPES_MS = 400;

// The layers of the view, which are the same for all scenes.
export interface StageLayers {
  root: Scene;
  library: ModelLibrary;
  rig: CameraRig;
  loop: RenderLoop;
  overlays: OverlayLayers;
  collisions: CollisionLayer;
  poses: ShownPoses;
  signs: RobotSigns;
  follower: RobotFollower;
  environment: Environment | null; // null: there is no environment map
}

export interface StageEvents {
  onModelsMissing(count: number): void;
  onProblem(sentence: string): void;
  onChange(): void; // called when the view must be drawn again, with new shadows
}

export class SceneStage {
  parts: SceneParts | null = null; // the parts of the present scene
  private lastBeams: readonly RobotBeams[] | null = null;
  private framedFor = ""; // the environment that the camera was set up for

  constructor(
    private readonly layers: StageLayers,
    private readonly events: StageEvents,
  ) {}

  // Shows another scene, or none. If only the layout has changed, the camera does not move.
  setScene(scene: SceneDescription | null): void {
    this.clear();
    this.layers.library.keepOnly(new Set(scene?.bodies.flatMap(({ model, collisions }) => [model, collisions ?? model])));
    if (!scene) this.lastBeams = null;
    if (scene) this.build(scene);
    else this.layers.poses.setScene(null);
    this.events.onChange();
  }

  setBeams(beams: readonly RobotBeams[]): void {
    this.lastBeams = beams;
    this.takeBeams(beams);
  }

  // Removes the beams of a topic that is no longer read.
  forgetBeams(): void {
    this.lastBeams = null;
    this.layers.overlays.forgetBeams();
  }

  private clear(): void {
    const { overlays, collisions, follower, signs } = this.layers;
    this.parts?.dispose();
    this.parts = null;
    overlays.setScene(null);
    collisions.setScene(null);
    follower.robots = null;
    signs.setRobots(null);
  }

  private build(scene: SceneDescription): void {
    const { root, library, rig, loop, overlays, collisions, poses, signs, follower, environment } = this.layers;
    environment?.show(scene.look);
    this.parts = new SceneParts(scene, root, environment !== null);
    const { bodies, focus } = this.parts;
    follower.robots = new RobotPlaces(bodies, overlays.frames);
    signs.setRobots(follower.robots);
    overlays.setScene(bodies);
    collisions.setScene(scene);
    const place = environmentOf(scene);
    if (this.framedFor !== place) {
      rig.frame(focus, false);
      loop.await(LONGEST_WAIT_FOR_SHAPES_MS);
    }
    this.framedFor = place;
    poses.setScene(bodies);
    if (this.lastBeams) this.takeBeams(this.lastBeams);
    this.parts.load(library, {
      onMissing: (count) => {
        signs.measure();
        this.events.onChange();
        if (count === 0) loop.hurry();
        this.events.onModelsMissing(count);
      },
      onProblem: (sentence) => this.events.onProblem(sentence),
    });
    follower.update();
  }

  private takeBeams(beams: readonly RobotBeams[]): void {
    this.layers.overlays.takeBeams(beams, (at) => this.layers.poses.at(at));
  }
}
