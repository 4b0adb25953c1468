// Starts a crowd of robots, and measures how long the page takes to show the result of a click.
import fs from "node:fs";
import path from "node:path";

const BETWEEN_M = 1;
const FLOOR = `<?xml version="1.0"?>
<sdf version="1.9">
  <world name="floor">
    <light type="directional" name="sun"><direction>-0.4 0.3 -1</direction><diffuse>0.9 0.9 0.9 1</diffuse></light>
    <model name="floor">
      <static>true</static>
      <link name="link">
        <collision name="collision"><geometry><plane><normal>0 0 1</normal><size>60 60</size></plane></geometry></collision>
        <visual name="visual">
          <geometry><plane><normal>0 0 1</normal><size>60 60</size></plane></geometry>
          <material><diffuse>0.6 0.6 0.58 1</diffuse></material>
        </visual>
      </link>
    </model>
  </world>
</sdf>
`;

// Returns the arguments of `gsv run` for this number of wandering robots on a square. Writes the
// world file to `folder`.
export function crowd(folder, robots) {
  const world = path.join(folder, "floor.sdf");
  fs.writeFileSync(world, FLOOR);
  const side = Math.ceil(Math.sqrt(robots));
  const place = (i) => ((i - (side - 1) / 2) * BETWEEN_M).toFixed(1);
  const all = Array.from({ length: robots }, (_, i) => `pebble@${place(i % side)},${place(Math.floor(i / side))}`);
  return [world, ...all.flatMap((robot) => ["--robot", robot]), "--behaviour", "wander", "--in-process"];
}

// Makes the page store a record of each press. `took` is the time in ms until the list and the
// inspector showed the selected robot, and the browser had drawn this state. `rows` is the number of
// rows of the list that were rewritten. `robot` is null if the press missed all robots, so that no
// robot is selected any more.
export async function noteClicks(page) {
  // Keeps the order of rows fixed. Otherwise the worst robots come first, and a row moves when a
  // state changes.
  await page.getByRole("combobox", { name: "Order" }).selectOption("name");
  await page.evaluate(() => {
    const noted = (window.testClicks = []);
    let pressed = null;
    addEventListener("pointerup", ({ timeStamp }) => (pressed = timeStamp), { capture: true });
    new MutationObserver((changes) => {
      const chosen = changes.find(({ target }) => target.ariaPressed === "true")?.target.dataset.robot ?? null;
      if (pressed === null) return;
      const from = pressed;
      pressed = null;
      const rows = new Set(changes.map(({ target }) => target)).size;
      // Resolves after the next frame, when the present changes are painted.
      requestAnimationFrame(() =>
        setTimeout(() => {
          const inspected = document.querySelector("section.inspector h2")?.textContent ?? "";
          noted.push({ robot: chosen, inspected, rows, took: performance.now() - from });
        }),
      );
    }).observe(document.querySelector("nav.sidebar"), { attributeFilter: ["aria-pressed"], subtree: true });
  });
}

// Performs `click`, and returns the page's record of it.
export async function clickNoted(page, click) {
  const count = await page.evaluate(() => window.testClicks.length);
  await click();
  await page.waitForFunction((before) => window.testClicks.length > before, count);
  return page.evaluate(() => window.testClicks.at(-1));
}

// Returns the number of rows that are rewritten while the robots move, until the distances of some
// robots have changed `times` times.
export async function rowsWritten(page, times = 3) {
  return page.evaluate(
    (wanted) =>
      new Promise((resolve) => {
        const rows = new Set();
        let seen = 0;
        const observer = new MutationObserver((changes) => {
          for (const { target } of changes) rows.add((target.closest ? target : target.parentElement)?.closest("li") ?? null);
          rows.delete(null);
          if (++seen < wanted) return;
          observer.disconnect();
          resolve(rows.size);
        });
        const list = document.querySelector("nav.sidebar .robots");
        observer.observe(list, { subtree: true, childList: true, characterData: true, attributes: true });
      }),
    times,
  );
}

// Returns the times of `count` clicks in ms, alternately on robots in the list and in the picture.
// It omits robots that something hides in the picture, and robots that moved away before the click.
export async function timeClicks(page, count) {
  const [list, picture] = [[], []];
  for (let i = 0; i < count; i++) {
    list.push(await clickInList(page, i / count));
    const other = await unselectedAt(page, (i + 0.5) / count);
    const place = (await freePlaces(page)).find(({ name }) => name === other);
    if (!place) continue;
    const { robot, took } = await clickNoted(page, () => page.mouse.click(place.x, place.y));
    if (robot !== null) picture.push(took);
  }
  return { list, picture };
}

// Returns the names and the places in the view of the robots that neither labels nor other parts of
// the page cover.
export async function freePlaces(page) {
  return page.evaluate(() => {
    const { labels } = window.gsv;
    const isIn = (box, { x, y }) => x >= box.x && x < box.x + box.width && y >= box.y && y < box.y + box.height;
    const isFree = (at) => document.elementFromPoint(at.x, at.y)?.tagName === "CANVAS" && !labels.some((box) => isIn(box, at));
    return window.gsv.robots.flatMap((name) => {
      const at = window.gsv.robotScreenPosition(name);
      return at && isFree(at) ? [{ name, ...at }] : [];
    });
  });
}

// Returns the robot's row. The list is scrolled until the row exists, because only rows in sight
// exist.
export async function rowOf(page, robot) {
  const isThere = await page.evaluate((name) => {
    const list = document.querySelector(".robot-scroll");
    const row = () => list.querySelector(`[data-robot="${name}"]`);
    for (let top = 0; !row() && top < list.scrollHeight; top += 200) {
      list.scrollTop = top;
      list.dispatchEvent(new Event("scroll"));
    }
    row()?.scrollIntoView({ block: "nearest" });
    return row() !== null;
  }, robot);
  if (!isThere) throw new Error(`${robot} is not in the list`);
  return page.locator(`[data-robot="${robot}"]`);
}

async function clickInList(page, share) {
  const row = await rowOf(page, await unselectedAt(page, share));
  return (await clickNoted(page, () => row.click())).took;
}

// Returns the robot at this fraction of the list. If this robot is selected, returns the next robot,
// because a click on the selected robot changes nothing.
export async function unselectedAt(page, share) {
  const names = await page.evaluate(() => window.gsv.robots);
  const selected = await page.evaluate(() => document.querySelector('[data-robot][aria-pressed="true"]')?.dataset.robot);
  const at = Math.floor(share * names.length);
  return names[at] === selected ? names[(at + 1) % names.length] : names[at];
}
