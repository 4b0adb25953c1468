// Tests pages that show images of the server at the same time: pages with the same camera share a
// drawing, and the server limits the number of views. The metrics of the server count the drawings.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { isBlank, picture } from "./pixels.mjs";
import { startServer } from "./server.mjs";
import { ask, phaseIs, settled, until, viewClip } from "./viewing.mjs";

const SIZE = { width: 900, height: 600 };
const MAX_VIEWS = 8; // the limit of the server
const CAMERA = "#view=0,-5,3,0,0,0.5&show=&layout=view";
const OTHER_CAMERA = "#view=0,5,3,0,0,0.5&show=&layout=view";

let server;
let browser; // without WebGL
const pages = []; // two pages with the same camera, and one with another camera
const faults = [];

before(async () => {
  server = await startServer(["playground", "--robot", "pebble@0,0", "--behaviour", "wander", "--in-process"]);
  browser = await openBrowser({ ...SIZE, drawer: null, webgl: false });
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

async function open(hash) {
  const { page, faults: ofPage } = await openPage(browser, `${server.url}${hash}`);
  faults.push(ofPage);
  return page;
}

// Opens a page, and waits until it shows an image of the size of its view.
async function opened(hash) {
  const page = await open(hash);
  await waitUntilDrawn(page);
  await page.waitForFunction(() => {
    const canvas = document.querySelector(".drawn-view");
    const { width, height } = document.querySelector(".view").getBoundingClientRect();
    return canvas !== null && Math.abs(canvas.width - width) <= 1 && Math.abs(canvas.height - height) <= 1;
  });
  return page;
}

async function metrics() {
  const text = await (await fetch(new URL("metrics", server.url))).text();
  const value = (name) => Number(new RegExp(`^${name} (\\S+)$`, "m").exec(text)[1]);
  return { views: value("gsv_drawn_views"), clients: value("gsv_drawn_view_clients"), images: value("gsv_drawn_images_total") };
}

async function untilMetrics(views, clients) {
  await until(async () => {
    const now = await metrics();
    return now.views === views && now.clients === clients;
  }, `${views} views for ${clients} clients`);
}

// The pixels of the image that a page shows, as text.
const pixelsOf = (page) =>
  page.evaluate(async () => {
    const canvas = document.querySelector(".drawn-view");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return `${canvas.width}x${canvas.height} ${new Uint8Array(await crypto.subtle.digest("SHA-256", data))}`;
  });

// Makes one step, and waits until all pages show it. Returns the number of images that the server
// has drawn for it.
async function drawnForOneStep() {
  const { images } = await metrics();
  await ask(pages[0], "/step", { count: 1 });
  const { time_s: time } = await ask(pages[0], "");
  await until(async () => (await metrics()).images > images, "an image of the step");
  for (const page of pages) {
    await page.waitForFunction((then) => window.gsv.time > then - 1e-6, time);
    await settled(page);
  }
  return (await metrics()).images - images;
}

test("two pages with the same camera show the same pixels of one drawing", async () => {
  pages.push(await opened(CAMERA));
  await phaseIs(pages[0], "running");
  await ask(pages[0], "/pause", {});
  await untilMetrics(1, 1);
  pages.push(await opened(CAMERA));
  await untilMetrics(1, 2);
  for (const page of pages) await settled(page);
  assert.equal(isBlank(await picture(pages[1], await viewClip(pages[1]))), false);
  const [first, second] = await Promise.all(pages.map(pixelsOf));
  assert.equal(first, second);
  assert.equal(await drawnForOneStep(), 1);
  const [one, two] = await Promise.all(pages.map(pixelsOf));
  assert.equal(one, two);
});

test("a page with another camera adds one view, and shows another image", async () => {
  pages.push(await opened(OTHER_CAMERA));
  await untilMetrics(2, 3);
  await settled(pages[2]);
  assert.notEqual(await pixelsOf(pages[2]), await pixelsOf(pages[0]));
  assert.equal(await drawnForOneStep(), 2);
  assert.equal(await pixelsOf(pages[0]), await pixelsOf(pages[1]));
});

test("a page that leaves the others' camera has its own drawing, and returns to theirs", async () => {
  const before = await pixelsOf(pages[1]);
  await pages[1].keyboard.press("t"); // from above
  await untilMetrics(3, 3);
  await until(async () => (await pixelsOf(pages[1])) !== before, "the view from above");
  assert.equal(await pixelsOf(pages[0]), before);
  await pages[1].goto("about:blank");
  await untilMetrics(2, 2);
  await pages[1].goto(`${server.url}${CAMERA}`);
  await untilMetrics(2, 3);
  await waitUntilDrawn(pages[1]);
  await until(async () => (await pixelsOf(pages[1])) === before, "the shared image");
});

test("beyond the limit of views, a page shows the reason and works, and Try again shows the view", async () => {
  const streams = [];
  let refused;
  try {
    for (let i = 2; i < MAX_VIEWS; i++) {
      const ended = new AbortController();
      streams.push(ended);
      const { status } = await fetch(new URL(`view.mjpeg?size=64x48&eye=${i},0,2&target=0,0,0`, server.url), { signal: ended.signal });
      assert.equal(status, 200);
    }
    await untilMetrics(MAX_VIEWS, 1 + MAX_VIEWS);
    refused = await open("#view=5,0,3,0,0,0.5&show=&layout=view");
    const card = refused.locator(".overlay .message");
    await card.getByRole("heading", { name: "The server does not draw the view" }).waitFor();
    await card.getByText(`the server already draws ${MAX_VIEWS} views, which is the limit; close one of them, or request a view that is already drawn`).waitFor();
    // The page shows the simulation's state.
    const { time_s: time } = await ask(refused, "");
    await ask(refused, "/step", { count: 1 });
    await refused.waitForFunction((then) => window.gsv.time > then, time);
    await refused.keyboard.press("Control+k");
    await refused.getByRole("combobox", { name: "Command, robot, topic or panel" }).fill("robot pebble");
    await refused.keyboard.press("Enter");
    await refused.waitForFunction(() => window.gsv.chosen[0] === "pebble");
    // The other pages still get their images.
    assert.equal((await metrics()).views, MAX_VIEWS);
    assert.ok((await drawnForOneStep()) >= 2);
    streams.pop().abort();
    await untilMetrics(MAX_VIEWS - 1, MAX_VIEWS);
    await refused.getByRole("button", { name: "Try again" }).click();
    await card.waitFor({ state: "detached" });
    await untilMetrics(MAX_VIEWS, 1 + MAX_VIEWS);
    await until(async () => !isBlank(await picture(refused, await viewClip(refused))), "the view");
  } finally {
    for (const stream of streams) stream.abort();
    await refused?.close();
  }
});

test("beyond the limit of views, a browser with WebGL draws the view itself, and says why", async () => {
  const other = await openBrowser(SIZE);
  const streams = [];
  try {
    await untilMetrics(2, 3);
    for (let i = 2; i < MAX_VIEWS; i++) {
      const ended = new AbortController();
      streams.push(ended);
      await fetch(new URL(`view.mjpeg?size=64x48&eye=${i},0,2&target=0,0,0`, server.url), { signal: ended.signal });
    }
    const { page } = await openPage(other, `${server.url}?view=server#view=5,0,3,0,0,0.5&show=`);
    await page.getByText(/the server already draws 8 views, which is the limit/).waitFor();
    await page.getByTestId("drawer").getByText("drawn by the browser").waitFor();
    await waitUntilDrawn(page);
    await until(async () => !isBlank(await picture(page, await viewClip(page))), "the browser's image");
  } finally {
    for (const stream of streams) stream.abort();
    await other.close();
  }
});

test("no other host was contacted and there were no errors", () => {
  assert.deepEqual(faults.flat(), []);
});
