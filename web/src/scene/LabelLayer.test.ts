// @vitest-environment jsdom
import { PerspectiveCamera, Vector3 } from "three";
import { expect, test, vi } from "vitest";
import { LabelLayer } from "./LabelLayer";

// At the origin, looking along -z: 90 degrees high, twice as wide as high.
const camera = new PerspectiveCamera(90, 2, 0.1, 100);
camera.updateMatrixWorld(true);

function robot(name: string, x: number, y: number, z: number) {
  return { name, position: new Vector3(x, y, z) };
}

function texts(layer: LabelLayer): (string | null)[] {
  return [...layer.element.children].map((label) => label.textContent);
}

test("a label stands where its robot is drawn", () => {
  const layer = new LabelLayer(() => {});
  layer.place(camera, 800, 400, [robot("a", 2, 1, -2)], null);
  expect((layer.element.firstChild as HTMLElement).style.transform).toContain("translate(600.0px, 100.0px)");
});

test("what is behind the camera or outside the picture has no label", () => {
  const layer = new LabelLayer(() => {});
  layer.place(
    camera,
    800,
    400,
    [robot("behind", 0, 0, 5), robot("aside", 9, 0, -2), robot("seen", 0, 0, -3)],
    null,
  );
  expect(texts(layer)).toEqual(["seen"]);
});

test("of a crowd the nearest are named", () => {
  const layer = new LabelLayer(() => {});
  const crowd = Array.from({ length: 100 }, (_, i) => robot(`r${i}`, 0, 0, -90 + i / 2));
  layer.place(camera, 800, 400, crowd, null);
  expect(layer.element.children).toHaveLength(40);
  expect(texts(layer)).toContain("r99");
  expect(texts(layer)).not.toContain("r0");
});

test("a click on a label means its robot, and markup in a name stays text", () => {
  const onPick = vi.fn();
  const layer = new LabelLayer(onPick);
  layer.place(camera, 800, 400, [robot("<b>a</b>", 0, 0, -3)], "<b>a</b>");
  const label = layer.element.firstChild as HTMLElement;
  expect(label.classList.contains("selected")).toBe(true);
  label.click();
  expect(onPick).toHaveBeenCalledWith("<b>a</b>");
});
