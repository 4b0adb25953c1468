// Provides the pose of the selected robot for the inspector, at a readable rate.
import { Vector3 } from "three";
import type { Matrix4 } from "three";
import { shortWay } from "../live/angle";
import { rotationOf } from "../scene/poses";
import type { RobotPose } from "../state/State";

export const SHORTEST_UPDATE_MS = 100;
const SPEED_WINDOW_S = 0.2; // simulated
// s, simulated: if more time passes between two poses, the replay has jumped. At ten times real
// time, only about 1 s passes between two updates.
const LONGEST_WINDOW_S = 3;

// A reported pose and its simulated time.
export interface StampedPose {
  pose: Matrix4;
  stamp: number; // s, simulated
}

export class SelectedPose {
  private robot: string | null = null;
  private updatedMs = -Infinity;
  private from: { position: Vector3; yaw: number; stamp: number } | null = null;
  private speed = 0;
  private turnRate = 0;

  // Returns the values to show, or null if the next values are not due yet.
  update(robot: string, latest: StampedPose, nowMs: number): RobotPose | null {
    if (robot !== this.robot) this.start(robot);
    if (nowMs - this.updatedMs < SHORTEST_UPDATE_MS) return null;
    this.updatedMs = nowMs;
    const position = new Vector3().setFromMatrixPosition(latest.pose);
    const { roll, pitch, yaw } = rotationOf(latest.pose);
    this.measureSpeed(position, yaw, latest.stamp);
    const { x, y, z } = position;
    return { x, y, z, roll, pitch, yaw, speed: this.speed, turnRate: this.turnRate };
  }

  private start(robot: string): void {
    this.robot = robot;
    this.updatedMs = -Infinity;
    this.from = null;
    this.speed = this.turnRate = 0;
  }

  private measureSpeed(position: Vector3, yaw: number, stamp: number): void {
    const isJump = this.from && (stamp < this.from.stamp || stamp - this.from.stamp > LONGEST_WINDOW_S);
    if (!this.from || isJump) this.from = { position, yaw, stamp };
    const elapsed = stamp - this.from.stamp;
    if (elapsed === 0) this.speed = this.turnRate = 0;
    if (elapsed < SPEED_WINDOW_S) return;
    this.speed = position.distanceTo(this.from.position) / elapsed;
    this.turnRate = shortWay(yaw - this.from.yaw) / elapsed;
    this.from = { position, yaw, stamp };
  }
}
