// A finished report in a real browser: node tests/browser/run.mjs REPORT/index.html; RUN names the folder of its
// artifacts where that is not the one that REPORT is in. A check names the page that it shares with others, opened once
// for all of them, or has one of its own that it opens itself; what fails says why, and all are tried.
import { readFileSync, statSync } from "node:fs";
import { dirname, resolve } from "node:path";
import { Browser } from "./browser.mjs";
import { explorerChecks } from "./explorer_checks.mjs";
import { pageChecks } from "./page_checks.mjs";
import { robotChecks } from "./robots3d_checks.mjs";

const file = resolve(process.argv[2]), only = process.argv[3];
const report = { url: "file://" + file, run: process.env.RUN ?? dirname(dirname(file)), html: readFileSync(file, "utf8"), bytes: statSync(file).size };
const kLongest = 2000;  // characters of a message: a picture's address has ten times as many
const kTries = 3;  // a browser that is starved by what else runs may be too slow for a check of motion
// What moves costs more than all else here, so it moves only where motion is checked.
const kPages = {
  own: { size: [1440, 1000], motion: "no-preference" },
  desk: { size: [1440, 1000], motion: "reduce" },
  moving: { size: [1440, 1000], motion: "no-preference" },
  phone: { size: [390, 800], motion: "reduce" },
};

// The page that is open, and for which checks: a check begins with it as a reader finds it, who has just opened it.
let page = null, opened = null;
async function close() {
  await page?.close();
  page = opened = null;
}
async function begin(browser, kind) {
  const { size, motion } = kPages[kind], look = { "prefers-color-scheme": "light", "prefers-reduced-motion": motion };
  if (kind === "own" || opened !== kind) {
    await close();
    page = await browser.page();
    opened = kind;
    await page.size(...size);
    await page.media(look);
    if (kind !== "own") await page.go(report.url, "!document.getElementById('explorer-app')?.hidden");
    return;
  }
  await page.size(...size);
  await page.media(look);
  await page.evaluate(`(() => {
    const view = (k) => document.querySelectorAll(".explorer-bar .filters button")[k]?.click();
    view(1), view(0);
    history.replaceState(null, "", location.pathname);
    document.activeElement?.blur();
    scrollTo({ top: 0, behavior: "instant" });
  })()`);
}

// What is wrong with the page; nothing where the check holds.
async function fault(browser, check, kind) {
  const wrong = [];
  try {
    await begin(browser, kind);
    await check(page, report);
  } catch (error) {
    wrong.push(error.message.length > kLongest ? error.message.slice(0, kLongest) + " ..." : error.message);
  }
  const strange = (page?.requests ?? []).filter((url) => url.split(/[?#]/)[0] !== report.url && !/^(blob|data):/.test(url));
  if (strange.length) wrong.push("asks for " + strange.join(", "));
  if (page?.faults.length) wrong.push("the console says: " + page.faults.join("; "));
  if (wrong.length) await close();
  return wrong.join("; ");
}

const browser = await Browser.start();
const checks = [...pageChecks, ...explorerChecks, ...robotChecks].filter(([name]) => !only || name.includes(only));
for (const [name, , kind] of checks) if (!kPages[kind]) throw new Error(`${name}: no page is called '${kind}'`);
if (!checks.length) throw new Error(`no check has '${only}' in its name`);
let failed = 0;
try {
  for (const kind of Object.keys(kPages))
    for (const [name, check, of] of checks) {
      if (of !== kind) continue;
      const start = Date.now();
      let wrong;
      for (let left = kTries; left > 0; --left) {
        wrong = await fault(browser, check, kind);
        if (!wrong) break;
        console.log(`${left > 1 ? "again  " : "FAILED "} ${name}: ${wrong}`);
      }
      if (wrong) ++failed;
      else console.log(`ok      ${name} (${Date.now() - start} ms)`);
    }
} finally {
  await browser.close();
}
process.exit(failed ? 1 : 0);
