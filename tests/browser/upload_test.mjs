// Tests worlds from the user's machine: a chosen file, a dropped folder, and files that are not
// worlds.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { keepPicture } from "./documentation.mjs";
import { startServe } from "./server.mjs";
import { until } from "./viewing.mjs";

const WORLD = `<?xml version="1.0"?>
<sdf version="1.9">
  <world name="dropped">
    <light name="sun" type="directional"><direction>-0.5 0.2 -1</direction></light>
    <include><uri>model://cube</uri><pose>0 0 0.5 0 0 0</pose></include>
  </world>
</sdf>`;
const CUBE = `<?xml version="1.0"?>
<sdf version="1.9">
  <model name="cube">
    <static>true</static>
    <link name="link">
      <visual name="visual"><geometry><box><size>1 1 1</size></box></geometry></visual>
      <collision name="collision"><geometry><box><size>1 1 1</size></box></geometry></collision>
    </link>
  </model>
</sdf>`;
const CONFIG = `<?xml version="1.0"?><model><name>cube</name><sdf version="1.9">model.sdf</sdf></model>`;

let server;
let browser;
let page;
let faults;

before(async () => {
  server = await startServe([]);
  browser = await openBrowser({ width: 1100, height: 680 });
  ({ page, faults } = await openPage(browser, server.url));
  await page.getByRole("button", { name: "Create a simulation" }).click();
  await page.locator(".set-up").waitFor();
});

after(async () => {
  await browser?.close();
  await server?.stop();
});

const objection = () => page.locator(".field", { has: page.getByLabel("Environment", { exact: true }) }).locator(".field-error");

// Drops files by their paths. A browser does not allow tests to drop a folder, so the files come
// without entries.
async function drop(files) {
  await page.evaluate((files) => {
    const entry = (name, content) =>
      typeof content === "string"
        ? { name, isFile: true, isDirectory: false, file: (take) => take(new File([content], name)) }
        : {
            name,
            isFile: false,
            isDirectory: true,
            createReader: () => {
              const left = [Object.entries(content).map(([each, inside]) => entry(each, inside)), []];
              return { readEntries: (take) => take(left.shift()) };
            },
          };
    const items = Object.entries(files).map(([name, content]) => ({ webkitGetAsEntry: () => entry(name, content) }));
    const event = new Event("drop", { bubbles: true, cancelable: true });
    Object.defineProperty(event, "dataTransfer", { value: { types: ["Files"], items, files: [] } });
    document.body.dispatchEvent(event);
  }, files);
}

test("a dropped folder with its models is shown and becomes a simulation", async () => {
  await drop({ mine: { "my <b>.world": WORLD, models: { cube: { "model.config": CONFIG, "model.sdf": CUBE } }, ".git": "x" } });
  await page.getByText("World: 1 object").waitFor({ state: "attached" });
  await waitUntilDrawn(page);
  await keepPicture(page, "upload");
  await page.getByRole("button", { name: "Create", exact: true }).click();
  await page.getByRole("button", { name: "Start", exact: true }).waitFor();
  const scene = await page.evaluate(async () => {
    const [{ name }] = await (await fetch("api/simulations")).json();
    return (await fetch(`api/simulations/${encodeURIComponent(name)}/scene`)).json();
  });
  assert.deepEqual(scene.bodies.map(({ name }) => name), ["cube"]);
  assert.deepEqual(faults, []);
});

// The archive was made by Python's zipfile.
function zipped(files) {
  const make = `
import io, json, sys, zipfile
out = io.BytesIO()
with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
    for name, text in json.load(sys.stdin).items(): archive.writestr(name, text)
sys.stdout.buffer.write(out.getvalue())`;
  return execFileSync("python3", ["-c", make], { input: JSON.stringify(files) });
}

const choose = (buffer) =>
  page.getByLabel("World file", { exact: true }).setInputFiles({ name: "lab.zip", mimeType: "application/zip", buffer });

test("a zip archive with a world and its models is unpacked and shown", async () => {
  await page.getByRole("button", { name: "New simulation" }).click();
  await choose(
    zipped({ "lab/room.world": WORLD.replace("0 0 0.5", "2 0 0.5"), "lab/models/cube/model.config": CONFIG, "lab/models/cube/model.sdf": CUBE }),
  );
  await page.getByText("World: 1 object").waitFor({ state: "attached" });
  assert.match(await page.getByLabel("Environment", { exact: true }).inputValue(), /lab\/room\.world$/);
  assert.equal(await objection().textContent(), "");
});

test("another of several worlds in a folder is chosen and shown", async () => {
  const models = { cube: { "model.config": CONFIG, "model.sdf": CUBE } };
  await drop({ two: { "here.world": WORLD, "there.world": WORLD.replace("0 0 0.5", "30 0 0.5"), models } });
  const choice = page.getByLabel("Environment", { exact: true });
  const looksAt = (x) =>
    until(() => page.evaluate((x) => Math.abs(window.gsv.view[3] - x) < 0.01, x), `a view of what stands at x = ${x} m`);
  await choice.locator("option", { hasText: "two/there.world" }).waitFor({ state: "attached" });
  await looksAt(0);
  await choice.selectOption({ label: "two/there.world" });
  await looksAt(30);
  await choice.selectOption({ label: "two/here.world" });
  await looksAt(0);
});

test("a truncated archive, or one with names outside of it, is rejected with a sentence", async () => {
  await choose(zipped({ "room.world": WORLD, "../../evil.sh": "x" }));
  await objection().filter({ hasText: 'lab.zip cannot be used: the name "../../evil.sh" must be a relative path without "..", ":" or backslashes.' }).waitFor();
  await choose(zipped({ "room.world": WORLD }).subarray(0, -5));
  await objection().filter({ hasText: "lab.zip cannot be used: its list of files is missing or damaged" }).waitFor();
  assert.deepEqual(faults, []);
});

test("a file that is not a world shows an error beside the field", async () => {
  await page.getByLabel("World file", { exact: true }).setInputFiles({ name: "holiday.sdf", mimeType: "image/jpeg", buffer: Buffer.from("not XML at all") });
  await until(async () => /holiday\.sdf/.test((await objection().textContent()) ?? ""), "the objection");
  assert.ok(faults.every((fault) => /status of (40\d|422)/.test(fault)), faults.join());
});

test("too large files are rejected by the page, and by the server before the transfer", async () => {
  const status = await page.evaluate(async () => {
    const { upload } = await (await fetch("api/uploads", { method: "POST", body: "{}" })).json();
    const body = new Blob([new Uint8Array(66 * 2 ** 20)]);
    return (await fetch(`api/uploads/${upload}/big.sdf`, { method: "PUT", body }).catch(() => ({ status: 413 }))).status;
  });
  assert.equal(status, 413);
});
