// Tests the images panel: all cameras at once, one camera in full size with zoom, and the values of
// a depth image.
import assert from "node:assert/strict";
import path from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { judge } from "./axe.mjs";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { startServer } from "./server.mjs";
import { until } from "./viewing.mjs";

const SURVEYOR = path.join(path.dirname(fileURLToPath(import.meta.url)), "models", "surveyor.sdf");

let server;
let browser;
let page;
let faults;

before(async () => {
  const robots = ["--robot", `${SURVEYOR}@3.2,0`, "--robot", `${SURVEYOR}@0,2`, "--robot", `${SURVEYOR}@0,-2`];
  server = await startServer(["playground", ...robots]);
  browser = await openBrowser({ width: 1366, height: 768 });
  await browser.context.addInitScript(holdMessages);
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
});

// Drops the messages of the topic window.testHeld, like a camera that has stopped.
function holdMessages() {
  window.testHeld = "";
  const channels = new Map(); // topics by channel
  const subscribed = new Map(); // topics by subscription
  const send = WebSocket.prototype.send;
  WebSocket.prototype.send = function (data) {
    const message = typeof data === "string" ? JSON.parse(data) : {};
    if (message.op === "subscribe") for (const { id, channelId } of message.subscriptions) subscribed.set(id, channels.get(channelId));
    return send.call(this, data);
  };
  const handler = Object.getOwnPropertyDescriptor(WebSocket.prototype, "onmessage");
  Object.defineProperty(WebSocket.prototype, "onmessage", {
    ...handler,
    set(take) {
      handler.set.call(this, take && ((event) => {
        if (typeof event.data === "string") {
          const message = JSON.parse(event.data);
          if (message.op === "advertise") for (const { id, topic } of message.channels) channels.set(id, topic);
          return take(event);
        }
        const view = new DataView(event.data);
        const topic = view.getUint8(0) === 1 ? subscribed.get(view.getUint32(1, true)) : undefined;
        if (topic === undefined || topic !== window.testHeld) take(event);
      }));
    },
  });
}

after(async () => {
  await browser?.close();
  await server?.stop();
});

const press = (name) => page.getByRole("button", { name, exact: true }).click();
const panel = () => page.getByRole("region", { name: "Images", exact: true });
const camera = () => panel().getByRole("combobox", { name: "Camera" });

// Returns the number of different colours of each canvas. It is one while no image has arrived.
const colours = () =>
  panel()
    .locator("canvas")
    .evaluateAll((canvases) =>
      canvases.map((canvas) => {
        const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        const found = new Set();
        for (let i = 0; i < data.length; i += 4) found.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
        return found.size;
      }),
    );

test("three cameras are seen at once, by a button in the panel", async () => {
  await press("Show all cameras");
  await until(async () => (await camera().locator("option:checked").textContent()) === "All cameras (6)", "all cameras");
  await until(async () => {
    const found = await colours();
    return found.length === 6 && found.every((number) => number > 5);
  }, "six images");
  const boxes = await panel().locator("canvas").evaluateAll((all) => all.map((each) => each.getBoundingClientRect()).map(({ x, y, width, height }) => [x, y, width, height]));
  assert.equal(new Set(boxes.map(([x, y]) => `${x} ${y}`)).size, 6, "each has its own place");
  // The images fill the panel in rows and columns.
  assert.deepEqual([new Set(boxes.map(([x]) => Math.round(x))).size, new Set(boxes.map(([, y]) => Math.round(y))).size], [3, 2]);
  assert.ok(boxes.every(([, , width, height]) => width > 100 && height > 70), JSON.stringify(boxes));
});

test("one camera is shown at the former size, and the palette shows all again", async () => {
  const width = async () => (await panel().boundingBox()).width;
  const large = await width();
  await press("Show one camera");
  await until(async () => (await width()) < large / 2 && (await panel().locator("canvas").count()) === 1, "the former size");
  await page.keyboard.press("Control+k");
  await page.getByRole("combobox", { name: "Command, robot, topic or panel" }).fill("cameras");
  await page.getByRole("option", { name: /Show all cameras/ }).waitFor();
  await page.keyboard.press("Enter");
  await until(async () => (await panel().locator("canvas").count()) === 6, "all cameras again");
});

test("a click on one shows it alone, and it is zoomed", async () => {
  await panel().getByRole("button", { name: /^surveyor_2 · camera$/ }).first().click();
  await until(async () => (await panel().locator("canvas").count()) === 1 && (await colours())[0] > 5, "one image");
  const size = async () => (await panel().locator("canvas").boundingBox()).width;
  const then = await size();
  await press("Zoom in");
  assert.ok(Math.abs((await size()) / then - 1.25) < 0.02);
  await press("Fit the image");
  assert.ok(Math.abs((await size()) - then) < 2);
});

test("a depth image has a scale, and the value under the pointer", async () => {
  const depth = await camera().locator("option").evaluateAll((all) => all.find(({ text }) => text.endsWith("· depth")).value);
  await camera().selectOption(depth);
  await panel().locator(".picture-scale").waitFor();
  const [least, largest] = (await panel().locator(".picture-scale .number").allTextContents()).map(parseFloat);
  assert.ok(least > 0 && largest > least, `from ${least} to ${largest}`);
  const box = await panel().locator("canvas").boundingBox();
  // The lower part of the image shows the floor, which is in the range of every depth camera here.
  await page.mouse.move(box.x + box.width / 2, box.y + box.height * 0.8);
  const value = panel().locator(".picture-value");
  await until(async () => /\(\d+, \d+\): [\d.]+ m/.test(await value.textContent()), "a depth");
  const metres = Number(/: ([\d.]+) m/.exec(await value.textContent())[1]);
  assert.ok(metres >= least - 0.01 && metres <= largest + 0.01, `${metres} lies between ${least} and ${largest}`);
});

test("an image that is behind the simulation shows its age", async () => {
  await camera().selectOption({ label: "surveyor · camera" });
  const caption = panel().locator(".picture-time");
  await until(async () => /^\d+:\d\d\.\d\d$/.test(await caption.textContent()), "an image of now");
  await page.evaluate(() => (window.testHeld = "/surveyor/camera"));
  await until(async () => /^\d+:\d\d\.\d\d · \d+\.\d s old$/.test(await caption.textContent()), "the age");
  await page.evaluate(() => (window.testHeld = ""));
  await until(async () => /^\d+:\d\d\.\d\d$/.test(await caption.textContent()), "a new image");
});

test("on a phone, a depth image with its scale and all cameras have no accessibility problems", async () => {
  await page.setViewportSize({ width: 390, height: 780 });
  await page.getByRole("tab", { name: "Images", exact: true }).click();
  const depth = await camera().locator("option").evaluateAll((all) => all.find(({ text }) => text.endsWith("· depth")).value);
  await camera().selectOption(depth);
  await panel().locator(".picture-scale").waitFor();
  await judge(page);
  await press("Show all cameras");
  await until(async () => (await panel().locator("canvas").count()) === 6 && (await colours()).some((number) => number > 5), "the grid");
  await judge(page);
});

test("no other host was contacted and there were no errors", () => {
  assert.deepEqual(faults, []);
});
