// Asks for a context to draw with, which starts what draws, and says what that is (graphics.ts). The
// page makes its own context then.
import { drawsInSoftware } from "./software";

postMessage(drawsInSoftware(new OffscreenCanvas(1, 1)));
