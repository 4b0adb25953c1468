// Tests the view that the server draws: in a browser without WebGL, and if it is chosen.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { startServer } from "./server.mjs";
import { until } from "./viewing.mjs";

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
  await page.locator(".view").getByText("pebble", { exact: true }).first().waitFor();
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
    const label = [...document.querySelectorAll(".view *")].find((each) => each.children.length === 0 && each.textContent === "pebble");
    const found = [];
    for (let i = 0; i < 20; i++) {
      const [x, y] = [400 + 8 * i, 300];
      for (const type of i === 0 ? ["pointerdown"] : ["pointermove"]) {
        canvas.dispatchEvent(new PointerEvent(type, { pointerId: 1, button: 0, buttons: 1, clientX: x, clientY: y, bubbles: true }));
      }
      const then = window.gsv.frames;
      while (window.gsv.frames === then) await new Promise(requestAnimationFrame);
      const place = window.gsv.robotScreenPosition("pebble");
      const box = label.getBoundingClientRect();
      if (place && box.width > 0) found.push(Math.abs(box.x + box.width / 2 - place.x));
    }
    canvas.dispatchEvent(new PointerEvent("pointerup", { pointerId: 1, button: 0, clientX: 552, clientY: 300, bubbles: true }));
    return found;
  });
  assert.ok(gaps.length > 5, `the name was shown ${gaps.length} times`);
  assert.ok(Math.max(...gaps) < 12, `names were ${Math.max(...gaps)} pixels away`);
});

test("the server pushes the images, and there were no errors", () => {
  assert.deepEqual(requested, []);
  assert.deepEqual(faults, []);
});

test("with WebGL the user chooses whether the browser or the server draws", async () => {
  const other = await openBrowser({ width: 1024, height: 680 });
  try {
    const { page: drawn } = await openPage(other, `${server.url}?view=server`);
    await waitUntilDrawn(drawn);
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
