#!/usr/bin/env node
// Measures the viewer in a browser without a graphics card: the time to the first image and to the
// list of robots, the time from a click to the displayed selection, frames per second, traffic, the
// number of drawing calls, the images that the server draws and pushes, and the growth of the page's
// memory.
//
//   bench/viewing.mjs BUILD [WORLD [picture|arrival|clicks|choosing|traffic|frames|drawing|pushed|growth]]
//
// BUILD is a release build (build/release). WORLD is a world for the first image; the default is
// the TurtleBot3 house in GSV_REAL_DIR. The third argument selects a single measurement. The
// machine should be idle; load_average in the output reports the load. Prints one JSON object; times in ms.
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import process from "node:process";

const HOUSE = path.join(process.env.GSV_REAL_DIR ?? "", "turtlebot3/worlds/turtlebot3_house.world");
const [build, given, only = ""] = process.argv.slice(2);
const world = given || HOUSE;
if (!build) throw new Error("usage: bench/viewing.mjs BUILD [WORLD [picture|arrival|clicks|choosing|traffic|frames|drawing|pushed|growth]]");
process.env.GSV_BUILD_DIR = path.resolve(build);
const { openBrowser, openPage, waitUntilDrawn } = await import("../tests/browser/browser.mjs");
const { crowd, noteClicks, timeClicks } = await import("../tests/browser/crowd.mjs");
const { startServer } = await import("../tests/browser/server.mjs");

const PICTURES = 5;
const CLICKS = 20;
const ARRIVALS = 7;
const FRAMES_S = 15;
const SIZE = { width: 1280, height: 800 };
const FULL_WINDOW = { width: 1366, height: 768 };
const IN_OFFICE = ["office", "--robot", "pebble@-2,-1", "--behaviour", "wander", "--in-process"];

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-viewing-"));

function summary(times) {
  const sorted = [...times].sort((a, b) => a - b).map((time) => Math.round(time));
  return { median: sorted[sorted.length >> 1], worst: sorted.at(-1), all: times.map((time) => Math.round(time)) };
}

// `script` runs with the argument in the page before the page's own scripts.
async function withPage(url, use, script = () => {}, argument = undefined) {
  const browser = await openBrowser(SIZE);
  try {
    await browser.context.addInitScript(script, argument);
    const { page } = await openPage(browser, url);
    await waitUntilDrawn(page, 120_000);
    return await use(page);
  } finally {
    await browser.close();
  }
}

async function withServer(args, use) {
  const server = await startServer(args);
  try {
    return await use(server.url);
  } finally {
    await server.stop();
  }
}

// Measures from opening the address to an image with every shape, each time in a new browser with
// an empty cache. `prepare` prepares the browser before the time starts. The first measurement
// after the server's start is reported separately.
const picturesWith = (prepare) =>
  withServer([world, "--robot", "pebble@-2,-1", "--behaviour", "wander"], async (url) => {
    const times = [];
    for (let i = 0; i <= PICTURES; i++) {
      const browser = await openBrowser(SIZE);
      await prepare(browser);
      const page = await browser.context.newPage();
      const begin = performance.now();
      await page.goto(url, { waitUntil: "commit" });
      await page.waitForFunction(() => window.gsv !== undefined);
      await page.evaluate(() => window.gsv.ready);
      times.push(performance.now() - begin);
      await browser.close();
    }
    return { first_after_start: Math.round(times[0]), later: summary(times.slice(1)) };
  });

// Draws on another page first, as in a browser that has been open for a while: the browser's
// graphics process is then already running.
async function drawSomethingElse({ context }) {
  const page = await context.newPage();
  await page.setContent("<canvas></canvas>");
  await page.evaluate(
    () =>
      new Promise((drawn) => {
        const gl = document.querySelector("canvas").getContext("webgl2");
        gl.clear(gl.COLOR_BUFFER_BIT);
        requestAnimationFrame(() => requestAnimationFrame(drawn));
      }),
  );
}

const firstPicture = async () => ({
  in_a_new_browser: await picturesWith(() => {}),
  in_an_open_browser: await picturesWith(drawSomethingElse),
});

const clicks = (robots) =>
  withServer(crowd(folder, robots), (url) =>
    withPage(url, async (page) => {
      await noteClicks(page);
      const { list, picture } = await timeClicks(page, CLICKS);
      return { robots, in_the_list: summary(list), in_the_picture: summary(picture) };
    }),
  );

const frames = (robots) =>
  withServer(crowd(folder, robots), (url) =>
    withPage(url, async (page) => {
      const count = () => page.evaluate(() => [window.gsv.frames, performance.now()]);
      const [before, from] = await count();
      await new Promise((resolve) => setTimeout(resolve, FRAMES_S * 1000));
      const [after, to] = await count();
      return { robots, frames_a_second: Math.round((10_000 * (after - before)) / (to - from)) / 10 };
    }),
  );

// Measures the view that the server draws: images per second, and the time from a state of the world to its image
// on the screen.
const pushed = (name, args) =>
  withServer(args, async (url) => {
    const browser = await openBrowser({ ...FULL_WINDOW, drawer: null, webgl: false });
    try {
      const { page } = await openPage(browser, url);
      await waitUntilDrawn(page, 120_000);
      await new Promise((resolve) => setTimeout(resolve, 3000)); // the panels have been laid out
      const images = () => page.evaluate(() => [[...window.gsv.imageDelaysMs], performance.now()]);
      const [before, from] = await images();
      await new Promise((resolve) => setTimeout(resolve, FRAMES_S * 1000));
      const [after, to] = await images();
      const delays = after.slice(before.length).sort((a, b) => a - b);
      const delay = (part) => Math.round(delays[Math.floor(part * (delays.length - 1))]);
      const each_second = Math.round((10_000 * delays.length) / (to - from)) / 10;
      return { world: name, images_a_second: each_second, delay_ms: { median: delay(0.5), p95: delay(0.95) } };
    } finally {
      await browser.close();
    }
  });

// Counts the drawing calls and triangles that a graphics card would get for each frame, and measures the
// time that the page's script takes for the frame. The page omits nothing here, although there is no graphics card.
function countDrawing() {
  const drawn = (window.testDrawn = { calls: 0, triangles: 0, script_ms: 0 });
  const count = (mode, vertices) => {
    drawn.calls += 1;
    if (mode === WebGL2RenderingContext.TRIANGLES) drawn.triangles += vertices / 3;
  };
  const gl = WebGL2RenderingContext.prototype;
  const follow = (name, verticesOf) => {
    const draw = gl[name];
    gl[name] = function (mode, ...rest) {
      count(mode, verticesOf(...rest));
      return draw.call(this, mode, ...rest);
    };
  };
  follow("drawArrays", (first, vertices) => vertices);
  follow("drawArraysInstanced", (first, vertices, instances) => vertices * instances);
  follow("drawElements", (vertices) => vertices);
  follow("drawElementsInstanced", (vertices, type, offset, instances) => vertices * instances);
  const request = requestAnimationFrame;
  window.requestAnimationFrame = (draw) =>
    request((now) => {
      const from = performance.now();
      draw(now);
      drawn.script_ms += performance.now() - from;
    });
}

const drawing = (robots) =>
  withServer(crowd(folder, robots), (url) => withPage(`${url}?quality=high`, (page) => drawnBy(page, robots), countDrawing));

async function drawnBy(page, robots) {
  const count = () => page.evaluate(() => ({ ...window.testDrawn, frames: window.gsv.frames }));
  const before = await count();
  await new Promise((resolve) => setTimeout(resolve, FRAMES_S * 1000));
  const after = await count();
  const each = (name) => Math.round((10 * (after[name] - before[name])) / (after.frames - before.frames)) / 10;
  return { robots, calls_a_frame: each("calls"), triangles_a_frame: each("triangles"), script_ms_a_frame: each("script_ms") };
}

// Runs in the page before its own script. Stores when the first row of the list of robots is on the
// screen, in ms after the address was opened. A query from outside the page would wait for the
// page's script.
function noteList() {
  new MutationObserver((_, observer) => {
    if (!document.querySelector("[data-robot]")) return;
    observer.disconnect();
    requestAnimationFrame(() => setTimeout(() => (window.testListAt = performance.now())));
  }).observe(document, { subtree: true, childList: true });
}

// Measures from opening the address to the first row of the list, and to an image with every shape,
// each time in a new browser.
const arrival = (robots) =>
  withServer(crowd(folder, robots), async (url) => {
    const [list, picture] = [[], []];
    for (let i = 0; i < ARRIVALS; i++) {
      const browser = await openBrowser(SIZE);
      await drawSomethingElse(browser);
      const page = await browser.context.newPage();
      await page.addInitScript(noteList);
      const begin = performance.now();
      await page.goto(url, { waitUntil: "commit" });
      await page.waitForFunction(() => window.gsv !== undefined);
      await page.evaluate(() => window.gsv.ready);
      picture.push(performance.now() - begin);
      list.push(await page.evaluate(() => window.testListAt));
      await browser.close();
    }
    return { robots, to_the_list: summary(list), to_the_picture: summary(picture) };
  });

const choosing = (robots) =>
  withServer(crowd(folder, robots), (url) =>
    withPage(url, async (page) => {
      await noteClicks(page);
      const { list, picture } = await timeClicks(page, 6);
      return { robots, in_the_list: summary(list), in_the_picture: summary(picture) };
    }),
  );

// Counts the bytes and messages of each topic in window.testTraffic.
function countTraffic() {
  const traffic = (window.testTraffic = {});
  const Socket = window.WebSocket;
  window.WebSocket = class extends Socket {
    constructor(...given) {
      super(...given);
      const [topics, wanted] = [new Map(), new Map()]; // by channel; by subscription
      const send = this.send.bind(this);
      this.send = (data) => {
        const message = typeof data === "string" ? JSON.parse(data) : {};
        if (message.op === "subscribe") for (const { id, channelId } of message.subscriptions) wanted.set(id, topics.get(channelId));
        send(data);
      };
      this.addEventListener("message", ({ data }) => {
        const bytes = data.byteLength ?? data.length;
        let topic = "text";
        if (typeof data === "string") {
          const message = JSON.parse(data);
          if (message.op === "advertise") for (const { id, topic } of message.channels) topics.set(id, topic);
        } else {
          const view = new DataView(data);
          topic = view.getUint8(0) === 1 ? (wanted.get(view.getUint32(1, true)) ?? "?") : "time";
        }
        const of = (traffic[topic] ??= { messages: 0, bytes: 0 });
        of.messages += 1;
        of.bytes += bytes;
      });
    }
  };
}

// Returns the traffic in kB per second, in total and by topic, with the initial layers or with all
// layers switched off.
const traffic = (robots, off) =>
  withServer(crowd(folder, robots), (url) =>
    withPage(
      `${url}${off ? "#show=" : ""}`,
      async (page) => {
        const count = () => page.evaluate(() => [JSON.parse(JSON.stringify(window.testTraffic)), performance.now()]);
        await new Promise((resolve) => setTimeout(resolve, 3000)); // data that is sent only once has arrived
        const [before, from] = await count();
        await new Promise((resolve) => setTimeout(resolve, FRAMES_S * 1000));
        const [after, to] = await count();
        const topics = Object.entries(after).map(([topic, { bytes, messages }]) => {
          const past = before[topic] ?? { bytes: 0, messages: 0 };
          const each = (value) => Math.round((10_000 * value) / (to - from)) / 10;
          return [topic, { kB_a_second: each((bytes - past.bytes) / 1000), messages_a_second: each(messages - past.messages) }];
        });
        const all = topics.reduce((sum, [, { kB_a_second }]) => sum + kB_a_second, 0);
        const largest = topics.filter(([, { kB_a_second }]) => kB_a_second > 0.5);
        return { robots, layers: off ? "off" : "as at first", kB_a_second: Math.round(all), topics: Object.fromEntries(largest) };
      },
      countTraffic,
    ),
  );

// The page's memory is measured after a while, in which caches fill. Plots grow with simulated time
// up to their limit, so none is open.
// GSV_GROWTH_MIN is the duration of the measurement in minutes. GSV_GROWTH_SPEED makes the time of
// the page pass faster: with 4, simulations run at four times real time and the page gets each
// message four times, so 120 minutes have the messages and the simulated time of 8 hours.
const GROWTH = {
  speed: Number(process.env.GSV_GROWTH_SPEED ?? 1),
  size: process.env.GSV_GROWTH_SIZE?.split("x").map(Number), // of the window, such as 640x400
  warmUpS: Number(process.env.GSV_GROWTH_WARM_UP_S ?? 60),
  everyS: 10,
  samples: Math.max(3, 6 * Number(process.env.GSV_GROWTH_MIN ?? 2)),
  robots: 50,
  dayH: 8,
};

// Returns the growth of a value in 8 hours, from the medians of the first and the last third of the
// samples.
function growthOf(samples, name) {
  const third = Math.floor(samples.length / 3);
  const middle = (part, key) => part.map((sample) => sample[key]).sort((a, b) => a - b)[part.length >> 1];
  const [first, last] = [samples.slice(0, third), samples.slice(-third)];
  const hours = (GROWTH.speed * (middle(last, "at_s") - middle(first, "at_s"))) / 3600;
  return Math.round((GROWTH.dayH * (middle(last, name) - middle(first, name))) / hours);
}

// Runs in the page: the page gets each message of a topic `speed` times.
function repeatMessages(speed) {
  const Socket = window.WebSocket;
  window.testMessages = 0;
  window.WebSocket = class extends Socket {
    set onmessage(receive) {
      super.onmessage = receive && ((event) => {
        const isData = typeof event.data !== "string" && new DataView(event.data).getUint8(0) === 1;
        for (let i = 1; isData && i < speed; i++) receive(new MessageEvent("message", { data: event.data.slice(0) }));
        receive(event);
        window.testMessages += isData ? speed : 1;
      });
    }
  };
}

// Measures the page's heap after forced garbage collections, its nodes and its listeners.
const growth = (name, args) =>
  withServer([...args, "--real-time-factor", `${GROWTH.speed}`], (url) =>
    withPage(url, async (page) => {
      if (GROWTH.size) await page.setViewportSize({ width: GROWTH.size[0], height: GROWTH.size[1] });
      await page.locator("[data-robot]").first().click();
      const devTools = await page.context().newCDPSession(page);
      await devTools.send("Performance.enable");
      const begin = performance.now();
      const sample = async () => {
        for (let i = 0; i < 3; i++) await devTools.send("HeapProfiler.collectGarbage");
        const { metrics } = await devTools.send("Performance.getMetrics");
        const of = (name) => metrics.find((metric) => metric.name === name).value;
        return {
          at_s: Math.round((performance.now() - begin) / 1000),
          heap_kB: Math.round(of("JSHeapUsedSize") / 1000),
          nodes: of("Nodes"),
          listeners: of("JSEventListeners"),
          messages: await page.evaluate(() => window.testMessages),
        };
      };
      await new Promise((resolve) => setTimeout(resolve, 1000 * GROWTH.warmUpS));
      const samples = [];
      while (samples.length < GROWTH.samples) {
        samples.push(await sample());
        if (process.env.GSV_GROWTH_LOG) fs.appendFileSync(process.env.GSV_GROWTH_LOG, `${JSON.stringify(samples.at(-1))}\n`);
        await new Promise((resolve) => setTimeout(resolve, 1000 * GROWTH.everyS));
      }
      const names = ["heap_kB", "nodes", "listeners"];
      const inADay = Object.fromEntries(names.map((name) => [name, growthOf(samples, name)]));
      return { world: name, growth_in_8_hours: inADay, samples };
    }, repeatMessages, GROWTH.speed),
  );

try {
  const result = { world: path.basename(world), load_average: os.loadavg()[0] };
  const isWanted = (part) => only === "" || only === part;
  if (isWanted("picture") && fs.existsSync(world)) result.first_picture = await firstPicture();
  if (isWanted("clicks")) result.clicks = await clicks(1000);
  if (isWanted("arrival")) result.arrival = [await arrival(5), await arrival(50), await arrival(500)];
  if (isWanted("choosing")) result.choosing = await choosing(500);
  if (isWanted("traffic")) result.traffic = [await traffic(50, true), await traffic(50, false), await traffic(500, true), await traffic(500, false)];
  if (isWanted("frames")) result.frames = [await frames(100), await frames(1000)];
  if (isWanted("drawing")) result.drawing = [await drawing(100), await drawing(1000)];
  if (isWanted("growth")) {
    result.growth = [await growth("office", IN_OFFICE), await growth(`${GROWTH.robots} robots`, crowd(folder, GROWTH.robots))];
  }
  if (isWanted("pushed")) {
    result.pushed = [
      await pushed("office", IN_OFFICE),
      await pushed("50 robots", crowd(folder, 50)),
      await pushed("500 robots", crowd(folder, 500)),
    ];
  }
  console.log(JSON.stringify(result, null, 2));
} finally {
  fs.rmSync(folder, { recursive: true, force: true });
}
