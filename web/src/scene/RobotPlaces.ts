// The places of a scene's robots, as they are displayed: for labels, views and clicks.
import { Vector3 } from "three";
import type { SceneBody, SceneSensor } from "../api/scene";
import { hasAgent } from "../api/scene";
import { POSE_NUMBERS } from "./BodyFrames";
import type { BodyLayer } from "./BodyLayer";
import type { Subject } from "./CameraRig";
import type { Eye } from "./eye";
import { eyeAt } from "./eye";
import type { SensorFrames } from "./SensorFrames";

const LOWEST_LABEL = 0.15; // m: minimum height of a label above the robot's origin
const SMALLEST_RING = 0.16; // m

export class RobotPlaces {
  readonly names: readonly string[];
  private readonly robots: { name: string; body: number; frame: number }[];
  private readonly places: Float64Array;
  private readonly heights: Float64Array; // heights of the labels above the robots' origins, m

  constructor(
    private readonly bodies: BodyLayer,
    private readonly frames: SensorFrames,
  ) {
    this.robots = bodies.scene.bodies.flatMap((each, body) =>
      hasAgent(each) ? [{ name: each.name, body, frame: bodies.frames.frameOf(body) }] : [],
    );
    this.names = this.robots.map(({ name }) => name);
    this.places = new Float64Array(3 * this.robots.length);
    this.heights = new Float64Array(this.robots.length);
    this.measure();
  }

  // Returns the centre of the robot's shape in the world.
  middleOf(robot: string): Vector3 | null {
    const body = this.bodies.indexOf(robot);
    const pose = this.bodies.poseOf(body);
    if (!pose) return null;
    const bounds = this.bodies.templateOf(body)?.bounds;
    const middle = bounds && !bounds.isEmpty() ? bounds.getCenter(new Vector3()) : new Vector3();
    return middle.applyMatrix4(pose);
  }

  subjectOf(robot: string): Subject | null {
    const middle = this.middleOf(robot);
    const pose = this.bodies.poseOf(this.bodies.indexOf(robot));
    if (!middle || !pose) return null;
    const [x, y] = pose.elements; // the robot's x axis
    return { position: new Vector3().setFromMatrixPosition(pose), middle, yaw: Math.atan2(y!, x!) };
  }

  // Returns the pose of the robot's first camera. If it has no camera, returns a pose at the front
  // of its top.
  eyeOf(robot: string): Eye | null {
    const body = this.bodies.indexOf(robot);
    const pose = this.bodies.poseOf(body);
    if (!pose) return null;
    const camera = cameraOf(this.bodies.scene.bodies[body]!);
    const mounted = camera && this.frames.worldFrom(robot, camera.name, this.bodies);
    if (mounted) return { worldFromEye: mounted, view: camera.view };
    return { worldFromEye: eyeAt(pose, this.bodies.templateOf(body)?.bounds ?? null), view: null };
  }

  // Call this when shapes have arrived.
  measure(): void {
    this.robots.forEach(({ body }, i) => {
      this.heights[i] = Math.max(LOWEST_LABEL, this.bodies.templateOf(body)?.bounds.max.z ?? 0);
    });
  }

  // Returns x y z above each robot, in the order of the names. Each call overwrites the result.
  tops(): Float64Array {
    const { places, heights, robots } = this;
    const { numbers } = this.bodies.frames;
    for (let i = 0; i < robots.length; i++) {
      const at = POSE_NUMBERS * robots[i]!.frame;
      places[3 * i] = numbers[at]!;
      places[3 * i + 1] = numbers[at + 1]!;
      places[3 * i + 2] = numbers[at + 2]! + heights[i]!;
    }
    return places;
  }

  // Returns half of each robot's diagonal in metres. While a robot's shape is not loaded, this is
  // half the diagonal of a small robot.
  radii(): Float64Array {
    return Float64Array.from(this.robots, ({ body }) => {
      const bounds = this.bodies.templateOf(body)?.bounds;
      return bounds && !bounds.isEmpty() ? bounds.getSize(new Vector3()).length() / 2 : SMALLEST_RING;
    });
  }

  // Returns the circle around the robot on the floor.
  ringOf(robot: string): { position: Vector3; radius: number } | null {
    const body = this.bodies.indexOf(robot);
    const pose = this.bodies.poseOf(body);
    if (!pose) return null;
    const size = this.bodies.templateOf(body)?.bounds.getSize(new Vector3());
    const radius = size ? 0.6 * Math.hypot(size.x, size.y) : 0;
    return {
      position: new Vector3().setFromMatrixPosition(pose),
      radius: Math.max(SMALLEST_RING, radius),
    };
  }
}

function cameraOf({ sensors }: SceneBody): SceneSensor | null {
  return sensors.find(({ overlay }) => overlay === "picture") ?? null;
}
