// Many robots on a floor of their own, and how long a click takes until its answer is on the screen.
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

// What `gsv run` takes for so many robots that wander, in a square; the world's file is in `folder`.
export function crowd(folder, robots) {
  const world = path.join(folder, "floor.sdf");
  fs.writeFileSync(world, FLOOR);
  const side = Math.ceil(Math.sqrt(robots));
  const place = (i) => ((i - (side - 1) / 2) * BETWEEN_M).toFixed(1);
  const all = Array.from({ length: robots }, (_, i) => `pebble@${place(i % side)},${place(Math.floor(i / side))}`);
  return [world, ...all.flatMap((robot) => ["--robot", robot]), "--behaviour", "wander", "--in-process"];
}

// From now on the page notes for each press how long it took until a robot was shown as selected, in
// the list and the inspector, and that picture was drawn; and how many rows of the list were written
// anew for it. `robot` is null where a press missed them all, and so none is selected any more.
export async function noteClicks(page) {
  // Rows stay where they are: the worst come first otherwise, and a row moves when a state changes.
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
      // After the next frame: what was changed now is painted.
      requestAnimationFrame(() =>
        setTimeout(() => {
          const inspected = document.querySelector("section.inspector h2")?.textContent ?? "";
          noted.push({ robot: chosen, inspected, rows, took: performance.now() - from });
        }),
      );
    }).observe(document.querySelector("nav.sidebar"), { attributeFilter: ["aria-pressed"], subtree: true });
  });
}

// Does `click`, and gives what the page noted of it.
export async function clickNoted(page, click) {
  const count = await page.evaluate(() => window.testClicks.length);
  await click();
  await page.waitForFunction((before) => window.testClicks.length > before, count);
  return page.evaluate(() => window.testClicks.at(-1));
}

// How many rows of the list are written while the robots move, until the distances of some have changed
// `times` times.
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

// How long each of `count` clicks took, in ms: by turns on robots in the list and in the picture. Left
// out are those that something else hides in the picture, and those that had moved away when the click
// came.
export async function timeClicks(page, count) {
  const [list, picture] = [[], []];
  for (let i = 0; i < count; i++) {
    list.push(await clickInList(page, i / count));
    const other = await unselectedAt(page, (i + 0.5) / count);
    const place = await page.evaluate((name) => window.gsv.robotScreenPosition(name), other);
    const isFree = place && (await page.evaluate(({ x, y }) => document.elementFromPoint(x, y)?.tagName === "CANVAS", place));
    if (!isFree) continue;
    const { robot, took } = await clickNoted(page, () => page.mouse.click(place.x, place.y));
    if (robot !== null) picture.push(took);
  }
  return { list, picture };
}

// The robot's row: the list is scrolled until it exists, as only those in sight do.
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

// The robot at this share of the list, or the one behind it: a click on who is selected changes nothing.
export async function unselectedAt(page, share) {
  const names = await page.evaluate(() => window.gsv.robots);
  const selected = await page.evaluate(() => document.querySelector('[data-robot][aria-pressed="true"]')?.dataset.robot);
  const at = Math.floor(share * names.length);
  return names[at] === selected ? names[(at + 1) % names.length] : names[at];
}
