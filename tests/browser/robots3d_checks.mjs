// Robots in three dimensions: what a reader does with them. The report stands in its run's folder.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { packOf } from "./packs.mjs";
import { nameless } from "./page_checks.mjs";

const kPlayer = "document.getElementById('robots3d').player";
const kCanvas = "document.querySelector('#robots3d canvas[tabindex]')";
const control = (name) => `document.querySelector('[data-r3="${name}"]')`;
const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

// What the canvas shows, all its pixels as one number. It is drawn once more for this: browsers forget what was drawn
// before. A PNG of it would take a second.
const picture = (page) => page.evaluate(`(() => {
  ${kPlayer}.scene.draw();
  const gl = ${kCanvas}.getContext("webgl2"), pixels = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
  gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  return new Uint32Array(pixels.buffer).reduce((hash, pixel) => Math.imul(hash ^ pixel, 16777619) >>> 0, 2166136261); })()`);
async function show(page) {
  await page.evaluate("document.documentElement.style.scrollBehavior = 'auto'; document.getElementById('robots3d').scrollIntoView(), 0");
  await page.holds(`${kPlayer}?.way?.length > 0`);
}
const choose = (page, changes) => page.evaluate(`${kPlayer}.choose(${JSON.stringify(changes)})`);

// Arrays of an HDF5 file, by h5py.
function arraysOf(file, names) {
  const script = "import h5py, json, sys; f = h5py.File(sys.argv[1]); print(json.dumps({n: f[n][:].tolist() for n in sys.argv[2:]}))";
  return JSON.parse(execFileSync("/usr/bin/python3", ["-c", script, file, ...names], { maxBuffer: 1 << 28 }));
}

const checks = [
  ["a robot draws, pauses, is moved by hand and turned", async (page) => {
    await show(page);
    assert.equal(await page.evaluate(`${kPlayer}.robot`), "nao");
    const lengths = await page.evaluate(`${kPlayer}.digits.id.map((_, row) => ${kPlayer}.ways.way(row).length)`);
    await choose(page, { row: lengths.indexOf(Math.max(...lengths)) });
    await page.evaluate(`${control("speed")}.value = "0.5", ${kPlayer}.pause(), ${kPlayer}.moveTo(0), ${kPlayer}.play()`);
    const first = await picture(page);
    await wait(700);
    assert.ok((await picture(page)) !== first, "nothing moves");
    assert.equal(await page.evaluate(`${control("play")}.textContent`), "Pause");
    await page.evaluate(`${control("play")}.click()`);
    await wait(300);
    const still = await picture(page);
    await wait(300);
    assert.ok((await picture(page)) === still, "it moves while it is paused");
    await page.evaluate(`${control("scrub")}.value = "300"; ${control("scrub")}.dispatchEvent(new Event("input"))`);
    const at = await page.evaluate(`${kPlayer}.at / ${kPlayer}.duration`);
    assert.ok(Math.abs(at - 0.3) < 1e-6, `at ${at}`);
    await page.evaluate(`${kCanvas}.focus()`);
    await wait(300);
    const before = await picture(page);
    await page.press("ArrowLeft");
    await page.press("ArrowUp");
    await wait(300);
    assert.ok((await picture(page)) !== before, "keys do not turn it");
    await page.press("Home");
    await wait(300);
    assert.ok((await picture(page)) === before, "the view does not come back");
  }, "moving"],

  ["the pen is where the run has it", async (page, { html, run }) => {
    await show(page);
    const pens = `Array.from({ length: ${kPlayer}.digits.id.length }, (_, row) => ${kPlayer}.ways.way(row).map((joints) => {
      const { body } = ${kPlayer}.scene, { x, y } = body.onBoard(body.penOf(body.frames(joints))); return [x, y]; }))`;
    const { words } = packOf(html, "robots3d");
    for (const { name } of words.robots) {
      await choose(page, { robot: name, replication: "00" });
      const found = await page.evaluate(pens);
      let stored;
      if (name === "arm") {
        stored = await page.evaluate(`${kPlayer}.digits.id.map((_, row) => ${kPlayer}.digits.penOf(row))`);
      } else {
        const file = join(run, `${name}_ways/00.h5`);
        assert.ok(existsSync(file), `${file} is not there`);
        const { points, way, pen } = arraysOf(file, ["points", "way", "pen"]);
        let from = 0;
        stored = points.map((n) => way.slice(from, (from += n)).map((at) => pen[at]));
      }
      assert.equal(found.length, stored.length);
      assert.deepEqual(found.map((digit) => digit.length), stored.map((digit) => digit.length), name);
      found.forEach((digit, row) => digit.forEach(([x, y], k) => {
        const off = Math.hypot(x - stored[row][k][0], y - stored[row][k][1]);
        assert.ok(off < 1e-5, `${name}, digit ${row}, point ${k}: ${off} m`);
      }));
    }
  }, "desk"],

  ["robots and digits are chosen by the keyboard and by an address", async (page, { html }) => {
    await show(page);
    assert.deepEqual(await nameless(page, 30), []);
    const { words } = packOf(html, "robots3d");
    await choose(page, { robot: words.robots[0].name, replication: "00" });
    await page.evaluate(`${control("robot")}.focus()`);
    for (const { name } of words.robots.slice(1)) {
      await page.press("ArrowDown");
      await page.holds(`${kPlayer}.robot === ${JSON.stringify(name)}`);
    }
    const row = await page.evaluate(`${kPlayer}.row`), count = await page.evaluate(`${kPlayer}.digits.id.length`);
    await page.evaluate(`${control("next")}.focus()`);
    await page.press("Enter");
    await page.holds(`${kPlayer}.row === ${(row + 1) % count}`);
    const id = await page.evaluate(`${kPlayer}.digits.id[3]`);
    await page.evaluate(`location.hash = "#hbr/0/${id}"`);
    await page.holds(`${kPlayer}.row === 3`);
    assert.ok((await page.evaluate(`${control("facts")}.textContent`)).includes(String(id)));
  }, "desk"],

  ["an address counts the explorer's replications, of which the robots may lack some", async (page, { url }) => {
    await page.go(url, "!document.getElementById('explorer-app')?.hidden");
    await show(page);
    const [row, id] = await page.evaluate(`(({ row, digits: { id } }) => [(row + 1) % id.length, id[(row + 1) % id.length]])(${kPlayer})`);
    await page.evaluate(`unpack("explorer").then(({ words }) => words.replications.unshift("another"))`);
    await page.evaluate(`history.replaceState(null, "", "#hbr/1/${id}")`);
    assert.equal(await page.evaluate(`${kPlayer}.followAddress()`), true, "the address names no digit");
    assert.equal(await page.evaluate(`${kPlayer}.row`), row);
    // Which the robots do not hear: the explorer tells them.
    await choose(page, { row: (row + 1) % (await page.evaluate(`${kPlayer}.digits.id.length`)) });
    await page.evaluate("dispatchEvent(new PopStateEvent('popstate'))");
    await page.holds(`${kPlayer}.row === ${row}`);
    await page.go(`${url}?opened#hbr/0/${id}`, "!document.getElementById('explorer-app')?.hidden");
    await show(page);
    await page.holds(`${kPlayer}.row === ${row}`);
  }, "own"],

  ["only a digit that was good is said to be read as before", async (page, { html }) => {
    await show(page);
    await choose(page, { robot: packOf(html, "robots3d").words.robots[0].name });
    for (const row of await page.evaluate(`${kPlayer}.digits.id.map((_, row) => row).filter((row) => ${kPlayer}.ways.servos(row))`)) {
      await choose(page, { row });
      const said = (await page.evaluate(`${control("facts")}.textContent`)).includes("read as before");
      assert.ok(!said || (await page.evaluate(`${kPlayer}.digits.good[${row}] === 1`)), `digit ${row}`);
    }
  }, "desk"],

  ["who asked for no motion sees none, and a phone all of it", async (page) => {
    await show(page);
    assert.equal(await page.evaluate(`${kPlayer}.playing`), false);
    assert.ok(await page.evaluate("document.documentElement.scrollWidth <= innerWidth"));
    assert.ok(await page.evaluate(`${kCanvas}.getBoundingClientRect().width > 250`));
  }, "phone"],
];

// Where three.js could not be had the page says so instead.
export const robotChecks = checks.map(([name, check, kind]) => [name, async (page, report) => {
  if (report.html.includes('id="pack-three"')) return check(page, report);
  assert.ok(report.html.includes("three.js could not be had"));
}, kind]);
