import type { Mesh } from "three";
import { Box3, Matrix4, MeshBasicMaterial, PerspectiveCamera, SphereGeometry, Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { BodyFrames } from "./BodyFrames";
import { CrowdDetail } from "./CrowdDetail";
import { ModelInstances } from "./ModelInstances";
import { body, scene } from "./testScene";

const RADIUS = 0.1;
const BETWEEN = 0.3;

function crowd(count: number) {
  const frames = new BodyFrames(
    scene({
      bodies: Array.from({ length: count }, (_, i) => body(String(i), { pose: [BETWEEN * i, 0, 0, 0, 0, 0, 1] })),
      poses: Array.from({ length: count }, (_, i) => ({ body: i, link: null })),
    }),
  );
  const part = (radius: number) => ({
    visual: { name: "", link: null, shape: {} },
    geometry: new SphereGeometry(radius),
    material: new MeshBasicMaterial(),
    link: null,
    linkFromPart: new Matrix4(),
    modelFromPart: new Matrix4(),
  });
  const template = { parts: [part(RADIUS), part(RADIUS / 4)], bounds: new Box3() };
  const bodies = { bodies: Array.from({ length: count }, (_, i) => i), isFixed: () => false };
  const instances = new ModelInstances(template, frames, bodies);
  const [mesh, wheel] = instances.meshes as [Mesh, Mesh];
  const detail = new CrowdDetail(frames);
  detail.add(instances, RADIUS);
  const camera = new PerspectiveCamera(90);
  // An image 800 pixels high with a 90° field of view has 400 pixels per metre at a distance of 1
  // m. The nearest robot is 80 pixels wide at 1 m.
  const look = (distance: number) => {
    camera.position.set(0, 0, distance);
    detail.choose(camera, 800);
    return { shapes: [mesh.visible, wheel.visible], boxes: detail.group.children as Mesh[] };
  };
  const move = (robot: number, worldFromRobot: Matrix4) => {
    frames.setMatrix(robot, worldFromRobot);
    instances.place();
    detail.moved();
  };
  return { move, look };
}

describe("CrowdDetail", () => {
  it("draws boxes for a crowd whose nearest robot is small in the image, and shapes again when it is near", () => {
    const { look } = crowd(50);
    const isCoarse = (distance: number) => look(distance).boxes.length > 0;
    expect(isCoarse(6)).toBe(false); // the robot is 13 pixels wide
    expect(isCoarse(7)).toBe(true); // 11 pixels wide
    // The robot's size is between the two limits, so the level of detail does not change.
    expect(isCoarse(6)).toBe(true);
    expect(isCoarse(4.5)).toBe(false); // 18 pixels wide
  });

  it("draws all boxes of a part at once, each with its size and at its place", () => {
    const { look } = crowd(50);
    const [boxes] = look(100).boxes;
    boxes!.geometry.computeBoundingBox();
    const { min, max } = boxes!.geometry.boundingBox!;
    [-RADIUS, -RADIUS, -RADIUS].forEach((value, k) => expect(min.getComponent(k)).toBeCloseTo(value, 6));
    [49 * BETWEEN + RADIUS, RADIUS, RADIUS].forEach((value, k) => expect(max.getComponent(k)).toBeCloseTo(value, 5));
    expect(boxes!.geometry.index!.count).toBe(50 * 36);
  });

  it("boxes move and rotate with the bodies", () => {
    const { move, look } = crowd(50);
    look(100);
    move(49, new Matrix4().makeRotationZ(Math.PI / 2).setPosition(7, 8, 9));
    const { geometry } = look(100).boxes[0]!;
    const at = (i: number) => new Vector3().fromBufferAttribute(geometry.getAttribute("position"), 49 * 8 + i);
    const middle = new Vector3();
    for (let i = 0; i < 8; i++) middle.add(at(i));
    [7, 8, 9].forEach((value, k) => expect(middle.getComponent(k) / 8).toBeCloseTo(value, 5));
    // The first corner was at (-1, -1, -1) radii from the centre. Now it is at (1, -1, -1) radii.
    [7 + RADIUS, 8 - RADIUS, 9 - RADIUS].forEach((value, k) => expect(at(0).getComponent(k)).toBeCloseTo(value, 5));
  });

  it("draws faces that point outwards", () => {
    const { geometry } = crowd(50).look(100).boxes[0]!;
    const faces = geometry.index!;
    const at = (i: number) => new Vector3().fromBufferAttribute(geometry.getAttribute("position"), i);
    for (let i = 0; i < faces.count; i += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => at(faces.getX(i + k))) as [Vector3, Vector3, Vector3];
      const across = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
      const centre = new Vector3(BETWEEN * Math.floor(i / 36), 0, 0);
      expect(across.dot(a.clone().sub(centre))).toBeCloseTo(RADIUS, 4);
    }
  });

  it("small parts are omitted while boxes are drawn", () => {
    const { look } = crowd(50);
    const { shapes, boxes } = look(100);
    expect([...shapes, boxes.length]).toEqual([false, false, 1]);
    expect(look(1)).toEqual({ shapes: [true, true], boxes: [] });
  });

  it("a few bodies are left unchanged", () => {
    const { shapes, boxes } = crowd(49).look(1000);
    expect([...shapes, boxes.length]).toEqual([true, true, 0]);
  });
});
