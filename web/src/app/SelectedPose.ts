// Follows the pose of the selected robot for the inspector, at a pace that can be read.
import { Quaternion, Vector3 } from "three";
import type { Matrix4 } from "three";
import type { RobotPose } from "../state/State";

export const SHORTEST_UPDATE_MS = 100;
const SPEED_WINDOW_S = 0.2; // simulated
const LONGEST_WINDOW_S = 3; // longer than an update at ten times real time; beyond, it was a jump

export interface StampedPose {
  pose: Matrix4;
  stamp: number; // s, simulated
}

export class SelectedPose {
  private robot: string | null = null;
  private updatedMs = -Infinity;
  private from: { position: Vector3; stamp: number } | null = null;
  private speed = 0;

  // Gives what to show, or null when it is too early for the next value.
  update(robot: string, latest: StampedPose, nowMs: number): RobotPose | null {
    if (robot !== this.robot) this.start(robot);
    if (nowMs - this.updatedMs < SHORTEST_UPDATE_MS) return null;
    this.updatedMs = nowMs;
    const position = new Vector3().setFromMatrixPosition(latest.pose);
    this.measureSpeed(position, latest.stamp);
    return { x: position.x, y: position.y, z: position.z, yaw: yawOf(latest.pose), speed: this.speed };
  }

  private start(robot: string): void {
    this.robot = robot;
    this.updatedMs = -Infinity;
    this.from = null;
    this.speed = 0;
  }

  private measureSpeed(position: Vector3, stamp: number): void {
    const isJump = this.from && (stamp < this.from.stamp || stamp - this.from.stamp > LONGEST_WINDOW_S);
    if (!this.from || isJump) this.from = { position, stamp };
    const elapsed = stamp - this.from.stamp;
    if (elapsed === 0) this.speed = 0;
    if (elapsed < SPEED_WINDOW_S) return;
    this.speed = position.distanceTo(this.from.position) / elapsed;
    this.from = { position, stamp };
  }
}

// The heading of a pose's x axis in the world's plane.
export function yawOf(pose: Matrix4): number {
  const ahead = new Vector3(1, 0, 0).applyQuaternion(new Quaternion().setFromRotationMatrix(pose));
  return Math.atan2(ahead.y, ahead.x);
}
