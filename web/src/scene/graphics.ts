// Has the browser start what draws, and waits without holding up the page: where no graphics card
// does, that takes most of a second, in which the page can ask for what there is to be drawn.
import { drawsInSoftware } from "./software";

const LONGEST_MS = 5000;

// Gives whether it draws in software.
export async function startGraphics(): Promise<boolean> {
  return (await askWorker()) ?? drawsInSoftware(document.createElement("canvas")) ?? true;
}

// Null where no worker can tell: then the page waits with the view.
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
