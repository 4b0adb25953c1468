// Pictures for docs/viewer.md, taken by the tests as they go: only where GSV_DOC_IMAGES names a
// folder for them.
import fs from "node:fs";
import path from "node:path";
import process from "node:process";

const folder = process.env.GSV_DOC_IMAGES;
const QUALITY = 82;

// At the end of a page's address: pictures for people have all their pixels, however slow that is.
export const SHARP = folder ? "?quality=high" : "";

export async function keepPicture(page, name) {
  if (!folder) return;
  fs.mkdirSync(folder, { recursive: true });
  const file = path.join(folder, `${name}.jpg`);
  await page.screenshot({
    path: file,
    type: "jpeg",
    quality: QUALITY,
    animations: "disabled",
    caret: "hide",
  });
}
