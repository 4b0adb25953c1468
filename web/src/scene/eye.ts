// How one sees as a robot does. Frames are those of REP-103: x forward, y left, z up.
import type { Box3 } from "three";
import { Matrix4, Quaternion, Vector3 } from "three";

const DEFAULT_HEIGHT = 0.3; // m

// For a robot without a camera: the front of its top.
export function eyeAt(worldFromRobot: Matrix4, bounds: Box3 | null): Matrix4 {
  const isKnown = bounds !== null && !bounds.isEmpty();
  const place = isKnown ? [bounds.max.x, 0, bounds.max.z] : [0, 0, DEFAULT_HEIGHT];
  const [x, y, z] = place as [number, number, number];
  return worldFromRobot.clone().multiply(new Matrix4().makeTranslation(x, y, z));
}

// The turn of a three.js camera, which looks along its -z with y up, in the frame of an eye.
export function cameraRotation(worldFromEye: Matrix4): Quaternion {
  const [forward, left, up] = [new Vector3(), new Vector3(), new Vector3()];
  worldFromEye.extractBasis(forward, left, up);
  const basis = new Matrix4().makeBasis(left.negate(), up, forward.negate());
  return new Quaternion().setFromRotationMatrix(basis);
}
