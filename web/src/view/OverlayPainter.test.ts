import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  PerspectiveCamera,
  Points,
  PointsMaterial,
} from "three";
import { expect, test } from "vitest";
import { ImageDepths } from "./ImageDepths";
import { OverlayPainter } from "./OverlayPainter";

// Records what was painted: the ends of lines, and the corners of squares.
function fakeContext() {
  const lines: number[][] = [];
  const squares: number[][] = [];
  let from: number[] = [];
  const context = {
    beginPath: () => {},
    moveTo: (x: number, y: number) => (from = [x, y]),
    lineTo: (x: number, y: number) => lines.push([...from, x, y]),
    stroke: () => {},
    fill: () => {},
    fillRect: (x: number, y: number, width: number, height: number) => squares.push([x + width / 2, y + height / 2]),
  };
  return { lines, squares, context: context as unknown as CanvasRenderingContext2D };
}

// Returns a camera at the origin that looks along x, with z up and a 90° field of view. At a
// distance of 1 m, the upper edge of the view is 1 m up.
function camera(): PerspectiveCamera {
  const eye = new PerspectiveCamera(90, 2, 0.1, 100);
  eye.up.set(0, 0, 1);
  eye.lookAt(1, 0, 0);
  eye.updateMatrixWorld();
  return eye;
}

function geometry(numbers: number[]): BufferGeometry {
  const made = new BufferGeometry();
  made.setAttribute("position", new BufferAttribute(new Float32Array(numbers), 3));
  return made;
}

test("lines and points are painted at their places in the camera's image", () => {
  const { lines, squares, context } = fakeContext();
  const painter = new OverlayPainter(context, 200, 100, camera());
  const line = new LineSegments(geometry([2, 0, 0, 2, 2, 2]), new LineBasicMaterial());
  line.geometry.setDrawRange(0, 2);
  const point = new Points(geometry([4, -4, 0]), new PointsMaterial());
  point.position.set(0, 0, 2); // 4 m ahead, 4 m to the right, 2 m up
  painter.paint([line, point]);
  // The line goes from the centre of the image to a point at a distance of 2 m. This point is 2 m
  // to the left and 2 m up. So it is on the upper edge, halfway between the middle and the left
  // corner.
  expect(lines[0]!.map((value) => Math.round(value * 1e3) / 1e3 + 0)).toEqual([100, 50, 50, 0]);
  expect(squares[0]!.map((value) => Math.round(value * 1e3) / 1e3)).toEqual([150, 25]);
});

test("objects behind the camera and hidden objects are not painted", () => {
  const { lines, squares, context } = fakeContext();
  const painter = new OverlayPainter(context, 200, 100, camera());
  const behind = new LineSegments(geometry([-2, 0, 0, -2, 2, 2]), new LineBasicMaterial());
  const hidden = new Points(geometry([4, 0, 0]), new PointsMaterial());
  hidden.visible = false;
  painter.paint([behind, hidden]);
  expect(lines).toEqual([]);
  expect(squares).toEqual([]);
});

test("a line that passes the camera is clipped in front of it", () => {
  const { lines, context } = fakeContext();
  const through = new LineSegments(geometry([-2, 0, 0, 2, 0, 1]), new LineBasicMaterial());
  new OverlayPainter(context, 200, 100, camera()).paint([through]);
  expect(lines).toHaveLength(1);
  expect(lines[0]!.every(Number.isFinite)).toBe(true);
  expect(lines[0]!.slice(2).map(Math.round)).toEqual([100, 25]);
});

test("a wireframe is painted as the edges of its triangles, for each instance", () => {
  const { lines, context } = fakeContext();
  const net = new InstancedMesh(geometry([2, 0, 0, 2, 1, 0, 2, 0, 1]), new MeshBasicMaterial({ wireframe: true }), 2);
  net.setMatrixAt(0, new Matrix4());
  net.setMatrixAt(1, new Matrix4().makeTranslation(0, 0, -1));
  new OverlayPainter(context, 200, 100, camera()).paint([net]);
  expect(lines.map((line) => line.map(Math.round))).toEqual([
    [100, 50, 75, 50],
    [75, 50, 100, 25],
    [100, 25, 100, 50],
    [100, 75, 75, 75],
    [75, 75, 100, 50],
    [100, 50, 100, 75],
  ]);
});

test("only the faces of a body that the camera sees are painted, also of a mirrored body", () => {
  const { lines, context } = fakeContext();
  const box = new Mesh(new BoxGeometry(1, 1, 1), new MeshBasicMaterial());
  box.position.set(4, 2, 2); // ahead, to the left and up: the camera sees three of the six faces
  new OverlayPainter(context, 200, 100, camera()).paint([box]);
  const cornersOfThreeFaces = 3 * 2 * 3;
  expect(lines.length).toBe(cornersOfThreeFaces);
  box.scale.set(1, -1, 1);
  new OverlayPainter(context, 200, 100, camera()).paint([box]);
  expect(lines.length).toBe(2 * cornersOfThreeFaces);
});

// A surface 4 m ahead in the left half of an image of 200 × 100 pixels, and the sky in the right half.
function wallAtTheLeft(): ImageDepths {
  const columns = 26;
  const numbers = Uint16Array.from({ length: columns * 14 }, (_, i) => (i % columns < 13 ? 60_000 : 0));
  return new ImageDepths(200, 100, 8, 240_000, numbers);
}

test("surfaces of the image hide the parts of lines behind them, and points and faces", () => {
  const { lines, squares, context } = fakeContext();
  const painter = new OverlayPainter(context, 200, 100, camera(), wallAtTheLeft());
  const behind = new LineSegments(geometry([8, 8, 0, 8, -8, 0]), new LineBasicMaterial()); // at 8 m, from x = 50 to 150
  behind.geometry.setDrawRange(0, 2);
  painter.paint([behind]);
  expect(lines).toHaveLength(1);
  expect(Math.abs(lines[0]![0]! - 100)).toBeLessThan(5);
  expect(lines[0]![2]).toBeCloseTo(150);
  lines.length = 0;
  const before = new LineSegments(geometry([3, 3, 0, 3, -3, 0]), new LineBasicMaterial());
  before.geometry.setDrawRange(0, 2);
  const onTop = new LineSegments(behind.geometry, new LineBasicMaterial({ depthTest: false }));
  painter.paint([before, onTop]);
  expect(lines.map((line) => line.map(Math.round))).toEqual([
    [50, 50, 150, 50],
    [50, 50, 150, 50],
  ]);
  lines.length = 0;
  const points = new Points(geometry([8, 4, 0, 8, -4, 0, 4, 2, 0]), new PointsMaterial());
  painter.paint([points]);
  expect(squares.map(([x]) => Math.round(x!))).toEqual([125, 75]); // the last one lies on the surface
  const box = new Mesh(new BoxGeometry(1, 1, 1), new MeshBasicMaterial());
  box.position.set(8, 4, 0);
  painter.paint([box]);
  expect(lines).toEqual([]);
  box.position.set(3, 1.5, 0);
  painter.paint([box]);
  expect(lines.length).toBeGreaterThan(0);
});

test("a line that leaves the image is painted inside it", () => {
  const { lines, context } = fakeContext();
  const long = new LineSegments(geometry([3, 3000, 0, 3, -3000, 0]), new LineBasicMaterial());
  long.geometry.setDrawRange(0, 2);
  new OverlayPainter(context, 200, 100, camera(), wallAtTheLeft()).paint([long]);
  expect(lines.map((line) => line.map(Math.round))).toEqual([[0, 50, 200, 50]]);
});
