// Computes camera positions that show a part of the world.
import { Box3, Matrix4, PerspectiveCamera, Vector3 } from "three";
import type { SceneDescription } from "../api/scene";
import { robotsOf } from "../api/scene";

const UP = new Vector3(0, 0, 1);
const AROUND_ROBOTS = 4; // m: margin around the robots in the first view
const SMALL_WORLD = 13; // m: if half the width of a world is at most this, the world is shown completely
const TALLEST_SHOWN = 3; // m: higher parts of the world do not move the camera farther away

// A body is far away if its distance from the centre exceeds FAR metres plus FAR_RADII times the
// largest distance of the nearer bodies. `gsv world draw` has a similar rule.
const FAR_RADII = 20;
const FAR = 100;

// The part of the scene in the first view. A small world is shown completely. Otherwise, the robots
// and their surroundings are shown.
export function focusOf(scene: SceneDescription): Box3 {
  const world = boundsWithoutFarAway(scene);
  const robots = new Box3().setFromPoints(withoutFarAway(robotsOf(scene).map(placeOf)));
  const size = world.getSize(new Vector3());
  const isSmall = Math.max(size.x, size.y) <= 2 * SMALL_WORLD;
  if (!world.isEmpty() && (isSmall || robots.isEmpty())) {
    const focus = isSmall ? world.clone().union(robots) : boxAround(new Vector3(), SMALL_WORLD);
    focus.max.z = Math.min(focus.max.z, focus.min.z + TALLEST_SHOWN);
    return focus;
  }
  if (robots.isEmpty()) return boxAround(new Vector3(), AROUND_ROBOTS);
  robots.expandByVector(new Vector3(AROUND_ROBOTS, AROUND_ROBOTS, 0));
  robots.max.z += 1;
  return robots;
}

function placeOf({ pose }: { pose: readonly number[] }): Vector3 {
  return new Vector3(pose[0], pose[1], pose[2]);
}

// The bounds of the scene. Bodies that are far away are left out, because the other bodies would be
// too small to see.
function boundsWithoutFarAway(scene: SceneDescription): Box3 {
  const bounds = new Box3(new Vector3(...scene.bounds.min), new Vector3(...scene.bounds.max));
  const places = scene.bodies.map(placeOf);
  const near = withoutFarAway(places);
  if (near.length === places.length) return bounds;
  const box = new Box3().setFromPoints(near).expandByVector(new Vector3(AROUND_ROBOTS, AROUND_ROBOTS, 0));
  box.max.z += TALLEST_SHOWN;
  return box.intersect(bounds);
}

// Returns the places that are not far away, ordered by their distance from the centre. The centre
// is the median of all places, or the origin if there are fewer than three places. At least half of
// the places are returned.
export function withoutFarAway(places: Vector3[]): Vector3[] {
  const middle = new Vector3();
  if (places.length >= 3) {
    const median = (axis: "x" | "y" | "z") =>
      places.map((place) => place[axis]).sort((a, b) => a - b)[Math.floor(places.length / 2)]!;
    middle.set(median("x"), median("y"), median("z"));
  }
  const sorted = [...places].sort((a, b) => a.distanceTo(middle) - b.distanceTo(middle));
  const gap = sorted.findIndex((place, i) => {
    const reach = i === 0 ? 0 : sorted[i - 1]!.distanceTo(middle);
    return 2 * i >= sorted.length && i > 0 && place.distanceTo(middle) > FAR_RADII * reach + FAR;
  });
  return gap < 0 ? sorted : sorted.slice(0, gap);
}

// Returns an identifier of the world for which the camera is set up. If the identifier does not
// change, the camera does not move. It contains the name and the static bodies, because different
// worlds may have the same name, such as the previews of a set-up.
export function environmentOf({ name, bodies }: SceneDescription): string {
  return JSON.stringify([name, bodies.filter(({ isFixed }) => isFixed).map(({ model, pose }) => [model, pose])]);
}

function boxAround(centre: Vector3, halfWidth: number): Box3 {
  return new Box3(
    new Vector3(centre.x - halfWidth, centre.y - halfWidth, 0),
    new Vector3(centre.x + halfWidth, centre.y + halfWidth, 1),
  );
}

// The distance from the box's centre, along `direction`, from which all corners of the box are in
// the view. A corner at (x, y) in the image plane, which is nearer to the camera than the centre by
// z, requires z + |x| / tan(half the horizontal field of view), and the same for y.
export function fittingDistance(camera: PerspectiveCamera, box: Box3, direction: Vector3): number {
  const tanY = Math.tan((camera.fov * Math.PI) / 360);
  const tanX = tanY * camera.aspect;
  const centre = box.getCenter(new Vector3());
  const back = direction.clone().normalize().negate();
  const view = new Matrix4().lookAt(back, new Vector3(), UP).transpose();
  let distance = 0;
  for (let corner = 0; corner < 8; corner++) {
    const at = new Vector3(
      corner & 1 ? box.max.x : box.min.x,
      corner & 2 ? box.max.y : box.min.y,
      corner & 4 ? box.max.z : box.min.z,
    )
      .sub(centre)
      .applyMatrix4(view);
    distance = Math.max(distance, at.z + Math.abs(at.x) / tanX, at.z + Math.abs(at.y) / tanY);
  }
  return distance;
}
