// Tests the view that the server draws: in a browser without WebGL, and if it is chosen.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { setTimeout } from "node:timers/promises";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { changedPixels, isBlank, picture, showsLabel } from "./pixels.mjs";
import { startServer } from "./server.mjs";
import { ask, settled, until } from "./viewing.mjs";

const SIMULATION = ["playground", "--robot", "pebble@0,0", "--behaviour", "wander"];

let server;
let browser;
let page;
let faults;
const requested = []; // single images

before(async () => {
  server = await startServer(SIMULATION);
  browser = await openBrowser({ width: 1024, height: 680, drawer: null, webgl: false });
  browser.context.on("request", (request) => request.url().includes("view.jpg") && requested.push(request.url()));
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

// Returns the number of different colours in the image, and a checksum.
async function lookAtImage() {
  return page.evaluate(() => {
    const canvas = document.querySelector(".drawn-view");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const colours = new Set();
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) {
      const colour = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
      colours.add(colour);
      sum = (Math.imul(sum, 31) + colour) | 0;
    }
    return { colours: colours.size, sum, width: canvas.width, height: canvas.height };
  });
}

async function untilOtherImage(sum) {
  for (;;) {
    await page.waitForFunction((then) => window.gsv.frames > then, await page.evaluate(() => window.gsv.frames));
    const image = await lookAtImage();
    if (image.sum !== sum) return image;
  }
}

test("without WebGL the server draws the view at the size of the window", async () => {
  assert.equal(await page.evaluate(() => document.createElement("canvas").getContext("webgl2")), null);
  await page.locator(".drawn-view").waitFor();
  // The first image may show the window before the panels were added.
  await page.waitForFunction(() => {
    const canvas = document.querySelector(".drawn-view");
    const { width, height } = document.querySelector(".view").getBoundingClientRect();
    return Math.abs(canvas.width - width) <= 1 && Math.abs(canvas.height - height) <= 1;
  });
  await page.getByText("This browser has no WebGL, so the server draws the view.").waitFor();
  const image = await lookAtImage();
  assert.ok(image.colours > 100, `only ${image.colours} colours`);
  assert.equal(await page.getByTestId("drawer").textContent(), "drawn by the server");
  assert.ok(await page.getByTestId("drawer").isDisabled());
});

test("the image follows the simulation and the camera", async () => {
  const first = await lookAtImage();
  const moved = await untilOtherImage(first.sum);
  await page.keyboard.press("t"); // from above
  await untilOtherImage(moved.sum);
});

test("the image shows the robots' names, and a click selects a robot", async () => {
  // The robot may move between the two queries.
  await until(async () => {
    const [label] = await page.evaluate(() => window.gsv.labels);
    return label?.name === "pebble" && showsLabel(await picture(page, label));
  }, "the name in the image");
  // On a slow machine the robot may have moved away before the click arrives.
  await until(async () => {
    const place = await page.evaluate(() => window.gsv.robotScreenPosition("pebble"));
    if (place) await page.mouse.click(place.x, place.y);
    return page.getByRole("heading", { name: "pebble" }).first().isVisible();
  }, "the selection of the robot");
});

test("while the camera moves, a name stays at its robot in the image", async () => {
  await page.keyboard.press("f"); // the camera follows the robot
  const gaps = await page.evaluate(async () => {
    const canvas = document.querySelector(".view canvas:not(.drawn-view)");
    const found = [];
    for (let i = 0; i < 20; i++) {
      const [x, y] = [400 + 8 * i, 300];
      for (const type of i === 0 ? ["pointerdown"] : ["pointermove"]) {
        canvas.dispatchEvent(new PointerEvent(type, { pointerId: 1, button: 0, buttons: 1, clientX: x, clientY: y, bubbles: true }));
      }
      const then = window.gsv.frames;
      while (window.gsv.frames === then) await new Promise(requestAnimationFrame);
      const place = window.gsv.robotScreenPosition("pebble");
      const [box] = window.gsv.labels;
      if (place && box) found.push(Math.abs(box.x + box.width / 2 - place.x));
    }
    canvas.dispatchEvent(new PointerEvent("pointerup", { pointerId: 1, button: 0, clientX: 552, clientY: 300, bubbles: true }));
    return found;
  });
  assert.ok(gaps.length > 5, `the name was shown ${gaps.length} times`);
  assert.ok(Math.max(...gaps) < 12, `names were ${Math.max(...gaps)} pixels away`);
});

// Stores the image and what is painted on it. Returns the number of pixels that differ from the
// image stored before.
async function changedSinceLastLook() {
  return page.evaluate(() => {
    const canvas = document.querySelector(".drawn-view");
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const before = window.testImage ?? data;
    window.testImage = data;
    if (before.length !== data.length) return 0;
    let changed = 0;
    for (let i = 0; i < data.length; i += 4) changed += Number([0, 1, 2].some((k) => Math.abs(data[i + k] - before[i + k]) > 40));
    return changed;
  });
}

// Whether a pixel near this place of the page is blue, like the arrow along z.
async function isBlueAt({ x, y }) {
  return page.evaluate(
    ([x, y]) => {
      const canvas = document.querySelector(".drawn-view");
      const { left, top } = canvas.getBoundingClientRect();
      const { data } = canvas.getContext("2d").getImageData(Math.round(x - left) - 5, Math.round(y - top) - 5, 11, 11);
      for (let i = 0; i < data.length; i += 4) if (data[i + 2] > 100 && data[i + 2] > 1.5 * data[i] && data[i + 2] > 1.5 * data[i + 1]) return true;
      return false;
    },
    [x, y],
  );
}

test("overlays and the handles of editing are painted above the image, and a handle is dragged", async () => {
  await page.getByRole("button", { name: "Edit", exact: true }).click();
  await page.getByRole("region", { name: "Edit" }).waitFor();
  await page.keyboard.press("r");
  await page.getByRole("button", { name: "Shape", exact: true }).click();
  await page.getByRole("button", { name: "Add shape", exact: true }).click();
  await page.waitForFunction(() => window.gsv.chosen[0]?.startsWith("box") && window.gsv.gizmoHandle("x") !== null);
  const poseOf = async () => {
    const { bodies } = await ask(page, "/scene");
    const name = await page.evaluate(() => window.gsv.chosen[0]);
    return bodies.find((each) => each.name === name).pose;
  };
  const before = await poseOf();
  const places = () => page.evaluate(() => [window.gsv.gizmoHandle("z"), window.gsv.robotScreenPosition(window.gsv.chosen[0])]);
  await until(async () => {
    const then = JSON.stringify(await places());
    await setTimeout(200);
    return then === JSON.stringify(await places());
  }, "a view at rest");
  const [from] = await places();
  await until(() => isBlueAt(from), "the arrow along z");
  await changedSinceLastLook();
  await page.keyboard.press("9");
  await until(async () => (await changedSinceLastLook()) > 50, "collision shapes");
  await page.keyboard.press("9");
  await until(async () => (await changedSinceLastLook()) > 50, "the image without them");
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x, from.y - 40, { steps: 5 });
  await page.mouse.up();
  await until(async () => (await poseOf())[2] - before[2] > 0.1, "the raised box");
  const now = await poseOf();
  assert.ok(Math.abs(now[0] - before[0]) < 1e-6 && Math.abs(now[1] - before[1]) < 1e-6, "along z only");
});

test("while nothing changes no image is drawn, and a turn of the view brings one", async () => {
  await page.keyboard.press("Escape");
  await settled(page); // the simulation is paused for editing
  const then = await page.evaluate(() => window.gsv.frames);
  for (let i = 0; i < 10; i++) await ask(page, "");
  assert.equal(await page.evaluate(() => window.gsv.frames), then);
  const { sum } = await lookAtImage();
  await page.keyboard.press("t");
  await until(async () => (await lookAtImage()).sum !== sum, "the view from above");
});

test("the server pushes the images, and there were no errors", () => {
  assert.deepEqual(requested, []);
  assert.deepEqual(faults, []);
});

test("with WebGL the user chooses whether the browser or the server draws", async () => {
  const other = await openBrowser({ width: 800, height: 560, pixelRatio: 2 });
  try {
    const { page: drawn } = await openPage(other, `${server.url}?view=server`);
    await waitUntilDrawn(drawn);
    // The image has as many pixels as the screen, and fills the view.
    await drawn.waitForFunction(() => {
      const canvas = document.querySelector(".drawn-view");
      const [view, box] = [document.querySelector(".view").getBoundingClientRect(), canvas.getBoundingClientRect()];
      return ["width", "height"].every((side) => Math.abs(canvas[side] - 2 * view[side]) <= 2 && Math.abs(box[side] - view[side]) <= 1);
    });
    const choice = drawn.getByTestId("drawer");
    assert.equal(await choice.textContent(), "drawn by the server");
    await choice.click();
    await drawn.waitForFunction(() => document.querySelector(".drawn-view") === null);
    assert.equal(await choice.textContent(), "drawn by the browser");
    await choice.click();
    await drawn.locator(".drawn-view").waitFor();
  } finally {
    await other.close();
  }
});

test("a browser whose WebGL is slow changes to the server's images by itself, and says so", async () => {
  const other = await openBrowser({ width: 1024, height: 680, drawer: null });
  try {
    // Four frames per second, as on a slow machine.
    await other.context.addInitScript(() => {
      window.requestAnimationFrame = (act) => window.setTimeout(() => act(performance.now()), 250);
      window.cancelAnimationFrame = (id) => window.clearTimeout(id);
    });
    const moving = await startServer(SIMULATION);
    const { page: slow } = await openPage(other, moving.url);
    await slow.getByText("This browser draws fewer than 10 images per second, so the server draws the view now.").waitFor();
    await slow.getByTestId("drawer").getByText("drawn by the server").waitFor();
    await slow.locator(".drawn-view").waitFor();
    await moving.stop();
  } finally {
    await other.close();
  }
});

test("another page shows the stream /view.mjpeg and the image /view.jpg", async () => {
  const moving = await startServer(SIMULATION);
  const dashboard = await browser.context.newPage();
  try {
    await dashboard.setContent(`<img src="${moving.url}view.mjpeg?size=640x360&follow=pebble"><img src="${moving.url}view.jpg?size=320x180">`);
    await dashboard.waitForFunction(() => [...document.images].every(({ naturalWidth }) => naturalWidth > 0));
    const sizes = await dashboard.evaluate(() => [...document.images].map(({ naturalWidth, naturalHeight }) => [naturalWidth, naturalHeight]));
    assert.deepEqual(sizes, [[640, 360], [320, 180]]);
    const look = async (i) => picture(dashboard, await dashboard.locator("img").nth(i).boundingBox());
    assert.equal(isBlank(await look(1)), false);
    const first = await look(0);
    assert.equal(isBlank(first), false);
    await until(async () => changedPixels(first, await look(0)) > 100, "another image of the stream");
  } finally {
    await dashboard.close();
    await moving.stop();
  }
});
