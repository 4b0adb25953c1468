// Tests how the page handles faults of others: a message that cannot be decoded, a topic that ends,
// a layout of another version, a server that is unreachable for a while. The page shows a sentence
// about each fault, and continues. Other tests cover other faults: WebGL that is lost
// (viewer_test), slow connections (slow_link_test), two viewers who drive one robot and a gamepad
// that is disconnected (driving_test).
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { startServer } from "./server.mjs";
import { until } from "./viewing.mjs";

let server;
let browser;
let page;
let faults;

before(async () => {
  server = await startServer(["playground", "--robot", "pebble@0,-1.5", "--robot", "pebble@2,-3", "--behaviour", "wander", "--in-process"]);
  browser = await openBrowser({ width: 1366, height: 768 });
  await browser.context.addInitScript(truncateMessages);
  ({ page, faults } = await openPage(browser, server.url));
  await waitUntilDrawn(page);
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

// Cuts off the content of the next messages on a topic, as often as window.testCut.times says.
function truncateMessages() {
  window.testCut = { topic: "", times: 0 };
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
        const isMeant = view.getUint8(0) === 1 && subscribed.get(view.getUint32(1, true)) === window.testCut.topic;
        if (!isMeant || window.testCut.times === 0) return take(event);
        window.testCut.times -= 1;
        return take(new MessageEvent("message", { data: event.data.slice(0, 17) }));
      }));
    },
  });
}

const press = (name) => page.getByRole("button", { name, exact: true }).click();
const panel = (name) => page.getByRole("region", { name, exact: true });

async function timeGoesOn() {
  const then = await page.evaluate(() => window.gsv.time);
  await page.waitForFunction((time) => window.gsv.time > time, then);
}

test("a message that cannot be decoded is reported once, and the later ones are shown", async () => {
  await page.evaluate(() => (window.testCut = { topic: "/gsv/status", times: 3 }));
  await page.waitForFunction(() => window.testCut.times === 0);
  const sentence = page.getByText(/^A message on \/gsv\/status cannot be read: /);
  await sentence.first().waitFor();
  assert.equal(await sentence.count(), 1);
  await timeGoesOn();
  await press("Status");
  await panel("Status").locator("tbody tr").first().waitFor();
});

test("a topic that ends keeps its last message, and the panel says that it ended", async () => {
  const robots = await page.evaluate(() => window.gsv.robots);
  await press("Topics");
  const topics = panel("Topics");
  await page.getByLabel("Text in topic or type").fill(`/${robots[1]}/`);
  await topics.locator(`[data-topic^="/${robots[1]}/"]`).first().click();
  await topics.locator(".tree-line").first().waitFor();
  const [{ name }] = await (await fetch(`${server.url}api/simulations`)).json();
  const removed = await fetch(`${server.url}api/simulations/${name}/robots/${robots[1]}`, { method: "DELETE" });
  assert.equal(removed.status, 200);
  await topics.getByText("The server does not offer this topic any more. The last message stays.").waitFor();
  assert.ok((await topics.locator(".tree-line").count()) > 0, "the last message");
  await until(async () => !(await page.evaluate(() => window.gsv.robots)).includes(robots[1]), "the list without the robot");
  await timeGoesOn();
});

test("layout files of another version and broken ones are refused with the reason, and the layout stays", async () => {
  const file = path.join(browser.profile, "newer.json");
  await press("Layout");
  for (const [content, sentence] of [
    ['{"gsv_layout": 2, "layout": "view"}', "newer.json is no layout: it has version 2; this page reads version 1."],
    ["{", /^newer\.json is no layout: /],
  ]) {
    fs.writeFileSync(file, content);
    await page.getByLabel("Layout file").setInputFiles(file);
    await page.getByText(sentence).first().waitFor();
  }
  await panel("Topics").waitFor();
  await timeGoesOn();
});

for (const [what, layout, sentence] of [
  ["that is broken", "r(view", /^The last layout of this browser cannot be shown: .* The page shows the standard layout\.$/],
  ["of another version", "r(view~700,radar~300)", "The last layout of this browser is from another version of GSV. It has panels that this page does not know and leaves out: radar."],
]) {
  test(`a layout ${what}, which the browser kept, is reported, and the page works`, async () => {
    await page.evaluate((text) => addEventListener("pagehide", () => localStorage.setItem("gsv.layout", text)), layout);
    await page.reload();
    await page.getByText(sentence).waitFor(); // the page shows it for some seconds only
    await waitUntilDrawn(page);
    await timeGoesOn();
  });
}

test("a server that is gone and comes back is reported, and the page continues", async () => {
  await server.restart();
  await page.getByText("Connected again.").waitFor();
  await timeGoesOn();
});

test("there were no errors but lost connections", () => {
  const expected = /ERR_CONNECTION|WebSocket connection|Failed to (load|fetch)/;
  assert.deepEqual(faults.filter((fault) => !expected.test(fault)), []);
});
