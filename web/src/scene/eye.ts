// How one sees as a robot does. Frames are those of REP-103: x forward, y left, z up.
import type { Box3 } from "three";
import { Matrix4, Quaternion, Vector3 } from "three";
import type { CameraView } from "../api/scene";

const DEFAULT_HEIGHT = 0.3; // m
const WIDEST = (120 * Math.PI) / 180; // a flat picture of more is all rim

// Where a robot's eye is, and how wide it sees; null: as wide as the view does.
export interface Eye {
  worldFromEye: Matrix4;
  view: CameraView | null;
}

// For a robot without a camera: the front of its top.
export function eyeAt(worldFromRobot: Matrix4, bounds: Box3 | null): Matrix4 {
  const isKnown = bounds !== null && !bounds.isEmpty();
  const place = isKnown ? [bounds.max.x, 0, bounds.max.z] : [0, 0, DEFAULT_HEIGHT];
  const [x, y, z] = place as [number, number, number];
  return worldFromRobot.clone().multiply(new Matrix4().makeTranslation(x, y, z));
}

// The vertical angle, in degrees, with which a picture of this aspect (width by height) just holds all that
// the eye sees.
export function fieldOfViewDeg({ horizontalFov, aspect }: CameraView, pictureAspect: number): number {
  const across = Math.tan(Math.min(horizontalFov, WIDEST) / 2);
  return (2 * Math.atan(across / Math.min(aspect, pictureAspect)) * 180) / Math.PI;
}

// The turn of a three.js camera, which looks along its -z with y up, in the frame of an eye.
export function cameraRotation(worldFromEye: Matrix4): Quaternion {
  const [forward, left, up] = [new Vector3(), new Vector3(), new Vector3()];
  worldFromEye.extractBasis(forward, left, up);
  const basis = new Matrix4().makeBasis(left.negate(), up, forward.negate());
  return new Quaternion().setFromRotationMatrix(basis);
}
