// The forms in which readers get messages: the message itself, or a reduced version of it. A reduced
// version contains only the data that the page draws, in typed arrays. So a worker can compute it and
// pass it to the page without copies (WorkerDecoder).
import type { PointCloud, Points } from "../live/clouds";
import { cloudOf } from "../live/clouds";
import { valuesOfGreyPng } from "../live/greyPng";
import type { ColouredImage, ValueImage } from "../live/valueImage";
import { coloured, depthImageOf } from "../live/valueImage";
import type { RobotBeams } from "./beams";
import { beamsOf } from "./beams";
import type { CompressedImageMessage, MarkerArrayMessage } from "./messages";

type Stamped = Pick<CompressedImageMessage, "header">;

// An image whose pixels are values, with their colours.
export interface DrawnValues extends Stamped {
  values: ValueImage;
  pixels: ColouredImage;
}

// An image that cannot be shown; the sentence gives the reason.
export interface UnreadableImage extends Stamped {
  problem: string;
}

// The browser decodes compressed images with colours.
export type CameraImage = CompressedImageMessage | DrawnValues | UnreadableImage;

export interface Forms {
  message: unknown;
  points: Points; // points that a lidar or depth camera has measured
  image: CameraImage; // image of a camera or depth camera
  beams: RobotBeams[];
}

export type Form = keyof Forms;

// Returns a message in a form. If the form is not "message", the result does not share memory with
// the message, except a compressed image.
export function inForm(form: Form, message: unknown): unknown {
  switch (form) {
    case "message":
      return message;
    case "points":
      return cloudOf(message);
    case "image":
      return imageOf(message as CompressedImageMessage | (PointCloud & Stamped));
    case "beams":
      return beamsOf(message as MarkerArrayMessage);
  }
}

function imageOf(message: CompressedImageMessage | (PointCloud & Stamped)): CameraImage | Promise<CameraImage> {
  const { header } = message;
  if ("point_step" in message) {
    return drawn(header, depthImageOf(message), "The depth image cannot be read: its points are not arranged in rows.");
  }
  const { format, data } = message;
  if (!format.startsWith("mono16")) return message;
  return valuesOfGreyPng(data).then((values) => drawn(header, values, `The image cannot be decoded (format ${format}).`));
}

function drawn(header: Stamped["header"], values: ValueImage | null, problem: string): DrawnValues | UnreadableImage {
  return values ? { header, values, pixels: coloured(values) } : { header, problem };
}
