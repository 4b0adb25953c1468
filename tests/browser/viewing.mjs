// Functions that several tests use on a page of the viewer.
import assert from "node:assert/strict";
import { setTimeout } from "node:timers/promises";

const LONGEST_WAIT_MS = 60_000; // two pictures of a busy machine may take ten seconds
const ASK_AGAIN_MS = 20; // queries without a pause would occupy a processor that the answer needs

// Returns the place of the 3D view on the page.
export async function viewClip(page) {
  return page.locator(".view").boundingBox();
}

export const minus = (a, b) => a.map((value, k) => value - b[k]);
export const unit = (a) => a.map((value) => value / Math.hypot(...a));

// Returns the pixel of a point of the world in an image of the view, for a camera at `eye` that looks
// at `target`, with a vertical field of view of 50 degrees and z up. Points are in metres.
export function project(point, eye, target, { width, height }) {
  const dot = (a, b) => a.reduce((sum, value, k) => sum + value * b[k], 0);
  const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d];
  const forward = unit(minus(target, eye));
  const right = unit(cross(forward, [0, 0, 1]));
  const up = cross(right, forward);
  const from = minus(point, eye);
  const scale = height / 2 / Math.tan((25 * Math.PI) / 180) / dot(from, forward);
  return { x: width / 2 + scale * dot(from, right), y: height / 2 - scale * dot(from, up) };
}

export async function phaseIs(page, phase) {
  await page.waitForFunction((wanted) => window.gsv.phase === wanted, phase);
}

// Waits until the picture no longer changes: all poses have arrived and everything is drawn. It
// brings the page to the front, because a page in the background draws one frame per second.
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

// Requests the status of the first simulation directly from the page's server, without the page's
// code.
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
