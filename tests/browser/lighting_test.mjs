// Tests how the view lights surfaces, with the quality of a machine with a graphics card: metal
// reflects its surroundings, corners are darker, and shadows near a robot are sharp. Also tests how the
// maps and values of a material change the light.
import assert from "node:assert/strict";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { openBrowser, openPage, waitUntilDrawn } from "./browser.mjs";
import { picture } from "./pixels.mjs";
import { startServer } from "./server.mjs";
import { minus, phaseIs, project, settled, unit, viewClip } from "./viewing.mjs";

const shape = (name, pose, geometry, colour, more = "") => `
  <model name="${name}"><static>true</static><pose>${pose} 0 0 0</pose><link name="link"><visual name="visual">
    <geometry>${geometry}</geometry><material><diffuse>${colour} 1</diffuse>${more}</material>
  </visual></link></model>`;
const box = (size) => `<box><size>${size}</size></box>`;
const METAL = "<pbr><metal><metalness>1</metalness><roughness>0.1</roughness></metal></pbr>";
// Images of one pixel.
const tga = (r, g = r, b = r) => Buffer.from([0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 24, 0, b, g, r]);
const maps = (inside) => `<pbr><metal><metalness>0</metalness><roughness>1</roughness>${inside}</metal></pbr>`;
const NO_AMBIENT = maps("<ambient_occlusion_map>black.tga</ambient_occlusion_map>");
const BAKED = maps("<light_map>white.tga</light_map>");
// Normals that are tilted by 45 degrees: to the left of the surface, up and down.
const TILTED = { level: [128, 128, 255], left: [38, 128, 218], up: [128, 218, 218], down: [128, 38, 218] };
const ROUGHNESS = 0.6;
const BALL = "<sphere><radius>0.5</radius></sphere>";
const ball = (y) => `-10 ${y} 0.5`;
// Materials of metal: the roughness is a value, or a factor for a map.
const metal = (inside) => `<pbr><metal><metalness>1</metalness>${inside}</metal></pbr>`;
const BALLS = { smooth: -6, rough: -7.2, mapped: -8.4 }; // y of the centres
// The sun shines towards negative x, so the sides of the block at x = 0.5 and y = -0.5 have no
// shadow on the ground.
const WORLD = `<?xml version="1.0"?>
<sdf version="1.9"><world name="lighting">
  <light type="directional" name="sun"><cast_shadows>true</cast_shadows><direction>-0.5 0 -1</direction><diffuse>0.5 0.5 0.5 1</diffuse></light>
  ${shape("ground", "0 0 -0.5", box("60 60 1"), "0.6 0.6 0.6")}
  ${shape("block", "0 0 0.5", box("1 1 1"), "0.8 0.8 0.8")}
  ${shape("pole", "3 0 0.1", box("0.02 0.02 0.2"), "0.8 0.8 0.8")}
  ${shape("ball", "0 -3 0.5", BALL, "0.9 0.7 0.3", METAL)}
  ${shape("plain", "-10 1.8 0.5", box("1 1 1"), "0.7 0.7 0.7", maps(""))}
  ${shape("occluded", "-10 3 0.5", box("1 1 1"), "0.7 0.7 0.7", NO_AMBIENT)}
  ${shape("baked", "-10 4.2 0.5", box("1 1 1"), "0.7 0.7 0.7", BAKED)}
  ${Object.keys(TILTED).map((name, i) => shape(name, `-10 ${-1.2 * (i + 1)} 0.5`, box("1 1 1"), "0.7 0.7 0.7", maps(`<normal_map>${name}.tga</normal_map>`))).join("")}
  ${shape("smooth", ball(BALLS.smooth), BALL, "0.8 0.8 0.8", metal("<roughness>0.2</roughness>"))}
  ${shape("rough", ball(BALLS.rough), BALL, "0.8 0.8 0.8", metal(`<roughness>${ROUGHNESS}</roughness>`))}
  ${shape("mapped", ball(BALLS.mapped), BALL, "0.8 0.8 0.8", metal("<roughness>1</roughness><roughness_map>rough.tga</roughness_map>"))}
</world></sdf>`;

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "gsv-lighting-"));
let server;
let browser;

before(async () => {
  const world = path.join(folder, "lighting.sdf");
  fs.writeFileSync(world, WORLD);
  fs.writeFileSync(path.join(folder, "black.tga"), tga(0));
  fs.writeFileSync(path.join(folder, "white.tga"), tga(255));
  fs.writeFileSync(path.join(folder, "rough.tga"), tga(Math.round(255 * ROUGHNESS)));
  for (const [name, colour] of Object.entries(TILTED)) fs.writeFileSync(path.join(folder, `${name}.tga`), tga(...colour));
  server = await startServer([world]);
  browser = await openBrowser({ width: 1100, height: 700 });
  const { page } = await openPage(browser, server.url);
  await waitUntilDrawn(page);
  await page.getByRole("button", { name: "Pause", exact: true }).click();
  await phaseIs(page, "paused");
  await page.close();
});

after(async () => {
  await browser?.close();
  await server?.stop();
  fs.rmSync(folder, { recursive: true, force: true });
});

// Opens a view from `eye` to `target` (metres), and returns a function that measures the brightness (0 to
// 255) at a point of the world.
async function look(quality, eye, target) {
  const { page, faults } = await openPage(browser, `${server.url}${quality}#view=${[...eye, ...target]}&show=`);
  await waitUntilDrawn(page);
  await settled(page);
  const clip = await viewClip(page);
  const image = await picture(page, clip);
  assert.deepEqual(faults, []);
  await page.close();
  return (point) => {
    const { x, y } = project(point, eye, target, image);
    const at = 4 * (Math.round(y) * image.width + Math.round(x));
    return (image.data[at] + image.data[at + 1] + image.data[at + 2]) / 3;
  };
}

const BEST = "?quality=best";

test("metal reflects its surroundings where no light shines on it", async () => {
  const [eye, target] = [[0, -6, 1], [0, -3, 0.5]];
  const inShade = [-0.3, -3.35, 0.33]; // on the ball, away from the sun
  const [plain, rich] = [(await look("", eye, target))(inShade), (await look(BEST, eye, target))(inShade)];
  assert.ok(plain < 30, `without an environment: ${plain}`);
  assert.ok(rich > 45 && rich > 2 * plain, `with one: ${rich}`);
});

test("the ground is darker beside a block than in the open, although the sun shines on it", async () => {
  const [eye, target] = [[2.5, -2.5, 3], [0.5, -0.5, 0]];
  const [beside, open] = [[0.53, 0, 0], [1.6, 0, 0]];
  const share = async (quality) => {
    const at = await look(quality, eye, target);
    return at(beside) / at(open);
  };
  const [plain, rich] = [await share(""), await share(BEST)];
  assert.ok(Math.abs(plain - 1) < 0.04, `without occlusion: ${plain}`);
  assert.ok(rich < 0.93, `with it: ${rich}`);
});

test("the shadow of a pole of 2 cm is sharp, because the shadow map is fitted to the view", async () => {
  const [eye, target] = [[3, -0.7, 0.5], [2.95, 0, 0.05]];
  const edge = async (quality) => {
    const at = await look(quality, eye, target);
    const share = (y) => at([2.95, y, 0]) / at([2.95, -0.1, 0]);
    return { inside: share(0), outside: share(-0.025) };
  };
  const [plain, rich] = [await edge(""), await edge(BEST)];
  assert.ok(rich.inside < 0.75, `in the shadow: ${rich.inside}`);
  assert.ok(rich.outside > 0.9, `15 mm beside it: ${rich.outside}`);
  assert.ok(plain.outside < 0.9, `15 mm beside it, not fitted: ${plain.outside}`);
});

test("ambient occlusion maps darken a surface in the shade, and light maps light it", async () => {
  const [eye, target] = [[-16, 3, 1.5], [-10, 3, 0.5]];
  const at = await look("", eye, target); // the sides away from the sun
  const [plain, occluded, baked] = [1.8, 3, 4.2].map((y) => at([-10.5, y, 0.5]));
  assert.ok(plain > 20, `without maps: ${plain}`);
  assert.ok(occluded < plain / 3, `without ambient light: ${occluded}`);
  // White light on a diffuse colour of 0.7 (sRGB 179) adds this colour.
  assert.ok(baked > 165 && baked < 215, `with baked light: ${baked}`);
});

test("normal maps tilt a surface towards the sun or away from it, and roughness spreads the light of metal", async () => {
  const [eye, target] = [[-1, -4.8, 2.5], [-10, -4.8, 0.5]];
  const at = await look("", eye, target); // the sides that face the sun
  const front = Object.keys(TILTED).map((_, i) => at([-9.5, -1.2 * (i + 1), 0.5]));
  const top = Object.keys(TILTED).map((_, i) => at([-10, -1.2 * (i + 1), 1]));
  const [level, , up, down] = front;
  // The cosine of the angle to the sun is 0.45 without a tilt, 0.95 for a tilt upwards, and below 0
  // for a tilt downwards.
  assert.ok(up > 1.25 * level, `tilted up: ${front}`);
  assert.ok(down < 0.75 * level, `tilted down: ${front}`);
  // On the top, left is towards negative x: 0.89 without a tilt, and 0.32.
  assert.ok(top[1] < 0.85 * top[0], `tilted to the left: ${top}`);

  const toSun = unit([0.5, 0, 1]);
  // The brightness of a ball where it reflects the sun to the eye, and 25 degrees above that place.
  const [smooth, rough, mapped] = Object.values(BALLS).map((y) => {
    const centre = [-10, y, 0.5];
    const toEye = unit(minus(eye, centre));
    const normal = unit(toSun.map((value, k) => value + toEye[k]));
    const [x, , z] = normal;
    const angle = Math.atan2(z, x) + (25 * Math.PI) / 180;
    const above = [Math.hypot(x, z) * Math.cos(angle), normal[1], Math.hypot(x, z) * Math.sin(angle)];
    return [normal, above].map((direction) => at(centre.map((value, k) => value + 0.5 * direction[k])));
  });
  assert.ok(smooth[0] > 1.2 * rough[0] && smooth[1] < 0.5 * rough[1], `smooth ${smooth}, rough ${rough}`);
  rough.forEach((value, i) => assert.ok(Math.abs(mapped[i] - value) < 8, `by a value ${rough}, by a map ${mapped}`));
});
