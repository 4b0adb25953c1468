// Tests what the page adds to images of the server: overlays behind walls, the map of a large world,
// images of a former size, and the change to these images when WebGL is lost.
import assert from "node:assert/strict";
import path from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { isBlank, isRed, picture } from "./pixels.mjs";
import { startServer } from "./server.mjs";
import { phaseIs, settled, until, viewClip } from "./viewing.mjs";

const WORLD = path.join(path.dirname(fileURLToPath(import.meta.url)), "models", "screen.sdf");
const SIZE = { width: 1024, height: 680 };

let server;
let browser;

before(async () => {
  server = await startServer([WORLD, "--robot", "pebble@0,3", "--robot", "pebble@100,0", "--in-process"]);
  browser = await openBrowser({ ...SIZE, drawer: "server" });
  const { page } = await openPage(browser, server.url);
  await waitUntilDrawn(page);
  await phaseIs(page, "running");
  await page.getByRole("button", { name: "Pause", exact: true }).click();
  await phaseIs(page, "paused");
  await page.close();
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

async function opened(hash) {
  const { page, faults } = await openPage(browser, `${server.url}${hash}`);
  await waitUntilDrawn(page);
  await page.locator(".drawn-view").waitFor();
  await sized(page);
  await settled(page);
  return { page, faults };
}

// Waits until the image of the server has the size of the view.
async function sized(page) {
  await page.waitForFunction(() => {
    const canvas = document.querySelector(".drawn-view");
    const { width, height } = document.querySelector(".view").getBoundingClientRect();
    return Math.abs(canvas.width - width) <= 1 && Math.abs(canvas.height - height) <= 1;
  });
}

// The pixels of the image with what is painted on it.
async function pixelsOf(page) {
  const { width, height, data } = await page.evaluate(() => {
    const canvas = document.querySelector(".drawn-view");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let text = "";
    for (let i = 0; i < data.length; i += 8192) text += String.fromCharCode(...data.subarray(i, i + 8192));
    return { width: canvas.width, height: canvas.height, data: btoa(text) };
  });
  return { width, height, data: Buffer.from(data, "base64") };
}

// The number of pixels in a rectangle, given by parts of the image's width and height, that differ.
function changedIn(a, b, [left, top, right, bottom]) {
  let changed = 0;
  for (let y = Math.round(top * a.height); y < bottom * a.height; y++) {
    for (let x = Math.round(left * a.width); x < right * a.width; x++) {
      const at = 4 * (y * a.width + x);
      if ([0, 1, 2].some((k) => Math.abs(a.data[at + k] - b.data[at + k]) > 6)) changed += 1;
    }
  }
  return changed;
}

test("a wall hides the overlays behind it, and not those in front of it", async () => {
  const { page, faults } = await opened("#view=0,-4,1.2,0,0,1&show=labels&select=pebble");
  const plain = await pixelsOf(page);
  await page.keyboard.press("8"); // the grid
  let grid;
  await until(async () => {
    grid = await pixelsOf(page);
    return changedIn(plain, grid, [0, 0.8, 1, 1]) > 300;
  }, "the grid before the wall");
  const onWall = [0.35, 0.25, 0.65, 0.6];
  assert.equal(changedIn(plain, grid, onWall), 0, "the wall hides the grid");
  await page.keyboard.press("8");
  // A robot stands behind the wall, and its collision shapes are not visible either.
  await page.keyboard.press("9");
  await settled(page);
  assert.ok(changedIn(plain, await pixelsOf(page), onWall) < 20, "the wall hides the robot");
  await page.keyboard.press("9");
  await page.close();
  const { page: behind } = await opened("#view=0,6,1.2,0,0,1&show=labels&select=pebble");
  const without = await pixelsOf(behind);
  await behind.keyboard.press("9");
  await until(async () => changedIn(without, await pixelsOf(behind), [0.35, 0.25, 0.65, 0.9]) > 100, "the robot before the wall");
  await behind.close();
  assert.deepEqual(faults, []);
});

test("the map of a large world shows it at the right place, and a click on a robot selects it", async () => {
  const { page, faults } = await opened("#view=50,-250,500,50,20,0&show=&layout=view");
  await page.getByRole("button", { name: "Map", exact: true }).click();
  const bar = page.locator(".scale-bar[aria-label]");
  await bar.waitFor();
  const [, length] = (await bar.getAttribute("aria-label")).match(/bar stands for ([\d.]+) m/);
  const metresPerPixel = Number(length) / (await page.locator(".scale-line").evaluate((line) => line.getBoundingClientRect().width));
  // The image before the map shows the tower too. The map's middle is the point (50, 20), and the
  // tower stands at (100, 40).
  await until(async () => {
    const { width, height, data } = await pixelsOf(page);
    const places = [];
    for (let i = 0; i < data.length; i += 4) {
      if (isRed(data[i], data[i + 1], data[i + 2])) places.push([(i / 4) % width, Math.floor(i / 4 / width)]);
    }
    const median = (axis) => places.map((place) => place[axis]).sort((a, b) => a - b)[places.length >> 1];
    const [east, north] = [median(0) + 0.5 - width / 2, height / 2 - median(1) - 0.5].map((pixels) => pixels * metresPerPixel);
    return Math.abs(east - 50) < 1 && Math.abs(north - 20) < 1 && Math.abs(places.length * metresPerPixel ** 2 - 40 * 40) < 150;
  }, "the red tower on the map");
  await settled(page);
  const at = await page.evaluate(() => window.gsv.robotScreenPosition("pebble"));
  const clip = await viewClip(page);
  const place = { x: (at.x - clip.x - clip.width / 2) * metresPerPixel, y: (clip.y + clip.height / 2 - at.y) * metresPerPixel };
  assert.ok(Math.abs(place.x + 50) < 2 && Math.abs(place.y + 17) < 2, JSON.stringify(place)); // the robot is at (0, 3)
  await page.mouse.click(at.x, at.y);
  await page.waitForFunction(() => window.gsv.chosen[0] === "pebble");
  assert.deepEqual(faults, []);
  await page.close();
});

test("an image of a former size is not distorted until there is a new one", async () => {
  const { page } = await opened("#view=0,-4,1.2,0,0,1");
  const watching = page.evaluate(async () => {
    const shapes = [];
    const canvas = document.querySelector(".drawn-view");
    const first = [canvas.width, canvas.height].join();
    while ([canvas.width, canvas.height].join() === first) {
      const { width, height } = canvas.getBoundingClientRect();
      shapes.push([width / height / (canvas.width / canvas.height), height / document.querySelector(".view").clientHeight]);
      await new Promise(requestAnimationFrame);
    }
    return shapes;
  });
  await page.setViewportSize({ width: 760, height: SIZE.height });
  const shapes = await watching;
  assert.ok(shapes.length > 1);
  for (const [stretch, share] of shapes) assert.ok(Math.abs(stretch - 1) < 0.01 && Math.abs(share - 1) < 0.01, `${stretch} ${share}`);
  await page.close();
});

test("if WebGL is lost and does not come back, the server draws until it is back", async () => {
  const other = await openBrowser({ ...SIZE });
  try {
    const { page } = await openPage(other, server.url);
    await waitUntilDrawn(page);
    await page.evaluate(() => {
      const gl = document.querySelector(".view > canvas").getContext("webgl2");
      window.testContext = gl.getExtension("WEBGL_lose_context");
      window.testContext.loseContext();
    });
    await page.getByText("The 3D view has stopped").waitFor();
    await page.getByText("The browser has lost the graphics card, so the server draws the view now.").waitFor();
    await page.locator(".drawn-view").waitFor();
    await page.getByText("The 3D view has stopped").waitFor({ state: "detached" });
    const button = page.getByTestId("drawer");
    await button.getByText("drawn by the server").waitFor();
    assert.ok(await button.isDisabled());
    await until(async () => !isBlank(await picture(page, await viewClip(page))), "an image of the server");
    await page.evaluate(() => window.testContext.restoreContext());
    await button.getByText("drawn by the browser").waitFor();
    await page.getByText("The graphics card is back, so the browser draws the view again.").waitFor();
    await page.locator(".drawn-view").waitFor({ state: "detached" });
    assert.equal(await page.evaluate(() => localStorage.getItem("gsv.drawer")), "browser"); // the choice before
    await until(async () => !isBlank(await picture(page, await viewClip(page))), "the browser's image");
  } finally {
    await other.close();
  }
});
