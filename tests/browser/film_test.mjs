// Tests that a browser can show the files of `gsv film` and `gsv snapshot`. A film must have all
// frames in their order, and each frame must equal the snapshot of its instant. In a video of
// Debian's ffmpeg, each frame must have its time and look like the snapshot.
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

// Runs a program of the package ffmpeg. Fails with a sentence if the program is missing.
function ffprobe(...args) {
  const { error, status, stdout, stderr } = spawnSync("ffprobe", ["-v", "error", ...args], { encoding: "utf8" });
  assert.ok(error?.code !== "ENOENT", "ffprobe is missing: install the package ffmpeg (tools/setup installs all packages of the tests)");
  assert.equal(status, 0, stderr);
  return JSON.parse(stdout);
}

// Plays a video in an empty page up to its end, because the viewer's page allows no videos. Returns its size, its duration in seconds, and for each
// of these times the mean difference (0 to 255) between the pixels of the video and those of an
// image.
async function playedBeside(video, images) {
  const empty = await browser.context.newPage();
  const played = await empty.evaluate(
    async ([film, shots]) => {
      const bytes = (text) => Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
      const player = document.createElement("video");
      player.muted = true;
      const eventOf = (name) => new Promise((resolve, reject) => {
        player.addEventListener(name, resolve, { once: true });
        player.addEventListener("error", () => reject(new Error(player.error.message)), { once: true });
      });
      const loaded = eventOf("loadeddata");
      player.src = URL.createObjectURL(new Blob([bytes(film)], { type: "video/webm" }));
      await loaded;
      const canvas = new OffscreenCanvas(player.videoWidth, player.videoHeight);
      const context = canvas.getContext("2d");
      const pixels = (image) => {
        context.drawImage(image, 0, 0);
        return context.getImageData(0, 0, canvas.width, canvas.height).data;
      };
      // Resolves when the browser shows the frame that contains this time. A frame lasts 0.1 s. The event
      // "seeked" may come before the browser shows the frame.
      const showFrame = (time) => new Promise((resolve, reject) => {
        const deadline = setTimeout(() => reject(new Error(`no frame for ${time} s`)), 30_000);
        player.requestVideoFrameCallback(function check(_, { mediaTime }) {
          if (mediaTime > time || mediaTime + 0.1 <= time) return player.requestVideoFrameCallback(check);
          clearTimeout(deadline);
          resolve();
        });
        player.currentTime = time;
      });
      const differences = [];
      for (const [time, png] of shots) {
        await showFrame(time);
        const [shown, wanted] = [pixels(player), pixels(await createImageBitmap(new Blob([bytes(png)], { type: "image/png" })))];
        differences.push(shown.reduce((sum, value, i) => sum + Math.abs(value - wanted[i]), 0) / (0.75 * shown.length));
      }
      const ended = eventOf("ended");
      player.currentTime = 0;
      await player.play();
      await ended;
      return { width: canvas.width, height: canvas.height, duration: player.duration, differences, end: player.currentTime };
    },
    [video.toString("base64"), images.map(([time, png]) => [time, png.toString("base64")])],
  );
  await empty.close();
  return played;
}

test("a video of Debian's ffmpeg has a frame for each tenth of a second with its time, and a browser plays it", async () => {
  const missing = spawnSync("ffmpeg", ["-version"]).error?.code === "ENOENT";
  assert.ok(!missing, "ffmpeg is missing: install the package ffmpeg (tools/setup installs all packages of the tests)");
  const video = write("run.webm", "film", recording, "--from", "1", "--to", "3", "--fps", "10", "--follow", "pebble");
  const { streams, frames } = ffprobe("-show_entries", "stream=codec_type,width,height,avg_frame_rate:frame=pts_time", "-of", "json", path.join(folder, "run.webm"));
  assert.deepEqual(streams, [{ codec_type: "video", width: 320, height: 180, avg_frame_rate: "10/1" }]);
  assert.ok(frames.length === 20 || frames.length === 21, `${frames.length} frames`);
  frames.forEach(({ pts_time: time }, i) => assert.ok(Math.abs(Number(time) - i / 10) < 0.0011, `frame ${i} is at ${time} s`)); // WebM has whole milliseconds
  const instants = [0, 0.5, 1.5];
  const shots = instants.map((time) => [time + 0.05, write(`webm-${time}.png`, "snapshot", recording, "--at", String(1 + time), "--follow", "pebble")]);
  const { width, height, duration, differences, end } = await playedBeside(video, shots);
  assert.deepEqual([width, height], [320, 180]);
  assert.ok(Math.abs(duration - frames.length / 10) < 0.11 && Math.abs(end - duration) < 0.11, `${duration} s, ended at ${end} s`);
  for (const difference of differences) assert.ok(difference < 6, `the pixels differ by ${differences}`);
  // Each instant looks like its own snapshot, and less like the others.
  const others = (await playedBeside(video, [[0.05, shots[2][1]], [1.55, shots[0][1]]])).differences;
  assert.ok(Math.min(...others) > 1.5 * Math.max(...differences), `${differences} and ${others}`);
});
