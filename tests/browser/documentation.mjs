// Takes images for docs/viewer.md during the tests, if GSV_DOC_IMAGES names a folder for them.
import fs from "node:fs";
import path from "node:path";
import process from "node:process";

const folder = process.env.GSV_DOC_IMAGES;
const QUALITY = 82;

// Append this to a page's address to draw all pixels with the best light, regardless of the time.
export const SHARP = folder ? "?quality=best" : "";

// Notices, which go away by themselves, are left out.
export async function keepPicture(page, name) {
  if (!folder) return;
  fs.mkdirSync(folder, { recursive: true });
  const file = path.join(folder, `${name}.jpg`);
  await showNotices(page, "hidden");
  await page.screenshot({
    path: file,
    type: "jpeg",
    quality: QUALITY,
    animations: "disabled",
    caret: "hide",
  });
  await showNotices(page, "");
}

function showNotices(page, visibility) {
  return page.evaluate((value) => {
    for (const notices of document.querySelectorAll(".notices")) notices.style.visibility = value;
  }, visibility);
}
