// Tests that a worker decodes large messages, and that the page does so if there is no worker.
import assert from "node:assert/strict";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { changedPixels, picture } from "./pixels.mjs";
import { startServer } from "./server.mjs";
import { phaseIs, settled, until, viewClip } from "./viewing.mjs";

const SURVEYOR = path.join(path.dirname(fileURLToPath(import.meta.url)), "models", "surveyor.sdf");
const SMALL_IMAGE = "<width>40</width><height>30</height>";
const LARGE_IMAGE = "<width>160</width><height>120</height>";
const TOPIC = "/surveyor/depth";

let folder;
let server;
let browser;
let page;
let faults;

before(async () => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-decoding-"));
  const model = path.join(folder, "surveyor.sdf");
  const text = fs.readFileSync(SURVEYOR, "utf8");
  assert.ok(text.includes(SMALL_IMAGE));
  fs.writeFileSync(model, text.replace(SMALL_IMAGE, LARGE_IMAGE));
  server = await startServer(["playground", "--robot", `${model}@3.2,0`, "--behaviour", "surveyor=cruise"]);
  browser = await openBrowser({ width: 1366, height: 768 });
  await browser.context.addInitScript(watchMessages);
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
  if (folder) fs.rmSync(folder, { recursive: true, force: true });
});

// window.testDecoded counts the answers of workers by form. The next window.testCut messages on
// window.testTopic lose their second half.
function watchMessages() {
  window.testDecoded = { points: 0, image: 0 };
  window.testCut = 0;
  window.testTopic = "";
  const forms = new WeakMap(); // forms by request number, of each worker
  const post = Worker.prototype.postMessage;
  Worker.prototype.postMessage = function (request, ...rest) {
    if (!forms.has(this)) {
      forms.set(this, new Map());
      this.addEventListener("message", ({ data }) => {
        if (data.content !== undefined) window.testDecoded[forms.get(this).get(data.number)] += 1;
      });
    }
    forms.get(this).set(request.number, request.form);
    return post.call(this, request, ...rest);
  };
  const channels = new Map(); // topics by channel
  const subscribed = new Map(); // topics by subscription
  const send = WebSocket.prototype.send;
  WebSocket.prototype.send = function (data) {
    const message = JSON.parse(data);
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
        const isMeant = view.getUint8(0) === 1 && subscribed.get(view.getUint32(1, true)) === window.testTopic;
        if (!isMeant || window.testCut === 0) return take(event);
        window.testCut -= 1;
        return take(new MessageEvent("message", { data: event.data.slice(0, event.data.byteLength / 2) }));
      }));
    },
  });
}

// Adds a Content-Security-Policy to the page.
function forbidWorkers() {
  addEventListener("DOMContentLoaded", () => {
    const policy = document.createElement("meta");
    policy.httpEquiv = "Content-Security-Policy";
    policy.content = "worker-src 'none'";
    document.head.append(policy);
  });
}

const decoders = (of) => of.workers().filter((worker) => /decodeWorker/.test(worker.url()));
const images = (of) => of.getByRole("region", { name: "Images", exact: true });

// Waits until the worker has decoded further messages in this form.
async function decodesMore(of, form) {
  const then = await of.evaluate((each) => window.testDecoded[each], form);
  await of.waitForFunction(([each, count]) => window.testDecoded[each] > count + 1, [form, then]);
}

// Selects the depth camera in the panel, and waits for its image.
async function showDepths(of) {
  const camera = images(of).getByRole("combobox", { name: "Camera" });
  const depth = await camera.locator("option").evaluateAll((all) => all.find(({ text }) => text.endsWith("· depth")).value);
  await camera.selectOption(depth);
  await images(of).locator(".picture-scale").waitFor();
}

async function imageChanges(of) {
  // A late image has its age behind its time.
  const time = async () => /^[\d:.]*/.exec(await images(of).locator(".picture-time").textContent())[0];
  const then = await time();
  await until(async () => (await time()) !== then, "a later image");
}

const isOfScale = (r, g, b) => (g < 60 && r > 60 && b > 50) || (r > 130 && r > 1.3 * b);

// Switches the points off and on while the simulation is paused, and returns the number of pixels
// that have their colours.
async function pointPixels(of) {
  await of.bringToFront();
  await of.locator('[data-robot="surveyor"]').click();
  await of.keyboard.press("c");
  const points = of.locator('.menu-item[aria-keyshortcuts="2"]');
  if ((await points.getAttribute("aria-pressed")) !== "true") await of.keyboard.press("2");
  let drawn = 0;
  await until(async () => {
    await settled(of);
    const shown = await picture(of, await viewClip(of));
    await of.keyboard.press("2");
    await settled(of);
    drawn = changedPixels(await picture(of, await viewClip(of)), shown, isOfScale);
    await of.keyboard.press("2");
    return drawn >= 60;
  }, `60 pixels of points, ${drawn} at last,`);
}

test("a worker decodes the image of a depth camera", async () => {
  await showDepths(page);
  await decodesMore(page, "image");
  await imageChanges(page);
  assert.equal(decoders(page).length, 1);
});

test("a large message that is cut off is reported once, and the later ones are shown", async () => {
  await page.evaluate((topic) => Object.assign(window, { testTopic: topic, testCut: 3 }), TOPIC);
  await page.waitForFunction(() => window.testCut === 0);
  const sentence = page.getByText(new RegExp(`^A message on ${TOPIC} cannot be read: `));
  await sentence.first().waitFor();
  assert.equal(await sentence.count(), 1);
  await decodesMore(page, "image");
  await imageChanges(page);
});

test("the points of the depth camera are drawn from the worker's messages, also after a pause", async () => {
  await page.keyboard.press("2");
  await decodesMore(page, "points");
  await page.getByRole("button", { name: "Pause", exact: true }).click();
  await phaseIs(page, "paused");
  await pointPixels(page);
});

test("a page that may not start workers shows the image and the points of the paused simulation", async () => {
  const other = await openBrowser({ width: 1366, height: 768 });
  try {
    await other.context.addInitScript(watchMessages);
    await other.context.addInitScript(forbidWorkers);
    const { page: blocked, faults: found } = await openPage(other, server.url);
    await waitUntilDrawn(blocked);
    await showDepths(blocked);
    await pointPixels(blocked);
    assert.deepEqual(decoders(blocked), []);
    assert.deepEqual(await blocked.evaluate(() => window.testDecoded), { points: 0, image: 0 });
    assert.deepEqual(found.filter((fault) => !/Content Security Policy/.test(fault)), []);
  } finally {
    await other.close();
  }
});

test("if the worker ends, the page decodes the messages", async () => {
  await page.bringToFront();
  await page.getByRole("button", { name: "Resume", exact: true }).click();
  await decodesMore(page, "image");
  await decoders(page)[0].evaluate(() => close());
  await imageChanges(page); // may show an image that the worker has decoded before its end
  await imageChanges(page);
  const decoded = await page.evaluate(() => window.testDecoded);
  await imageChanges(page);
  assert.deepEqual(await page.evaluate(() => window.testDecoded), decoded);
});

test("no other host was contacted and there were no errors", () => assert.deepEqual(faults, []));
