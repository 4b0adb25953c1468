// What several tests ask of a page on the viewer.
import assert from "node:assert/strict";
import { setTimeout } from "node:timers/promises";

const LONGEST_WAIT_MS = 60_000; // two pictures of a busy machine may take ten seconds
const ASK_AGAIN_MS = 20; // asking without a pause takes a processor from those who are to answer

// Where the 3D view is on the page.
export async function viewClip(page) {
  return page.locator(".view").boundingBox();
}

export async function phaseIs(page, phase) {
  await page.waitForFunction((wanted) => window.gsv.phase === wanted, phase);
}

// Waits until the picture has stopped changing: poses settled and everything drawn. Brings the page to the front,
// for a page in the background has one frame a second.
export async function settled(page) {
  await page.bringToFront();
  await page.evaluate(async () => {
    const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
    let still = 0;
    let frames = window.gsv.frames;
    while (still < 20) {
      await frame();
      still = window.gsv.frames === frames && !window.gsv.isDrawing ? still + 1 : 0;
      frames = window.gsv.frames;
    }
  });
}

export async function until(isTrue, what) {
  const end = Date.now() + LONGEST_WAIT_MS;
  while (!(await isTrue())) {
    assert.ok(Date.now() < end, `${what} did not come`);
    await setTimeout(ASK_AGAIN_MS);
  }
}

// What the page's server says of its first simulation, past the page's own code.
export async function ask(page, path, body) {
  return page.evaluate(
    async ([path, body]) => {
      const [{ name }] = await (await fetch("api/simulations")).json();
      const request = body
        ? { method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify(body) }
        : {};
      return (await fetch(`api/simulations/${encodeURIComponent(name)}${path}`, request)).json();
    },
    [path, body],
  );
}
