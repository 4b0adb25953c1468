// A worker that requests a drawing context, which starts the graphics. It reports whether a
// graphics card or software draws (see graphics.ts). The page then creates its own context.
import { drawsInSoftware } from "./software";

postMessage(drawsInSoftware(new OffscreenCanvas(1, 1)));
