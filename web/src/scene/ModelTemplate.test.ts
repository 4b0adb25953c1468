import { BoxGeometry, Mesh, MeshBasicMaterial, MeshStandardMaterial, Object3D, Vector3 } from "three";
import { expect, test } from "vitest";
import { makeTemplate } from "./ModelTemplate";
import { visualFacts } from "./visualFacts";

// Returns a cart: its body is lifted by 0.5 m, and the mesh of its wheel, at y = 0.3, is shifted by
// 0.1 in x.
function cart(): Object3D {
  const root = new Object3D();
  const chassis = new Object3D();
  chassis.userData.name = "chassis";
  chassis.position.set(0, 0, 0.5);
  chassis.add(new Mesh(new BoxGeometry(1, 1, 1), new MeshBasicMaterial()));
  const wheel = new Object3D();
  wheel.name = "wheelleft"; // GLTFLoader removes the colon from the name
  wheel.userData.name = "wheel:left";
  wheel.position.set(0, 0.3, 0);
  const tyre = new Mesh(new BoxGeometry(0.2, 0.2, 0.2), new MeshBasicMaterial());
  tyre.position.set(0.1, 0, 0);
  wheel.add(tyre);
  root.add(chassis, wheel);
  return root;
}

test("each part has the name of its link as in the scene, even if the loader changes names", () => {
  const { parts } = makeTemplate(cart(), ["chassis", "wheel:left"]);
  expect(parts.map((part) => part.link)).toEqual(["chassis", "wheel:left"]);
});

test("parts are placed both in their link and in the model", () => {
  const { parts } = makeTemplate(cart(), ["chassis", "wheel:left"]);
  const tyre = parts[1]!;
  expect(new Vector3().setFromMatrixPosition(tyre.linkFromPart).toArray()).toEqual([0.1, 0, 0]);
  expect(new Vector3().setFromMatrixPosition(tyre.modelFromPart).toArray()).toEqual([0.1, 0.3, 0]);
});

test("a mesh without a link belongs to the model", () => {
  const { parts } = makeTemplate(cart(), ["wheel:left"]);
  expect(parts[0]!.link).toBeNull();
  expect(new Vector3().setFromMatrixPosition(parts[0]!.linkFromPart).toArray()).toEqual([0, 0, 0.5]);
});

test("the parts of one visual have its name and its shape", () => {
  const root = cart();
  const group = new Object3D();
  group.userData = { visual: "cab", shape: { kind: "box", size: [1, 2, 3] } };
  group.add(...[0, 1].map(() => new Mesh(new BoxGeometry(1, 2, 3), new MeshStandardMaterial({ color: 0xff0000 }))));
  root.children[0]!.add(group);
  const facts = visualFacts(makeTemplate(root, ["chassis", "wheel:left"]));
  expect(facts).toHaveLength(3);
  expect(facts[1]).toMatchObject({ name: "cab", link: "chassis", shape: { kind: "box", size: [1, 2, 3] } });
  expect(facts[1]!.materials.map(({ colour }) => colour)).toEqual(["#ff0000", "#ff0000"]);
  expect(facts[2]!.shape).toEqual({ kind: "mesh", size: [expect.closeTo(0.2), expect.closeTo(0.2), expect.closeTo(0.2)] });
});

test("the bounds contain all parts", () => {
  const { bounds } = makeTemplate(cart(), ["chassis", "wheel:left"]);
  expect(bounds.min.toArray()).toEqual([-0.5, -0.5, expect.closeTo(-0.1)]);
  expect(bounds.max.toArray()).toEqual([0.5, 0.5, 1]);
});

test("a model without shapes has empty bounds", () => {
  expect(makeTemplate(new Object3D(), []).bounds.isEmpty()).toBe(true);
});
