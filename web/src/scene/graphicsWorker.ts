// Requests a drawing context, which starts the graphics, and reports what draws (graphics.ts). The
// page then makes its own context.
import { drawsInSoftware } from "./software";

postMessage(drawsInSoftware(new OffscreenCanvas(1, 1)));
