import { InstancedMesh, Matrix4, MeshBasicMaterial, PerspectiveCamera, SphereGeometry } from "three";
import { describe, expect, it } from "vitest";
import { CrowdDetail } from "./CrowdDetail";

const RADIUS = 0.1;

function crowd(count: number) {
  const mesh = new InstancedMesh(new SphereGeometry(RADIUS), new MeshBasicMaterial(), count);
  const places = Array.from({ length: count }, (_, i) => new Matrix4().makeTranslation(0.3 * i, 0, 0));
  const detail = new CrowdDetail();
  const wheel = new InstancedMesh(new SphereGeometry(RADIUS / 4), new MeshBasicMaterial(), count);
  detail.add([{ mesh, size: 2 * RADIUS }, { mesh: wheel, size: RADIUS / 2 }], RADIUS, places);
  const camera = new PerspectiveCamera(90);
  // A picture 800 pixels high of 90 degrees: 400 pixels a metre at a metre, so the nearest measures
  // 80 pixels across at a metre.
  const look = (distance: number) => {
    camera.position.set(0, 0, distance);
    detail.choose(camera, 800);
    return mesh.geometry;
  };
  return { mesh, wheel, look, fine: mesh.geometry };
}

describe("CrowdDetail", () => {
  it("draws boxes for a crowd whose nearest is small, and shapes again when it is near", () => {
    const { look, fine } = crowd(50);
    expect(look(6)).toBe(fine); // 13 pixels
    const coarse = look(7); // 11
    expect(coarse).not.toBe(fine);
    expect(look(6)).toBe(coarse); // neither small enough to change nor large enough
    expect(look(4.5)).toBe(fine); // 18
  });

  it("gives the box the size and place of the shape", () => {
    const { look } = crowd(50);
    const box = look(100);
    box.computeBoundingBox();
    expect(box.boundingBox!.max.z).toBeCloseTo(RADIUS, 6);
    expect(box.boundingBox!.min.z).toBeCloseTo(-RADIUS, 6);
  });

  it("leaves small parts out while it draws boxes", () => {
    const { mesh, wheel, look } = crowd(50);
    look(100);
    expect([mesh.visible, wheel.visible]).toEqual([true, false]);
    look(1);
    expect([mesh.visible, wheel.visible]).toEqual([true, true]);
  });

  it("leaves a few as they are", () => {
    const { look, fine } = crowd(49);
    expect(look(1000)).toBe(fine);
  });
});
