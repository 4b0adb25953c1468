// Where the robots of a scene are, as they are shown now: for labels, views and clicks.
import { Vector3 } from "three";
import type { SceneBody, SceneSensor } from "../api/scene";
import { hasAgent } from "../api/scene";
import type { BodyLayer } from "./BodyLayer";
import type { Subject } from "./CameraRig";
import type { Eye } from "./eye";
import { eyeAt } from "./eye";
import type { Labelled } from "./LabelLayer";
import type { SensorFrames } from "./SensorFrames";

const LOWEST_LABEL = 0.15; // m above the robot's origin
const SMALLEST_RING = 0.16; // m

export class RobotPlaces {
  private readonly robots: { name: string; body: number }[];

  constructor(
    private readonly bodies: BodyLayer,
    private readonly frames: SensorFrames,
  ) {
    this.robots = bodies.scene.bodies.flatMap((each, body) =>
      hasAgent(each) ? [{ name: each.name, body }] : [],
    );
  }

  get names(): string[] {
    return this.robots.map(({ name }) => name);
  }

  // The middle of its shape, in the world.
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
    const [x, y] = pose.elements; // its x axis
    return { position: new Vector3().setFromMatrixPosition(pose), middle, yaw: Math.atan2(y!, x!) };
  }

  // That of its first camera, else at the front of its top.
  eyeOf(robot: string): Eye | null {
    const body = this.bodies.indexOf(robot);
    const pose = this.bodies.poseOf(body);
    if (!pose) return null;
    const camera = cameraOf(this.bodies.scene.bodies[body]!);
    const mounted = camera && this.frames.worldFrom(robot, camera.name, this.bodies);
    if (mounted) return { worldFromEye: mounted, view: camera.view };
    return { worldFromEye: eyeAt(pose, this.bodies.templateOf(body)?.bounds ?? null), view: null };
  }

  labels(): Labelled[] {
    return this.robots.map(({ name, body }) => {
      const position = new Vector3().setFromMatrixPosition(this.bodies.poseOf(body)!);
      position.z += Math.max(LOWEST_LABEL, this.bodies.templateOf(body)?.bounds.max.z ?? 0);
      return { name, position };
    });
  }

  // The circle around it on the floor.
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
