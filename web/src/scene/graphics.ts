// Makes the browser start its graphics, and waits without blocking the page. Without a graphics
// card, the start takes most of a second. Meanwhile, the page can request its data.
import { drawsInSoftware } from "./software";

const LONGEST_MS = 5000;

// Resolves to false if a graphics card draws. Resolves to true if the browser draws in software, or
// if this is unknown.
export async function startGraphics(): Promise<boolean> {
  return (await askWorker()) ?? drawsInSoftware(document.createElement("canvas")) ?? true;
}

// Starts the graphics in a worker, and resolves to what the worker reports (see graphicsWorker.ts).
// Resolves to null if that fails. Then the page is blocked while the view starts.
function askWorker(): Promise<boolean | null> {
  if (typeof Worker === "undefined" || typeof OffscreenCanvas === "undefined") return Promise.resolve(null);
  let worker: Worker;
  try {
    worker = new Worker(new URL("./graphicsWorker.ts", import.meta.url), { type: "module" });
  } catch {
    return Promise.resolve(null); // some browsers forbid it
  }
  return new Promise<boolean | null>((resolve) => {
    worker.onmessage = ({ data }: MessageEvent<boolean | null>) => resolve(data);
    worker.onerror = () => resolve(null);
    setTimeout(() => resolve(null), LONGEST_MS);
  }).finally(() => worker.terminate());
}
