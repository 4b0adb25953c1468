import { expect, test } from "vitest";
import type { RobotBeams } from "./beams";
import type { DrawnValues } from "./forms";
import { inForm } from "./forms";
import { MessageDecoders } from "./MessageDecoder";
import { CLOUD_CHANNEL, cloudMessage } from "./testClouds";

const decode = new MessageDecoders().decoderOf(CLOUD_CHANNEL);
const cloud = (width: number, height: number) => decode(new DataView(cloudMessage(width, height).buffer));
const HEADER = { stamp: { sec: 2, nsec: 500_000_000 }, frame_id: "a" };

test("a cloud as points does not share memory with the message", () => {
  const message = cloud(3, 1) as { data: Uint8Array };
  const { points } = inForm("points", message) as { points: Float32Array };
  expect([...points]).toEqual([1, 0, 0, 2, 0, 0, 3, 0, 0]);
  expect(points.buffer).not.toBe(message.data.buffer);
});

test("a cloud as an image has the depths, their colours and the time of the message", async () => {
  const { header, values, pixels } = (await inForm("image", cloud(2, 2))) as DrawnValues;
  expect(header).toEqual(HEADER);
  expect([...values.values]).toEqual([1, 2, 3, 4]);
  expect([...pixels.rgba.slice(0, 4)]).toEqual([0, 0, 4, 255]);
  expect([...pixels.rgba.slice(12)]).toEqual([252, 255, 164, 255]);
});

test("an image that cannot be shown has a sentence", async () => {
  expect(await inForm("image", cloud(3, 1))).toEqual({
    header: HEADER,
    problem: "The depth image cannot be read: its points are not arranged in rows.",
  });
  const image = { header: HEADER, format: "mono16; png", data: new Uint8Array(4) };
  expect(await inForm("image", image)).toEqual({ header: HEADER, problem: "The image cannot be decoded (format mono16; png)." });
});

const POINTS = [{ x: 1, y: 2, z: 3 }, { x: 4, y: 5, z: 6 }, { x: 7, y: 8, z: 9 }];
const BLUE = { r: 0, g: 0, b: 1, a: 1 };
const marker = (more: object) => ({ header: HEADER, ns: "a", id: 0, type: 5, action: 0, color: BLUE, points: POINTS, colors: [], ...more });

test("beams have the ends of whole lines, with their colours, or red", () => {
  const [blue, red] = inForm("beams", { markers: [marker({ colors: [BLUE, BLUE, BLUE] }), marker({ ns: "b" })] }) as RobotBeams[];
  expect(blue).toMatchObject({ robot: "a", stamp: 2.5 });
  expect([...blue!.points]).toEqual([1, 2, 3, 4, 5, 6]);
  expect([...blue!.colours]).toEqual([0, 0, 1, 0, 0, 1]);
  expect(red!.robot).toBe("b");
  expect(red!.colours[0]).toBe(1);
  expect(red!.colours[1]! + red!.colours[2]!).toBeLessThan(0.2);
});

test("markers of another kind, and markers that remove beams, have no ends", () => {
  const beams = inForm("beams", { markers: [marker({ type: 1 }), marker({ action: 2 }), marker({ points: [] })] }) as RobotBeams[];
  expect(beams.map(({ points }) => points.length)).toEqual([0, 0, 0]);
});

test("compressed images with colours, and messages, stay as they are", async () => {
  const image = { header: HEADER, format: "jpeg", data: new Uint8Array(4) };
  expect(await inForm("image", image)).toBe(image);
  expect(inForm("message", image)).toBe(image);
});
