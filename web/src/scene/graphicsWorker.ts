// Asks for a context to draw with, which starts what draws (graphics.ts). The page makes its own then.
new OffscreenCanvas(1, 1).getContext("webgl2");
postMessage("started");
