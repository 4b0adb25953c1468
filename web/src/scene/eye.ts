// Views as a robot sees them. Frames follow REP-103: x forward, y left, z up.
import type { Box3 } from "three";
import { Matrix4, Quaternion, Vector3 } from "three";
import type { CameraView } from "../api/scene";

const DEFAULT_HEIGHT = 0.3; // m
const WIDEST = (120 * Math.PI) / 180; // wider perspective images are distorted at the edges

// The pose of a robot's camera, and its field of view. If it is null, the field of view of the
// page's view is used.
export interface Eye {
  worldFromEye: Matrix4;
  view: CameraView | null;
}

// Returns the pose of the view for a robot without a camera. It is at the front of the robot's top.
export function eyeAt(worldFromRobot: Matrix4, bounds: Box3 | null): Matrix4 {
  const isKnown = bounds !== null && !bounds.isEmpty();
  const place = isKnown ? [bounds.max.x, 0, bounds.max.z] : [0, 0, DEFAULT_HEIGHT];
  const [x, y, z] = place as [number, number, number];
  return worldFromRobot.clone().multiply(new Matrix4().makeTranslation(x, y, z));
}

// The vertical angle in degrees at which an image with this aspect ratio (width by height) just
// contains the whole field of view.
export function fieldOfViewDeg({ horizontalFov, aspect }: CameraView, pictureAspect: number): number {
  const across = Math.tan(Math.min(horizontalFov, WIDEST) / 2);
  return (2 * Math.atan(across / Math.min(aspect, pictureAspect)) * 180) / Math.PI;
}

// The rotation of a three.js camera, which looks along its -z with y up, in the frame of a robot's
// camera.
export function cameraRotation(worldFromEye: Matrix4): Quaternion {
  const [forward, left, up] = [new Vector3(), new Vector3(), new Vector3()];
  worldFromEye.extractBasis(forward, left, up);
  const basis = new Matrix4().makeBasis(left.negate(), up, forward.negate());
  return new Quaternion().setFromRotationMatrix(basis);
}
