// @vitest-environment jsdom
import { Box3, BoxGeometry, Matrix4, MeshBasicMaterial, PerspectiveCamera, Vector3 } from "three";
import { beforeEach, expect, test, vi } from "vitest";
import { Arranger } from "./Arranger";
import { BodyLayer } from "./BodyLayer";
import type { ModelTemplate } from "./ModelTemplate";
import { RobotPlaces } from "./RobotPlaces";
import { SensorFrames } from "./SensorFrames";
import { HERE, body, scene } from "./testScene";

// px: width of the image; the camera looks straight down, and its centre shows the origin
const SIZE = 400;
const HEIGHT = 10; // m: height of the camera. At this height, the image shows 20 m.
const PX = SIZE / 20; // px: one metre on the floor

function box(size: number, depth = 0.4): ModelTemplate {
  const half = new Vector3(size / 2, size / 2, depth / 2);
  return {
    parts: [
      {
        visual: { name: "", link: null, shape: {} },
        geometry: new BoxGeometry(size, size, depth),
        material: new MeshBasicMaterial(),
        link: null,
        linkFromPart: new Matrix4(),
        modelFromPart: new Matrix4(),
      },
    ],
    bounds: new Box3(half.clone().negate(), half),
  };
}

const onPick = vi.fn();
const onPlace = vi.fn(async () => true);
let host: HTMLElement;
let canvas: HTMLCanvasElement;
let bodies: BodyLayer;
let arranger: Arranger;
let selection: string | null;

beforeEach(() => {
  vi.clearAllMocks();
  selection = null;
  host = document.createElement("div");
  canvas = document.createElement("canvas");
  host.append(canvas);
  host.getBoundingClientRect = () => new DOMRect(0, 0, SIZE, SIZE);
  host.setPointerCapture = () => {};
  const floor = body("floor", { model: "floor", isRobot: false, isStatic: true, pose: [0, 0, -0.2, ...HERE.slice(3)] });
  const shelf = body("shelf", { model: "cart", isRobot: false, isStatic: true, isFixed: false, pose: [-4, 0, 0, ...HERE.slice(3)] });
  const lying = body("box", { model: "cart", isRobot: false, pose: [0, 4, 0, Math.SQRT1_2, 0, 0, Math.SQRT1_2] });
  bodies = new BodyLayer(scene({ bodies: [body("a", { model: "cart" }), floor, shelf, lying] }));
  bodies.addModel("cart", box(1));
  bodies.addModel("floor", box(100));
  bodies.group.updateMatrixWorld(true);
  const camera = new PerspectiveCamera((2 * Math.atan(1) * 180) / Math.PI, 1, 0.1, 100);
  camera.up.set(0, 1, 0); // north is up in the image
  camera.position.set(0, 0, HEIGHT);
  camera.lookAt(0, 0, 0);
  camera.updateMatrixWorld(true);
  const robots = new RobotPlaces(bodies, new SensorFrames());
  const view = { host, camera, bodies: () => bodies, robots: () => robots, selection: () => selection, isTaken: () => false, redraw: () => {} };
  arranger = new Arranger(view, { onPick, onPlace });
  arranger.isOn = true;
});

// A pointer event at this distance in metres from the centre of the image. jsdom has no
// PointerEvent.
function pointer(type: string, x: number, y: number): Event {
  const event = new MouseEvent(type, {
    bubbles: true,
    cancelable: true,
    clientX: SIZE / 2 + x * PX,
    clientY: SIZE / 2 - y * PX,
    button: 0,
  });
  Object.assign(event, { isPrimary: true, pointerId: 1 });
  canvas.dispatchEvent(event);
  return event;
}

const place = () => new Vector3().setFromMatrixPosition(bodies.poseOf(0)!);

test("a body is dragged over the floor at the point where it was grabbed", async () => {
  pointer("pointerdown", 0.2, 0.1);
  pointer("pointermove", 2.2, 1.1);
  expect(place().x).toBeCloseTo(2, 6);
  expect(place().y).toBeCloseTo(1, 6);
  expect(arranger.holds).toBe(true);
  pointer("pointerup", 2.2, 1.1);
  expect(onPlace).toHaveBeenCalledWith("a", { x: expect.closeTo(2, 6), y: expect.closeTo(1, 6), yaw: 0 });
  await Promise.resolve();
  expect(arranger.holds).toBe(true); // true until the new scene arrives
});

test("after a refusal, the next poses show the body at its former place", async () => {
  onPlace.mockResolvedValueOnce(false);
  pointer("pointerdown", 0, 0);
  pointer("pointermove", 2, 0);
  pointer("pointerup", 2, 0);
  await vi.waitFor(() => expect(arranger.holds).toBe(false));
});

test("dragging the arrow's tip rotates the selected robot", () => {
  selection = "a";
  arranger.showHandle();
  const tip = arranger.handle.tip!;
  pointer("pointerdown", tip.x, tip.y);
  pointer("pointermove", 0, 3);
  pointer("pointerup", 0, 3);
  expect(onPlace).toHaveBeenCalledWith("a", { x: 0, y: 0, yaw: expect.closeTo(Math.PI / 2, 6) });
});

test("a click without a drag selects the robot, and clicks on the floor belong to the view", () => {
  pointer("pointerdown", 0, 0);
  pointer("pointerup", 0, 0);
  expect(onPick).toHaveBeenCalledWith("a");
  const heard = vi.fn();
  canvas.addEventListener("pointerdown", heard);
  pointer("pointerdown", 3, 3);
  expect(heard).toHaveBeenCalledOnce();
  pointer("pointerdown", 0, 0);
  expect(heard).toHaveBeenCalledOnce();
});

test("a click on the floor moves the selected robot there with the same heading", () => {
  selection = "a";
  arranger.placeAt(arranger.floorAt({ x: SIZE / 2 + 3 * PX, y: SIZE / 2 })!);
  expect(onPlace).toHaveBeenCalledWith("a", { x: expect.closeTo(3, 6), y: expect.closeTo(0, 6), yaw: 0 });
});

test("an object is selected by a click, and keeps its tilt when it is rotated", () => {
  pointer("pointerdown", 0, 4);
  pointer("pointerup", 0, 4);
  expect(onPick).toHaveBeenCalledWith("box");
  selection = "box";
  arranger.showHandle();
  const tip = arranger.handle.tip!;
  pointer("pointerdown", tip.x, tip.y);
  pointer("pointermove", 0, 7);
  const [x, y, z] = [new Vector3(), new Vector3(), new Vector3()];
  bodies.poseOf(3)!.extractBasis(x, y, z);
  expect(y.z).toBeCloseTo(1, 6); // the body is still rolled by a quarter turn
  expect(x.y).toBeCloseTo(1, 6);
  pointer("pointerup", 0, 7);
  expect(onPlace).toHaveBeenCalledWith("box", expect.objectContaining({ yaw: expect.closeTo(Math.PI / 2, 6) }));
});

test("a fixed body can be dragged only after it was selected", () => {
  pointer("pointerdown", -4, 0);
  pointer("pointermove", -4, 2);
  pointer("pointerup", -4, 2);
  expect(onPlace).not.toHaveBeenCalled();
  selection = "shelf";
  pointer("pointerdown", -4, 0);
  pointer("pointermove", -4, 2);
  pointer("pointerup", -4, 2);
  expect(onPlace).toHaveBeenCalledWith("shelf", { x: expect.closeTo(-4, 6), y: expect.closeTo(2, 6), yaw: 0 });
});

test("drags have no effect while moving is not allowed", () => {
  arranger.isOn = false;
  pointer("pointerdown", 0, 0);
  pointer("pointermove", 2, 0);
  pointer("pointerup", 2, 0);
  expect(place().x).toBe(0);
  expect(onPlace).not.toHaveBeenCalled();
  arranger.showHandle();
  expect(arranger.handle.tip).toBeNull();
});
