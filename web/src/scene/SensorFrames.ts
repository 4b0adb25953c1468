// The poses of sensors from /tf_static: relative to their robot, or to one of its moving links.
import { Matrix4, Quaternion, Vector3 } from "three";
import type { TransformsMessage } from "../protocol/messages";
import type { BodyLayer } from "./BodyLayer";

interface Mount {
  parent: string; // "ROBOT/base_link", "STATION", or "ROBOT/LINK" for a moving link
  parentFromSensor: Matrix4;
}

const BASE = "base_link";
const UNIT_SCALE = new Vector3(1, 1, 1);

export class SensorFrames {
  private mounts = new Map<string, Mount>(); // by "ROBOT/SENSOR"

  take({ transforms }: TransformsMessage): void {
    this.mounts = new Map(
      transforms.map(({ header, child_frame_id: child, transform: { translation: t, rotation: q } }) => [
        child,
        {
          parent: header.frame_id,
          parentFromSensor: new Matrix4().compose(
            new Vector3(t.x, t.y, t.z),
            new Quaternion(q.x, q.y, q.z, q.w),
            UNIT_SCALE,
          ),
        },
      ]),
    );
  }

  // Returns the displayed pose of a sensor: world_from_sensor; null while it is unknown.
  worldFrom(robot: string, sensor: string, bodies: BodyLayer): Matrix4 | null {
    const mount = this.mounts.get(`${robot}/${sensor}`);
    const body = bodies.indexOf(robot);
    if (!mount || body < 0) return null;
    const link = mount.parent.slice(robot.length + 1);
    const parent = link === BASE || link === "" ? bodies.poseOf(body) : bodies.linkPoseOf(body, link);
    return parent && new Matrix4().multiplyMatrices(parent, mount.parentFromSensor);
  }
}
