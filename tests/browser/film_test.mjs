// Tests that a browser can show the files of `gsv film` and `gsv snapshot`. A film must have all
// frames in their order, and each frame must equal the snapshot of its instant.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { openBrowser, openPage } from "./browser.mjs";
import { program, record, startReplay } from "./server.mjs";

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-film-"));
const recording = path.join(folder, "run.mcap");
let server;
let browser;
let page;

before(async () => {
  await record(recording, ["playground", "--robot", "pebble@0,-1.5", "--behaviour", "wander", "--duration", "4"]);
  server = await startReplay([recording]);
  browser = await openBrowser({ width: 800, height: 600 });
  ({ page } = await openPage(browser, server.url));
});

after(async () => {
  await browser?.close();
  await server?.stop();
  fs.rmSync(folder, { recursive: true, force: true });
});

function write(name, ...args) {
  const file = path.join(folder, name);
  const { status, stderr } = spawnSync(program(), [...args, "-o", file, "--size", "320x180"], { encoding: "utf8" });
  assert.equal(status, 0, stderr);
  return fs.readFileSync(file);
}

// Decodes an image as the browser does. Returns for each frame its size and its pixels as text.
async function decoded(bytes) {
  return page.evaluate(async (text) => {
    const data = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
    const decoder = new ImageDecoder({ data, type: "image/png" });
    await decoder.tracks.ready;
    await decoder.completed;
    const frames = [];
    for (let frameIndex = 0; frameIndex < decoder.tracks.selectedTrack.frameCount; frameIndex++) {
      const { image } = await decoder.decode({ frameIndex });
      const canvas = new OffscreenCanvas(image.displayWidth, image.displayHeight);
      const context = canvas.getContext("2d");
      context.drawImage(image, 0, 0);
      const pixels = context.getImageData(0, 0, canvas.width, canvas.height).data;
      const hash = new Uint8Array(await crypto.subtle.digest("SHA-256", pixels));
      frames.push({ width: canvas.width, height: canvas.height, pixels: [...hash].join() });
    }
    return frames;
  }, bytes.toString("base64"));
}

test("a film has a frame for each tenth of a second, exactly as the snapshots", async () => {
  const film = await decoded(write("run.apng", "film", recording, "--from", "1", "--to", "3", "--fps", "10"));
  assert.ok(film.length === 20 || film.length === 21, `${film.length} frames`);
  assert.ok(film.every(({ width, height }) => width === 320 && height === 180));
  assert.ok(new Set(film.map(({ pixels }) => pixels)).size > 10, "the robot moves");
  for (const [frame, time] of [[0, "1"], [5, "1.5"], [15, "2.5"]]) {
    const [snapshot] = await decoded(write(`${frame}.png`, "snapshot", recording, "--at", time));
    assert.equal(film[frame].pixels, snapshot.pixels, `frame ${frame}`);
  }
});
