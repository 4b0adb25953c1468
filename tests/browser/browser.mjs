// Starts Debian's headless Chromium with software rendering, as for users without a graphics card:
// SwiftShader only renders WebGL, and the processor composes the page. Each browser has its own
// profile.
import fs from "node:fs";
import { createRequire } from "node:module";
import os from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
// The tests use the packages of the viewer.
export const requireFromWeb = createRequire(path.resolve(here, "../../web/package.json"));
const { chromium } = requireFromWeb("playwright-core");

const EXECUTABLE = process.env.GSV_CHROMIUM ?? "/usr/bin/chromium";
const ARGUMENTS = [
  "--no-sandbox",
  "--disable-gpu",
  "--enable-unsafe-swiftshader",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];
const ACTION_TIMEOUT_MS = 60_000; // two browsers may share two busy cores

// Opens a browser on `profile`, a folder; close() ends the browser and removes the folder. `drawer`
// selects what draws the view: "browser", "server", or null for the page's own choice. Without
// `webgl`, the browser behaves like Chrome on a machine without a graphics card. With `touch`, it
// behaves like the browser of a phone. `pixelRatio` is the number of pixels for a CSS pixel.
export async function openBrowser({
  width = 1280,
  height = 800,
  colorScheme = "light",
  drawer = "browser",
  webgl = true,
  touch = false,
  pixelRatio = 1,
} = {}) {
  const profile = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-browser-"));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: EXECUTABLE,
    headless: true,
    args: webgl ? ARGUMENTS : [...ARGUMENTS.filter((each) => !each.includes("swiftshader")), "--disable-3d-apis"],
    viewport: { width, height },
    colorScheme,
    hasTouch: touch,
    isMobile: touch,
    deviceScaleFactor: pixelRatio,
    reducedMotion: "reduce",
  });
  context.setDefaultTimeout(ACTION_TIMEOUT_MS);
  if (drawer !== null) {
    await context.addInitScript((value) => {
      if (location.protocol.startsWith("http")) localStorage.setItem("gsv.drawer", value);
    }, drawer);
  }
  return {
    context,
    profile,
    async close() {
      await context.close();
      fs.rmSync(profile, { recursive: true, force: true });
    },
  };
}

// Opens a page of the viewer. `faults` collects requests to other hosts and script errors.
export async function openPage(browser, url) {
  const page = await browser.context.newPage();
  const faults = [];
  const { origin } = new URL(url);
  page.on("pageerror", (error) => faults.push(`script error: ${error.message}`));
  page.on("console", (message) => {
    if (message.type() === "error") faults.push(`console: ${message.text()} (${message.location().url})`);
  });
  page.on("request", (request) => {
    const asked = request.url();
    if (/^(blob|data):/.test(asked) || new URL(asked).origin === origin) return;
    faults.push(`request to another host: ${asked}`);
  });
  await page.goto(url);
  return { page, faults };
}

// Waits until the first scene is drawn with all its shapes.
export async function waitUntilDrawn(page, timeoutMs = 60_000) {
  await page.waitForFunction(() => window.gsv !== undefined);
  await withTimeout(
    page.evaluate(() => window.gsv.ready),
    timeoutMs,
    "the page's first picture",
  );
}

export async function withTimeout(promise, timeoutMs, what) {
  let timer;
  const late = new Promise((_, reject) => {
    timer = setTimeout(() => reject(new Error(`${what}: nothing within ${timeoutMs / 1000} s`)), timeoutMs);
  });
  try {
    return await Promise.race([promise, late]);
  } finally {
    clearTimeout(timer);
  }
}
