// Has the browser start what draws, and waits without holding up the page: where no graphics card
// does, that takes most of a second, in which the page can ask for what there is to be drawn.
const LONGEST_MS = 5000;

export function startGraphics(): Promise<void> {
  if (typeof Worker === "undefined" || typeof OffscreenCanvas === "undefined") return Promise.resolve();
  let worker: Worker;
  try {
    worker = new Worker(new URL("./graphicsWorker.ts", import.meta.url), { type: "module" });
  } catch {
    return Promise.resolve(); // some browsers forbid it: then the page waits with the view
  }
  return new Promise<void>((resolve) => {
    worker.onmessage = worker.onerror = () => resolve();
    setTimeout(resolve, LONGEST_MS);
  }).finally(() => worker.terminate());
}
