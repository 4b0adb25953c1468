// @vitest-environment jsdom
import fs from "node:fs";
import path from "node:path";
import { expect, test, vi } from "vitest";
import { OVERLAYS } from "../state/overlays";
import { PANELS } from "./registry";
import { testPorts } from "./contract/testPorts";

test("ids, titles and keys are unique", () => {
  const keys = PANELS.flatMap(({ key }) => (key ? [key] : []));
  for (const list of [PANELS.map(({ id }) => id), PANELS.map(({ title }) => title), keys]) {
    expect(new Set(list).size).toBe(list.length);
  }
  expect(keys.filter((key) => OVERLAYS.some((overlay) => overlay.key === key))).toEqual([]);
  expect(keys.every((key) => /^[A-Z]$/.test(key))).toBe(true);
});

test.each(PANELS)("the panel $id is mounted, opened, closed and opened again", async ({ load }) => {
  vi.spyOn(HTMLCanvasElement.prototype, "getContext").mockReturnValue(null); // jsdom draws nothing
  const { mount } = await load();
  const { body, whileOpen } = mount(testPorts().ports);
  for (let i = 0; i < 2; ++i) whileOpen?.()();
  expect(body).toBeInstanceOf(HTMLElement);
  vi.restoreAllMocks();
});

test("panels access the page only through their ports", () => {
  const folder = path.join(process.cwd(), "src/panels");
  const sources = (fs.readdirSync(folder, { recursive: true }) as string[]).filter(
    (file) => file.endsWith(".ts") && !file.endsWith(".test.ts"),
  );
  expect(sources).toContain(path.join("status", "StatusPanel.ts"));
  const importsOf = (file: string) =>
    [...fs.readFileSync(path.join(folder, file), "utf8").matchAll(/"((?:\.\.\/)+)(\w+)/g)]
      .filter(([, up]) => path.normalize(path.join("panels", path.dirname(file), up!)) === "./")
      .map(([, , top]) => top!);
  const allowed = ["api", "live", "plot", "protocol", "state", "ui"];
  for (const file of sources) expect([file, importsOf(file).filter((top) => !allowed.includes(top))]).toEqual([file, []]);
});
