// A pose as numbers: metres, and roll, pitch and yaw in radians.
import type { Matrix4 } from "three";
import { Quaternion } from "three";
import { anglesOf } from "../live/values";

export interface PoseAngles {
  x: number;
  y: number;
  z: number;
  roll: number;
  pitch: number;
  yaw: number;
}

export function rotationOf(pose: Matrix4): { roll: number; pitch: number; yaw: number } {
  const { x, y, z, w } = new Quaternion().setFromRotationMatrix(pose);
  return anglesOf({ x, y, z, w });
}

export function poseOf(pose: Matrix4): PoseAngles {
  const [x, y, z] = pose.elements.slice(12) as [number, number, number];
  return { x, y, z, ...rotationOf(pose) };
}
