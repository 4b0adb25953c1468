// A worker that requests a drawing context, which starts the graphics. It reports whether a
// graphics card or software draws (graphics.ts). The page then makes its own context.
import { drawsInSoftware } from "./software";

postMessage(drawsInSoftware(new OffscreenCanvas(1, 1)));
