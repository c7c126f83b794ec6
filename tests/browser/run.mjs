// A finished report in a real browser: node tests/browser/run.mjs REPORT/index.html; RUN names the folder of its
// artifacts where that is not the one that REPORT is in. Every check begins with the page as
// it is opened; what fails says why, and all are tried.
import { readFileSync, statSync } from "node:fs";
import { dirname, resolve } from "node:path";
import { Browser } from "./browser.mjs";
import { explorerChecks } from "./explorer_checks.mjs";
import { pageChecks } from "./page_checks.mjs";
import { robotChecks } from "./robots3d_checks.mjs";

const file = resolve(process.argv[2]), only = process.argv[3];
const report = { url: "file://" + file, run: process.env.RUN ?? dirname(dirname(file)), html: readFileSync(file, "utf8"), bytes: statSync(file).size };
const kTries = 3;  // a browser that is starved by what else runs may be too slow for a check of motion

// What is wrong with the page; nothing where the check holds.
async function fault(browser, check) {
  const page = await browser.page();
  try {
    await page.size(1440, 1000);
    await page.media({ "prefers-color-scheme": "light", "prefers-reduced-motion": "no-preference" });
    await check(page, report);
    const strange = page.requests.filter((url) => url.split(/[?#]/)[0] !== report.url && !/^(blob|data):/.test(url));
    if (strange.length) return "asks for " + strange.join(", ");
    if (page.faults.length) return "the console says: " + page.faults.join("; ");
  } catch (error) {
    return error.message;
  } finally {
    await page.close();
  }
}

const browser = await Browser.start();
let failed = 0;
try {
  for (const [name, check] of [...pageChecks, ...explorerChecks, ...robotChecks]) {
    if (only && !name.includes(only)) continue;
    const begin = Date.now();
    let wrong;
    for (let left = kTries; left > 0; --left) {
      wrong = await fault(browser, check);
      if (!wrong) break;
      console.log(`${left > 1 ? "again  " : "FAILED "} ${name}: ${wrong}`);
    }
    if (wrong) ++failed;
    else console.log(`ok      ${name} (${Date.now() - begin} ms)`);
  }
} finally {
  await browser.close();
}
process.exit(failed ? 1 : 0);
