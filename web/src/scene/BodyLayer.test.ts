import {
  Box3,
  BoxGeometry,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  Raycaster,
  Vector3,
} from "three";
import { expect, test } from "vitest";
import { BodyLayer } from "./BodyLayer";
import type { ModelTemplate } from "./ModelTemplate";
import { HERE, body, scene } from "./testScene";

function template(): ModelTemplate {
  const part = (link: string, x: number) => ({
    visual: { name: "", link: null, shape: {} },
    geometry: new BoxGeometry(0.4, 0.4, 0.4),
    material: new MeshBasicMaterial(),
    link,
    linkFromPart: new Matrix4(),
    modelFromPart: new Matrix4().makeTranslation(x, 0, 0),
  });
  return { parts: [part("chassis", 0), part("wheel", 1)], bounds: new Box3() };
}

const wallPose = [3, 0, 0, 0, 0, 0, 1];

function layer(): BodyLayer {
  const bodies = new BodyLayer(
    scene({
      bodies: [
        body("wall", { model: "wall-1", isStatic: true, isRobot: false, pose: wallPose }),
        body("a"),
        body("b"),
      ],
      poses: [
        { body: 1, link: null },
        { body: 1, link: "wheel" },
        { body: 2, link: null },
        { body: 2, link: "wheel" },
      ],
    }),
  );
  bodies.addModel("cart-1", template());
  bodies.addModel("wall-1", template());
  return bodies;
}

function meshesOf(bodies: BodyLayer): Mesh[] {
  return bodies.group.children.filter((each) => each instanceof Mesh);
}

function poses(...xs: number[]): Float64Array {
  return Float64Array.from(xs.flatMap((x) => [x, ...HERE.slice(1)]));
}

// Returns the x coordinate of a drawn part's centre in the world.
function centreX(mesh: Mesh, instance = 0): number {
  const matrix = new Matrix4();
  if (mesh instanceof InstancedMesh) mesh.getMatrixAt(instance, matrix);
  else matrix.copy(mesh.matrix);
  mesh.geometry.computeBoundingBox();
  return mesh.geometry.boundingBox!.getCenter(new Vector3()).applyMatrix4(matrix).x;
}

test("bodies of one model are drawn together, and a single body alone", () => {
  const kinds = meshesOf(layer()).map((mesh) => (mesh instanceof InstancedMesh ? mesh.count : 1));
  expect(kinds).toEqual([2, 2, 1, 1]);
});

test("a moving link has its own pose, and all other parts their body's", () => {
  const bodies = layer();
  bodies.setPoses(poses(10, 11.5, 20, 21.5));
  const [chassis, wheel] = meshesOf(bodies) as [Mesh, Mesh];
  expect([centreX(chassis, 0), centreX(chassis, 1)]).toEqual([10, 20]);
  expect([centreX(wheel, 0), centreX(wheel, 1)]).toEqual([11.5, 21.5]);
});

test("a body without a pose for its link keeps the link at its place in the model", () => {
  const bodies = new BodyLayer(
    scene({ bodies: [body("a"), body("b")], poses: [{ body: 0, link: null }, { body: 0, link: "wheel" }, { body: 1, link: null }] }),
  );
  bodies.addModel("cart-1", template());
  bodies.setPoses(poses(10, 11.5, 20));
  expect(meshesOf(bodies).map((mesh) => centreX(mesh))).toEqual([10, 11.5, 20, 21]);
});

test("parts of one material that move together are one draw call for all bodies, with one buffer of matrices", () => {
  const bodies = new BodyLayer(
    scene({ bodies: [body("a"), body("b"), body("c")], poses: [0, 1, 2].map((index) => ({ body: index, link: null })) }),
  );
  const { parts, bounds } = template();
  const other = { ...parts[0]!, material: new MeshBasicMaterial() };
  bodies.addModel("cart-1", { parts: [{ ...parts[0]!, material: parts[1]!.material }, parts[1]!, other], bounds });
  bodies.setPoses(poses(1, 2, 3));
  const meshes = meshesOf(bodies) as InstancedMesh[];
  expect(meshes.map(({ count }) => count)).toEqual([3, 3]);
  expect(meshes[0]!.instanceMatrix).toBe(meshes[1]!.instanceMatrix);
  meshes[0]!.geometry.computeBoundingBox();
  const { min, max } = meshes[0]!.geometry.boundingBox!;
  expect([min.x, max.x].map((x) => Math.round(10 * x) / 10)).toEqual([-0.2, 1.2]);
});

test("a mirrored part of a crowd shows its outer faces", () => {
  const bodies = new BodyLayer(scene({ bodies: [body("a"), body("b")] }));
  const mirrored = { ...template().parts[0]!, modelFromPart: new Matrix4().makeScale(1, -1, 1) };
  bodies.addModel("cart-1", { parts: [mirrored], bounds: new Box3() });
  bodies.group.updateMatrixWorld(true);
  const toSide = new Raycaster(new Vector3(0, 5, 0), new Vector3(0, -1, 0));
  expect(bodies.pick(toSide)?.name).toBe("a");
  const [face] = toSide.intersectObject(bodies.group, true);
  expect(face!.distance).toBeCloseTo(4.8, 6); // three.js hits front faces only
});

test("static bodies stay at the scene's poses", () => {
  const bodies = layer();
  bodies.setPoses(poses(10, 11.5, 20, 21.5));
  expect(centreX(meshesOf(bodies)[2]!)).toBe(3);
});

test("bodies fixed to the world obstruct the view, but robots do not", () => {
  const bodies = layer();
  bodies.setPoses(poses(10, 11.5, 20, 21.5));
  bodies.group.updateMatrixWorld(true);
  const x = new Vector3(1, 0, 0);
  const free = bodies.freeAlong(new Vector3(0, 0, 0), x, 50); // the wall is at 3
  expect(free).toBeGreaterThan(1);
  expect(free).toBeLessThan(3);
  expect(bodies.freeAlong(new Vector3(0, 0, 0), x, free - 0.1)).toBe(Infinity);
  expect(bodies.freeAlong(new Vector3(5, 0, 0), x, 50)).toBe(Infinity); // robots at 10 and 20
});

test("a vertical ray finds a robot that has moved", () => {
  const bodies = layer();
  bodies.group.updateMatrixWorld(true);
  const down = (x: number) => new Raycaster(new Vector3(x, 0, 5), new Vector3(0, 0, -1));
  bodies.setPoses(poses(10, 11.5, 20, 21.5));
  expect(bodies.pick(down(20))?.name).toBe("b");
  expect(bodies.pick(down(10))?.name).toBe("a");
  bodies.setPoses(poses(-2, -1, 20, 21.5));
  expect(bodies.pick(down(-2))?.name).toBe("a");
  expect(bodies.pick(down(10))).toBeNull();
  bodies.group.updateMatrixWorld(true);
  expect(bodies.pick(down(3))?.name).toBe("wall");
});
