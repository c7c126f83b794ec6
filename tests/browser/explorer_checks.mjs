// The explorer: what a reader does with it.
import assert from "node:assert/strict";
import { packOf } from "./packs.mjs";

const kReady = "!document.getElementById('explorer-app')?.hidden";
const kHeading = "document.getElementById('explorer-elite').textContent";
const kPlay = "document.querySelector('.arm-player .play')";
const arm = "document.querySelector('.arm canvas').toDataURL()";
const text = (selector) => `document.querySelector(${JSON.stringify(selector)}).textContent`;
const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
const plain = (words) => words.replaceAll("\u202f", "");

// Sets a control that has these words before it, as a person would.
const choose = (label, value) => `(() => {
  const control = [...document.querySelectorAll(".explorer-bar label")].find((l) => l.textContent.startsWith(${JSON.stringify(label)})).querySelector("select, input");
  control.value = ${JSON.stringify(value)};
  control.dispatchEvent(new Event(control.tagName === "SELECT" ? "change" : "input", { bubbles: true }));
})()`;
// The counts above the maps.
const counts = async (page) => (await page.evaluate("[...document.querySelectorAll('.elite-map .place')].map((p) => p.textContent)"))
  .map((words) => Number(plain(words).match(/^\d+/)[0]));

// On the page that is open: as a reader who follows a link within it.
async function follow(page, hash) {
  await page.evaluate(`location.hash = "${hash}"`);
  await page.holds(`${kHeading}.endsWith("· ${hash.split("/")[2]}")`);
}

// The address of the digit whose way is longest: some are dots.
function longestWay(html) {
  const { arrays } = packOf(html, "explorer-00"), lengths = arrays["hbr/points"].values;
  return `#hbr/0/${arrays["hbr/id"].values[lengths.indexOf(Math.max(...lengths))]}`;
}

export const explorerChecks = [
  ["scripts read what the program packed", async (page, { html }) => {
    for (const name of packOf(html, "explorer").words.replications) {
      const { words, arrays } = packOf(html, "explorer-" + name);
      assert.deepEqual(await page.evaluate(`unpack("explorer-${name}").then((pack) => pack.words)`), words);
      for (const [array, { shape, values }] of Object.entries(arrays)) {
        const read = await page.evaluate(`unpack("explorer-${name}").then(({ arrays }) => {
          const { shape, values } = arrays[${JSON.stringify(array)}];
          return [shape, values.length, values.reduce((sum, v, i) => sum + v * ((i % 97) + 1), 0)]; })`);
        const sum = values.reduce((all, v, i) => all + v * ((i % 97) + 1), 0);
        assert.deepEqual(read, [shape, values.length, sum], array);
      }
    }
  }, "desk"],

  ["a click goes into the address, a reload and the way back come to the same elite", async (page) => {
    const middle = (await page.evaluate(`(() => { document.getElementById("explorer").scrollIntoView({ behavior: "instant" });
      return [...document.querySelectorAll(".map")].map((map) => { const b = map.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 3]; }); })()`));
    const seen = [], steps = await page.evaluate("history.length");
    for (const [x, y] of middle) {
      await page.click(x, y);
      seen.push([await page.evaluate("location.hash"), await page.evaluate(kHeading)]);
    }
    assert.match(seen[0][0], /^#hbr\/0\/\d+$/);
    assert.match(seen[1][0], /^#flat\/0\/\d+$/);
    assert.equal(await page.evaluate("history.length"), steps + 2, "each click is a step back");
    for (const [hash, heading] of seen) assert.ok(heading.endsWith("· " + hash.split("/")[2]), heading);
    await page.go(null, kReady);
    assert.equal(await page.evaluate(kHeading), seen[1][1]);
    await page.evaluate("history.back()");
    await page.holds(`${kHeading} === ${JSON.stringify(seen[0][1])}`);
    await page.evaluate("history.forward()");
    await page.holds(`${kHeading} === ${JSON.stringify(seen[1][1])}`);
  }, "desk"],

  // Another replication comes only when it is delivered, and nobody waits for it any more.
  ["the address that comes last counts", async (page, { url, html }) => {
    await page.go(url, kReady);
    const { words } = packOf(html, "explorer"), [first, second] = packOf(html, "explorer-00").arrays["hbr/id"].values;
    await page.evaluate(`unpack("explorer").then(({ words }) => {
      words.replications.push("slow");
      unpacked.set("explorer-slow", new Promise((resolve) => { window.deliver = () => resolve(unpack("explorer-00")); })); })`);
    await page.evaluate(`location.hash = "#hbr/${words.replications.length}/${first}"`);
    await wait(100);
    await follow(page, `#hbr/0/${second}`);
    await page.evaluate("deliver()");
    await wait(300);
    assert.equal((await page.evaluate(kHeading)).split("· ")[1], String(second));
    assert.ok((await page.evaluate(text(".python"))).includes("/00.h5"));
  }, "own"],

  ["an address opens any layer", async (page, { url, html }) => {
    const { words, arrays } = packOf(html, "explorer-00");
    const last = (group) => arrays[group + "/id"].values.at(-1);
    await page.go(`${url}#flat/0/${last("flat")}`, kReady);
    await page.holds("(({ top, bottom }) => top < innerHeight / 2 && bottom > innerHeight / 2)(document.getElementById('explorer').getBoundingClientRect())");
    for (const { group } of words.layers) {
      await follow(page, `#${group}/0/${last(group)}`);
      const genes = arrays[group + "/length"]?.values.at(-1) ?? arrays[group + "/solution"].shape[1];
      assert.equal(await page.evaluate("document.querySelectorAll('.genome tbody tr').length"), genes, group);
    }
    // What is not there is told, beside the first elite that is.
    for (const [visit, hash] of ["#hbr/0/999999999", "#nobody/0/12", "#hbr/99/1"].entries()) {
      await page.go(`${url}?visit=${visit}${hash}`, kReady);
      assert.match(await page.evaluate(kHeading), /· \d+$/);
      assert.ok((await page.evaluate(text(".absent"))).startsWith(`${hash} is not in this run’s explorer`), hash);
    }
    await follow(page, `#flat/0/${last("flat")}`);
    assert.equal(await page.evaluate(text(".absent")), "");
  }, "own"],

  ["the keyboard reaches every control, and arrow keys go to neighbours", async (page, { html }) => {
    const reachable = `[...document.querySelectorAll("#explorer :is(button, select, input, summary, a[href], .map)")].filter((e) => e.getClientRects().length)`;
    const controls = await page.evaluate(`${reachable}.length`);
    await page.evaluate(`window.passed = []; ${reachable}[0].focus()`);
    for (let k = 0; k < controls; ++k) {
      await page.evaluate("passed.push(document.activeElement)");
      assert.ok(await page.evaluate("document.activeElement.matches(':focus-visible') && (getComputedStyle(document.activeElement).outlineStyle !== 'none')"), `no focus is shown by ${await page.evaluate("document.activeElement.cloneNode().outerHTML")}`);
      await page.press("Tab");
    }
    assert.deepEqual(await page.evaluate(`${reachable}.filter((e) => !passed.includes(e)).map((e) => e.cloneNode().outerHTML)`), [], "Tab passes by");

    const { arrays } = packOf(html, "explorer-00"), ids = arrays["hbr/id"].values, places = arrays["hbr/measures"].values;
    const place = async () => {
      const row = ids.indexOf(Number((await page.evaluate("location.hash")).split("/")[2]));
      return places.slice(2 * row, 2 * row + 2);
    };
    const middle = ids.map((id, i) => [places[2 * i], id]).sort((a, b) => a[0] - b[0])[Math.floor(ids.length / 2)][1];
    let moves = 0;
    for (const [key, axis, sign] of [["ArrowRight", 0, 1], ["ArrowUp", 1, 1], ["ArrowLeft", 0, -1], ["ArrowDown", 1, -1]]) {
      await follow(page, `#hbr/0/${middle}`);
      await page.evaluate("document.querySelector('.map').focus()");
      const before = await place(), farther = places.some((v, i) => i % 2 === axis && (v - before[axis]) * sign > 0.001);
      await page.press(key);
      const after = await place();
      if (farther) assert.ok((after[axis] - before[axis]) * sign > 0, `${key}: from ${before} to ${after}`);
      moves += farther;
    }
    assert.ok(moves >= 2);
    await follow(page, longestWay(html));
    await page.evaluate(`document.querySelector('[aria-label="Speed"]').value = "0.25"; ${kPlay}.focus()`);
    assert.equal(await page.evaluate(`${kPlay}.textContent`), "Play");
    await page.press("Enter");
    await page.holds(`${kPlay}.textContent === "Pause"`);
  }, "desk"],

  ["the arm moves until it is paused, and can be moved by hand", async (page, { html }) => {
    await follow(page, longestWay(html));
    await page.evaluate(`document.querySelector('[aria-label="Speed"]').value = "0.25";
      if (${kPlay}.textContent === "Pause") ${kPlay}.click(); ${kPlay}.click()`);
    const first = await page.evaluate(arm);
    await page.holds(`(({ value, max }) => Number(value) > Number(max) / 8)(document.querySelector('[aria-label="Posture"]'))`);
    assert.ok((await page.evaluate(arm)) !== first, "nothing moves");
    assert.equal(await page.evaluate(`${kPlay}.textContent`), "Pause");
    await page.evaluate(`${kPlay}.click()`);
    const still = await page.evaluate(arm);
    await wait(150);
    assert.ok((await page.evaluate(arm)) === still, "it moves while it is paused");
    await page.evaluate(`(() => { const scrub = document.querySelector('[aria-label="Posture"]'); scrub.value = "0"; scrub.dispatchEvent(new Event("input")); })()`);
    assert.ok((await page.evaluate(arm)) !== still, "the slider does not move it");
  }, "moving"],

  ["several addresses one after the other do not hurry the arm", async (page, { html }) => {
    await page.evaluate(`document.querySelector('[aria-label="Speed"]').value = "0.25"`);
    const [first, second] = packOf(html, "explorer-00").arrays["hbr/id"].values;
    for (const hash of [`#hbr/0/${first}`, `#hbr/0/${second}`, longestWay(html)]) await follow(page, hash);
    const { moved, seconds, postures } = await page.evaluate(`(async () => {
      const scrub = document.querySelector('[aria-label="Posture"]'), from = Number(scrub.value), start = performance.now();
      await new Promise((resolve) => setTimeout(resolve, 2000));
      return { moved: Number(scrub.value) - from, seconds: (performance.now() - start) / 1000, postures: Number(scrub.max) + 1 }; })()`);
    const one = Math.max(3, postures / 4) * 0.25 * seconds;  // whole postures are told
    assert.ok(moved > 0 && moved <= 1.3 * one + 1, `${moved} postures in place of ${one}`);
  }, "moving"],

  ["who asks for less motion gets none", async (page, { html }) => {
    assert.equal(await page.evaluate("getComputedStyle(document.documentElement).scrollBehavior"), "auto");
    await follow(page, longestWay(html));
    assert.equal(await page.evaluate(`${kPlay}.textContent`), "Play");
    const still = await page.evaluate(arm);
    await wait(150);
    assert.ok((await page.evaluate(arm)) === still, "it moves");
    await page.evaluate(`${kPlay}.click()`);
    await page.holds(`${arm} !== ${JSON.stringify(still)}`);
    const strokes = await page.evaluate(`Promise.all([...document.querySelectorAll("svg")].filter((svg) => svg.querySelector("animate")).map(async (svg) => {
      const moves = () => { try { svg.querySelector("animate").getStartTime(); return true; } catch { return false; } };
      const button = svg.parentElement.previousElementSibling, seen = [moves()];
      for (let k = 0; k < 2; ++k) {
        button.click();
        await new Promise((resolve) => setTimeout(resolve, 200));
        seen.push(moves());
      }
      return seen.join(); }))`);
    assert.ok(strokes.length > 0);
    assert.deepEqual(strokes.filter((seen) => seen !== "false,true,false"), []);
  }, "desk"],

  ["filters and the table keep what the data has", async (page, { html }) => {
    const { words, arrays } = packOf(html, "explorer-00");
    const of = (group, name) => arrays[`${group}/${name}`].values;
    const batch = Object.fromEntries(words.layers.map((layer) => [layer.group, layer.batch]));
    const expected = (passes) => ["hbr", "flat"].map((group) => of(group, "id").filter((id, i) => passes(group, i)).length);
    await page.evaluate(`window.saved = []; const make = URL.createObjectURL; URL.createObjectURL = (blob) => { saved.push(blob); return make.call(URL, blob); }`);
    const table = async () => {
      await page.evaluate("[...document.querySelectorAll('.explorer-bar button')].find((b) => b.textContent.endsWith('CSV')).click()");
      return (await page.evaluate("saved.at(-1).text()")).trim().split("\n");
    };
    assert.deepEqual(await counts(page), expected(() => true));
    const digit = of("hbr", "label")[0], median = Math.floor([...of("hbr", "id")].sort((a, b) => a - b)[Math.floor(of("hbr", "id").length / 2)] / batch.hbr) + 1;
    for (const [label, value, passes] of [
      ["Class", String(digit), (group, i) => of(group, "label")[i] === digit],
      ["Good", "1", (group, i) => of(group, "good")[i] === 1],
      ["Good", "0", (group, i) => of(group, "good")[i] === 0],
      ["Born", String(median), (group, i) => Math.floor(of(group, "id")[i] / batch[group]) + 1 <= median],
    ]) {
      await page.evaluate(choose(label, value));
      const wanted = expected(passes);
      assert.deepEqual(await counts(page), wanted, `${label} ${value}`);
      const [head, ...rows] = await table();
      assert.equal(rows.length, wanted[0] + wanted[1]);
      for (const row of rows) assert.equal(row.split(",").length, head.split(",").length);
      await page.evaluate(choose(label, label === "Born" ? "1000000" : ""));
    }
    const errors = ["hbr", "flat"].flatMap((group) => of(group, "objective").map((value) => -value));
    const low = Math.min(...errors), limit = low + (Math.max(...errors) - low) * 0.3;
    await page.evaluate(choose("Network’s error", "30"));
    assert.deepEqual(await counts(page), expected((group, i) => -of(group, "objective")[i] <= limit));
    const rows = (await table()).slice(1).map((row) => row.split(","));
    const { descriptor } = words.layers.find(({ group }) => group === "hbr"), span = descriptor.high - descriptor.low;
    for (const [, , id, parent, ...places] of rows.filter(([layer]) => layer === rows[0][0])) {
      const at = of("hbr", "id").indexOf(Number(id));
      assert.equal(Number(parent), of("hbr", "parent")[at], `${id}'s parent`);
      descriptor.from.forEach((from, d) => {
        const place = from + ((of("hbr", "measures")[2 * at + d] - descriptor.low) / span) * (descriptor.to[d] - from);
        assert.ok(Math.abs(Number(places[d]) - place) < 1e-6, `${id}: ${places[d]} in place of ${place}`);
      });
    }
    assert.deepEqual(rows.filter(([layer]) => layer === rows[0][0]).map((row) => Number(row[2])),
      of("hbr", "id").filter((_, i) => -of("hbr", "objective")[i] <= limit));
  }, "desk"],

  // Of points the cost is told, of numbers the fitness: whichever it is, the worst are left out.
  ["a filter keeps the better elites of every layer", async (page, { html }) => {
    const { words, arrays } = packOf(html, "explorer-00");
    let fitnesses = 0;
    for (const { group, fitness } of words.layers) {
      if (!/^layer[^2]/.test(group)) continue;
      const values = Array.from(arrays[group + "/objective"].values), best = Math.max(...values), worst = Math.min(...values);
      const ids = arrays[group + "/id"].values;
      await follow(page, `#${group}/0/${ids[0]}`);
      const isCost = fitness.meaning.startsWith("minus ");
      fitnesses += !isCost;
      const slider = `[...document.querySelectorAll(".explorer-bar label")].find((l) => / (up to|from) /.test(l.textContent)).querySelector("input")`;
      assert.equal(await page.evaluate(`${slider}.parentNode.parentNode.textContent.includes(${isCost ? "' up to '" : "' from '"})`), true, group);
      assert.deepEqual(await counts(page), [values.length], group);
      await page.evaluate(`${slider}.value = "${isCost ? 25 : 75}"; ${slider}.dispatchEvent(new Event("input", { bubbles: true }))`);
      const kept = values.filter((value) => value >= best - (best - worst) * 0.25).length;
      assert.deepEqual(await counts(page), [kept], group);
      assert.ok(kept > 0 && kept < values.length, group);
    }
    assert.equal(fitnesses, words.layers.some(({ group }) => group === "layer5") ? 1 : 0);
  }, "desk"],

  // As some networks give.
  ["a descriptor of one number has a map", async (page) => {
    const places = await page.evaluate(`(async () => {
      const { words, arrays } = await unpack("explorer-00"), layer = words.layers.find(({ group }) => group === "hbr");
      const { shape: [elites, columns], values } = arrays["hbr/measures"];
      const one = { shape: [elites, 1], values: values.filter((_, i) => i % columns === 0) };
      const descriptor = Object.fromEntries(Object.entries(layer.descriptor).map(([key, of]) => [key, Array.isArray(of) ? of.slice(0, 1) : of]));
      const narrow = new ExplorerLayer({ ...layer, descriptor, robot: {} }, { ...arrays, "hbr/measures": one });
      const map = new EliteMap(narrow, { hover() {}, choose() {}, step() {} });
      document.body.append(map.root);
      map.show({ axes: [0, 1], visible: [...narrow.id.keys()], scale: colouring([narrow], "error") });
      const places = map.visible.map((row) => map.xy(map.place(row)));
      map.root.remove();
      return places; })()`);
    assert.ok(places.every(([x, y]) => Number.isFinite(x) && Number.isFinite(y) && y === places[0][1]));
    assert.ok(new Set(places.map(([x]) => x)).size > 1);
  }, "desk"],

  ["words can be read on their paper", async (page) => {
    for (const theme of ["light", "dark"]) {
      await page.media({ "prefers-color-scheme": theme });
      const faint = await page.evaluate(`(() => {
        const light = (colour) => { const [r, g, b] = colour.match(/[\\d.]+/g).map((v) => { const s = v / 255; return s <= 0.03928 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4; }); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
        const paper = (e) => { if (e.previousElementSibling?.matches('circle[fill="#ffffff"]')) return "rgb(255, 255, 255)"; for (; e; e = e.parentElement) { const c = getComputedStyle(e).backgroundColor; if (!/, 0\\)$|transparent/.test(c)) return c; } return "rgb(255, 255, 255)"; };
        const poor = [];
        for (const [words, ink] of [["body :not(svg, svg *)", "color"], ["main svg text", "fill"]])
          for (const e of document.querySelectorAll(words)) {
            if (![...e.childNodes].some((n) => n.nodeType === 3 && n.data.trim()) || !e.getClientRects().length) continue;
            const [a, b] = [light(getComputedStyle(e)[ink]), light(paper(e))].sort((x, y) => y - x);
            if ((a + 0.05) / (b + 0.05) < 4.5) poor.push(e.tagName + " " + e.textContent);
          }
        return poor; })()`);
      assert.deepEqual(faint, []);
    }
  }, "desk"],
];
