// The page of `make robot` in a real browser: node tests/browser/robot_page.mjs PAGE. Without three.js it shows pictures.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { dirname, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser } from "./browser.mjs";

const file = resolve(process.argv[2]), html = readFileSync(file, "utf8"), kView = "document.getElementById('robot').view";
const browser = await Browser.start();
try {
  const page = await browser.page();
  await page.size(1200, 900);
  await page.media({ "prefers-color-scheme": "light", "prefers-reduced-motion": "no-preference" });
  await page.go(pathToFileURL(file).href, "document.readyState === 'complete'");
  assert.ok(await page.evaluate("document.images.length > 0 && [...document.images].every((image) => image.naturalWidth > 100)"), "a picture is missing");
  if (html.includes('id="pack-three"')) {
    await page.holds(`Boolean(${kView})`);
    const camera = () => page.evaluate(`${kView}.scene.camera.position.toArray()`);
    const first = await camera();
    await page.holds(`Math.hypot(...${kView}.scene.camera.position.toArray().map((x, k) => x - ${JSON.stringify(first)}[k])) > 0.05`);
    await page.evaluate("document.querySelector('[data-robot=turn]').click()");
    assert.equal(await page.evaluate(`${kView}.turning`), false, "it does not stop");
    const stands = await camera();
    await page.evaluate("new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(resolve))))");
    assert.deepEqual(await camera(), stands, "it turns on");
    for (const key of ["ArrowLeft", "ArrowUp"]) {
      const before = await camera();
      await page.evaluate("document.querySelector('[data-robot=canvas]').focus()");
      await page.press(key);
      assert.notDeepEqual(await camera(), before, `${key} does not turn it`);
    }
    // A slider moves its joint alone, and with it what hangs on it.
    const moved = await page.evaluate(`(() => {
      const view = ${kView}, ranges = [...document.querySelectorAll("[data-robot=joints] input")], last = ranges.length - 1;
      const before = view.body.frames(view.joints);
      ranges[last].value = ranges[last].max;
      ranges[last].dispatchEvent(new Event("input"));
      const after = view.body.frames(view.joints), shown = view.scene.parts.map((part) => part.matrix.toArray());
      return { joints: ranges.length, want: view.body.lower.length, told: ranges[last].getAttribute("aria-valuetext"), value: view.joints[last], upper: view.body.upper[last],
        kept: view.joints.slice(0, last).every((value, k) => value === view.rest[k]),
        moves: JSON.stringify(before) !== JSON.stringify(after),
        placed: shown.every((m, k) => after[k].every((value, i) => Math.abs(m[4 * (i % 4) + Math.floor(i / 4)] - value) < 1e-9)) };
    })()`);
    assert.equal(moved.joints, moved.want);
    assert.match(moved.told, / (m|rad)$/);
    assert.ok(Math.abs(moved.value - moved.upper) < 1e-9 && moved.kept && moved.moves && moved.placed, JSON.stringify(moved));
    await page.evaluate("document.querySelector('[data-robot=reset]').click()");
    assert.ok(await page.evaluate(`${kView}.joints.every((value, k) => value === ${kView}.rest[k])`), "Reset does not");
    await page.media({ "prefers-reduced-motion": "reduce" });
    await page.go(null, `Boolean(${kView})`);
    assert.equal(await page.evaluate(`${kView}.turning`), false, "it turns for who asked for no motion");
  } else {
    assert.ok(html.includes("three.js could not be had"));
  }
  const strange = page.requests.filter((url) => !url.startsWith(pathToFileURL(dirname(file)).href + "/") && !/^(blob|data):/.test(url));
  assert.deepEqual(strange, [], "asks for what is elsewhere");
  assert.deepEqual(page.faults, [], "the console says");
} finally {
  await browser.close();
}
