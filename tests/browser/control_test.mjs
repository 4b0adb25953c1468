// Tests several viewers of one simulation: their names, control and requests for it, and a server
// that requires tokens.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { keepPicture } from "./documentation.mjs";
import { startServer } from "./server.mjs";
import { ask, phaseIs, until } from "./viewing.mjs";

const RUN = ["playground", "--robot", "pebble@0,-1.5", "--behaviour", "wander"];
const CONTROL = "control-0123456789abcdef";
const MARKUP = '<img src=x onerror="document.title=1">';

let server;
const browsers = [];
let ada;
let bob;

async function person(name) {
  const browser = await openBrowser({ width: 1100, height: 680 });
  browsers.push(browser);
  const { page, faults } = await openPage(browser, server.url);
  await waitUntilDrawn(page);
  await page.getByRole("button", { name: "Viewers" }).click();
  await page.getByLabel("Your name").fill(name);
  await page.getByLabel("Your name").press("Enter");
  return { page, faults };
}

before(async () => {
  server = await startServer(RUN);
  ada = await person("Ada");
  bob = await person(MARKUP);
});

after(async () => {
  for (const browser of browsers) await browser.close();
  await server?.stop();
});

test("each viewer sees the other's name literally", async () => {
  await ada.page.getByRole("listitem").filter({ hasText: MARKUP }).waitFor();
  await bob.page.getByRole("listitem").filter({ hasText: "Ada" }).waitFor();
  assert.equal(await ada.page.locator(".people img").count(), 0);
});

test("only the holder of control can act; a request is shown to the holder and granted", async () => {
  await ada.page.getByRole("button", { name: "Take control" }).click();
  const pause = bob.page.getByRole("button", { name: "Pause" });
  await until(() => pause.isDisabled(), "the button's rest");
  const status = await bob.page.evaluate(async () => (await fetch("api/simulations/simulation/pause", { method: "POST", body: "{}" })).status);
  assert.equal(status, 409);
  await bob.page.getByLabel("Your name").fill("Bob");
  await bob.page.getByLabel("Your name").press("Enter");
  await bob.page.getByRole("button", { name: "Ask for control" }).click();
  const question = ada.page.getByRole("alert").filter({ hasText: "Bob asks for control" });
  await question.waitFor();
  await keepPicture(ada.page, "control");
  await question.getByRole("button", { name: "Give control" }).click();
  await bob.page.getByRole("button", { name: "Release control" }).waitFor();
  await pause.click();
  await phaseIs(ada.page, "paused");
});

test("control passes to the requesting viewer when the holder leaves", async () => {
  await ada.page.getByRole("button", { name: "Viewers" }).click(); // the menu was closed by the answer
  await ada.page.getByRole("button", { name: "Ask for control" }).click();
  await bob.page.getByRole("alert").filter({ hasText: "Ada asks for control" }).waitFor();
  await bob.page.close();
  await ada.page.getByRole("button", { name: "Release control" }).waitFor();
  await ada.page.getByRole("button", { name: "Release control" }).click();
});

test("two viewers control two simulations of a server", async () => {
  bob = await openPage(browsers[1], server.url);
  await waitUntilDrawn(bob.page);
  const created = await bob.page.evaluate(async () => {
    const body = JSON.stringify({ name: "second", world: "office", robots: [] });
    const headers = { "content-type": "application/json" };
    return (await fetch("api/simulations", { method: "POST", headers, body })).status;
  });
  assert.equal(created, 201);
  await bob.page.goto(`${server.url}?simulation=second`);
  await waitUntilDrawn(bob.page);
  await ada.page.getByRole("button", { name: "Take control" }).click();
  await bob.page.getByRole("button", { name: "Viewers" }).click();
  await bob.page.getByRole("listitem").filter({ hasText: "Ada · at simulation · has control" }).waitFor();
  await bob.page.getByRole("button", { name: "Take control" }).click();
  await bob.page.getByRole("button", { name: "Release control" }).waitFor();
  await ada.page.getByRole("listitem").filter({ hasText: "Bob · at second · has control" }).waitFor();
  const act = (page, simulation, action) =>
    page.evaluate(
      async ([simulation, action]) =>
        (await fetch(`api/simulations/${simulation}/${action}`, { method: "POST", body: "{}" })).status,
      [simulation, action],
    );
  // Requests without the page have no key, so the server refuses them while a viewer has control.
  for (const simulation of ["simulation", "second"]) assert.equal(await act(ada.page, simulation, "reset"), 409);
  await bob.page.getByRole("button", { name: "Start" }).click();
  await phaseIs(bob.page, "running");
  await ada.page.getByRole("button", { name: "Release control" }).click();
});

test("after simultaneous clicks of two viewers, both pages show the server's state", async () => {
  await bob.page.close();
  bob = await openPage(browsers[1], server.url);
  await waitUntilDrawn(bob.page);
  await ada.page.keyboard.press("Escape");
  const actions = ["start", "pause", "resume", "step", "stop", "reset"];
  const press = (page, from) =>
    page.evaluate(
      async ([actions, from]) => {
        const statuses = [];
        for (let i = 0; i < 60; ++i) {
          const action = actions[(i * from) % actions.length];
          const answer = await fetch(`api/simulations/simulation/${action}`, { method: "POST", body: "{}" });
          statuses.push(answer.status);
          for (const button of document.querySelectorAll(".toolbar-transport button:enabled")) {
            if (i % 10 === 9 && !["Edit", "Record"].includes(button.getAttribute("aria-label"))) button.click();
          }
        }
        return statuses;
      },
      [actions, from],
    );
  const answers = (await Promise.all([press(ada.page, 5), press(bob.page, 7)])).flat();
  assert.deepEqual(answers.filter((status) => status !== 200 && status !== 409), []);
  await until(async () => {
    const { phase } = await ask(ada.page, "");
    const shown = await Promise.all([ada, bob].map(({ page }) => page.evaluate(() => window.gsv.phase)));
    return shown.every((each) => each === phase);
  }, "one phase everywhere");
  for (const { faults } of [ada, bob]) assert.deepEqual(faults.filter((fault) => !/status of 409/.test(fault)), []);
});

test("a server with a control token allows watching, and acting with the token in the address", async () => {
  await server.stop();
  server = await startServer([...RUN, "--control-token", CONTROL]);
  const { page } = await openPage(browsers[0], server.url);
  await waitUntilDrawn(page);
  await page.getByRole("button", { name: "Pause" }).click();
  await page.getByText("this request requires a token").waitFor();
  await page.goto("about:blank");
  await page.goto(`${server.url}#token=${CONTROL}`);
  await waitUntilDrawn(page);
  assert.ok(!page.url().includes(CONTROL));
  await page.getByRole("button", { name: "Pause" }).click();
  await phaseIs(page, "paused");
});

test("a server with a watch token makes the page ask for it", async () => {
  await server.stop();
  server = await startServer([...RUN, "--control-token", CONTROL, "--watch-token", "watching-0123456789abcdef"]);
  const { page } = await openPage(browsers[1], server.url);
  await page.getByText("This server requires a token").waitFor();
  await page.getByLabel("Token").fill("not the right one");
  await page.getByRole("button", { name: "Enter" }).click();
  await page.getByText("this token is wrong").waitFor();
  await page.getByLabel("Token").fill(CONTROL);
  await page.getByRole("button", { name: "Enter" }).click();
  await waitUntilDrawn(page);
  await page.getByRole("button", { name: "Pause" }).click();
  await phaseIs(page, "paused");
});

test("the pages of instances, recordings and the broker ask for the token too", async () => {
  for (const [name, ready] of [
    ["join.html", ".instance .joinable"],
    ["recordings.html", ".recording, .frame-list .hint"],
    ["broker.html", ".offer, .summary"],
  ]) {
    const { page } = await openPage(browsers[1], `${server.url}${name}`); // a new tab has no token
    await page.getByRole("alert").filter({ hasText: "requires a token" }).waitFor();
    await page.getByLabel("Token").fill(CONTROL);
    await page.getByRole("button", { name: "Enter" }).click();
    await page.locator(ready).first().waitFor();
    assert.equal(await page.getByLabel("Token").isVisible(), false);
    await page.close();
  }
});
