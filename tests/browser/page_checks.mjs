// The page as a whole.
import assert from "node:assert/strict";

const kMostBytes = 10e6, kMostHeight = 16000;
const sections = "[...document.querySelectorAll('main > section')]";
const claims = "[...document.querySelectorAll('.claims tbody')]";
const kReady = "!document.getElementById('explorer-app')?.hidden";
const filter = (verdict) => `document.querySelector('#claims .filters button[value="${verdict}"]').click()`;

// Controls and pictures that no word names, as they stand in the page.
export async function nameless(page, least) {
  const { nodes } = await page.send("Accessibility.getFullAXTree");
  const named = nodes.filter(({ ignored, role }) =>
    !ignored && ["button", "combobox", "slider", "link", "application", "img", "image"].includes(role?.value));
  assert.ok(named.length > least, `${named.length} controls and pictures`);
  const poor = named.filter(({ name }) => !/[\p{L}\d]/u.test(name?.value ?? ""));
  return Promise.all(poor.map(async ({ backendDOMNodeId }) =>
    (await page.send("DOM.getOuterHTML", { backendNodeId: backendDOMNodeId })).outerHTML.slice(0, 200)));
}

export const pageChecks = [
  ["the page is not too large", async (page, { bytes }) => {
    assert.ok(bytes < kMostBytes, `${bytes} bytes`);
  }, "own"],

  ["the theme survives a reload", async (page, { url }) => {
    await page.go(url, "true");
    const paper = "getComputedStyle(document.body).backgroundColor";
    const light = await page.evaluate(paper);
    await page.evaluate("document.getElementById('theme').click()");
    const dark = await page.evaluate(paper);
    assert.notEqual(dark, light);
    await page.go(null, "true");
    assert.equal(await page.evaluate(paper), dark);
    await page.evaluate("localStorage.clear()");
  }, "own"],

  ["paper shows every section with all that is folded, without what needs a screen", async (page, { url }) => {
    await page.go(url, kReady);
    await page.evaluate("document.querySelector('#claims .filters button:last-child').click(), localStorage.clear()");
    await page.evaluate("dispatchEvent(new Event('beforeprint'))");
    await page.send("Emulation.setEmulatedMedia", { media: "print" });
    const shown = await page.evaluate(`${sections}.filter((s) => s.getBoundingClientRect().height > 0).map((s) => s.id)`);
    const all = await page.evaluate(`${sections}.map((s) => s.id)`);
    assert.ok(all.length >= 8);
    assert.deepEqual(shown, all.filter((id) => id !== "explorer"));
    assert.equal(await page.evaluate("document.querySelectorAll('details:not([open])').length"), 0);
    assert.ok(await page.evaluate(`${claims}.every((claim) => claim.getBoundingClientRect().height > 0)`), "a claim is missing");
    assert.ok(await page.evaluate("[...document.querySelectorAll('.robot')].every((robot) => robot.getBoundingClientRect().height > 0)"), "a robot is missing");
    assert.deepEqual(await page.evaluate("[...document.querySelectorAll('nav, button, input, select')].filter((e) => e.getClientRects().length).map((e) => e.outerHTML.slice(0, 100))"), []);
    await page.evaluate("document.documentElement.dataset.theme = 'dark'");
    assert.equal(await page.evaluate("getComputedStyle(document.body).backgroundColor"), "rgb(255, 255, 255)", "dark paper");
    const { data } = await page.send("Page.printToPDF", {});
    const pages = Buffer.from(data, "base64").toString("latin1").match(/\/Type \/Page\b/g) ?? [];
    assert.ok(pages.length > 5, `${pages.length} printed pages`);
  }, "own"],

  ["each filter shows the claims of its verdict alone", async (page) => {
    const fold = (open) => page.evaluate(`for (const fold of document.querySelectorAll("#claims > details")) fold.open = ${open}`);
    const verdicts = await page.evaluate("[...document.querySelectorAll('#claims .filters button')].map((button) => button.value)");
    assert.ok(verdicts.length > 1);
    await fold(true);
    for (const wanted of verdicts.reverse()) {  // all of them at last
      await page.evaluate(filter(wanted));
      for (const [verdict, shown] of await page.evaluate(`${claims}.map((claim) => [claim.dataset.verdict, claim.getBoundingClientRect().height > 0])`))
        assert.equal(shown, wanted === "" || verdict === wanted, `${wanted}: ${verdict}`);
    }
    await fold(false);
    await page.evaluate("localStorage.clear()");
  }, "phone"],

  ["a claim that the filter hides is shown for its address", async (page, { url }) => {
    await page.go(url, kReady);
    const verdict = await page.evaluate("document.querySelector('#claims .filters button:last-child').value");
    const id = await page.evaluate(`${claims}.find((claim) => claim.dataset.verdict !== "${verdict}").id`);
    const box = `document.getElementById("${id}").getBoundingClientRect()`;
    await page.evaluate(filter(verdict));
    assert.equal(await page.evaluate(`${box}.height`), 0);
    await page.evaluate(`location.hash = "${id}"`);
    await page.holds(`(({ top, height }) => height > 0 && top >= 0 && top < innerHeight)(${box})`);
    assert.ok(await page.evaluate(`${claims}.every((claim) => !claim.hidden)`));
    await page.evaluate(filter(verdict));
    await page.go(null, kReady);
    await page.evaluate("localStorage.clear()");
    assert.ok((await page.evaluate(`${box}.height`)) > 0);
  }, "own"],

  ["an address that is no text stops no script", async (page, { url }) => {
    await page.go(url + "#50%", kReady);
    assert.ok(await page.evaluate(`[...document.querySelectorAll("svg")].filter((svg) => svg.querySelector("animate"))
      .every((svg) => /^(Play|Pause)$/.test(svg.parentElement.previousElementSibling.textContent))`));
  }, "own"],

  ["the tiles of the verdicts hold their words, each beside its sign", async (page) => {
    const tiles = await page.evaluate(`[...document.querySelectorAll(".tile")].map((tile) => {
      const word = tile.querySelector("span").firstChild;
      const top = (at) => { const range = new Range(); range.setStart(word, at); range.setEnd(word, at + 1); return range.getBoundingClientRect().top; };
      return [word.data, Math.abs(top(0) - top(2)), tile.scrollWidth - tile.clientWidth]; })`);
    assert.equal(tiles.length, 5);
    for (const [word, apart, over] of tiles) assert.ok(apart < 3 && over <= 0, `${word}: ${apart} and ${over} pixels`);
  }, "desk"],

  ["every control says what it is", async (page) => {
    await page.evaluate("for (const fold of document.querySelectorAll('details')) fold.open = true");
    assert.deepEqual(await nameless(page, 100), []);
    await page.evaluate("for (const fold of document.querySelectorAll('details')) fold.open = false");
  }, "desk"],

  ["nothing is wider than a phone", async (page) => {
    const views = await page.evaluate("document.querySelectorAll('.explorer-bar .filters button').length");
    assert.ok(views > 1);
    for (let k = 0; k < views; ++k) {
      await page.evaluate(`document.querySelectorAll('.explorer-bar .filters button')[${k}].click()`);
      assert.ok(await page.evaluate("document.documentElement.scrollWidth <= document.documentElement.clientWidth"), `view ${k}`);
    }
    await page.evaluate("for (const fold of document.querySelectorAll('details')) fold.open = true");
    const wide = await page.evaluate(`(({ scrollWidth, clientWidth }) => scrollWidth <= clientWidth ? [] :
      [...document.querySelectorAll("main *")].filter((e) => e.getBoundingClientRect().right > clientWidth && e.parentElement.getBoundingClientRect().right <= clientWidth && !e.closest(".scroll *, svg"))
        .map((e) => e.tagName + " in " + e.closest("[id]").id))(document.documentElement)`);
    assert.deepEqual([...new Set(wide)], [], "with all folds open");
    await page.evaluate("for (const fold of document.querySelectorAll('details')) fold.open = false");
  }, "phone"],

  // Or it can't be read without a pointer.
  ["what scrolls within its box can be reached by the keyboard", async (page) => {
    const boxes = await page.evaluate(`[...document.querySelectorAll("main *")].filter((box) =>
      /auto|scroll/.test(getComputedStyle(box).overflow) && box.getBoundingClientRect().height > 0 &&
      (box.scrollWidth > box.clientWidth || box.scrollHeight > box.clientHeight + 1)).map((box) =>
      [box.className + " in " + box.closest("[id]").id, box.tabIndex >= 0 || !!box.querySelector("a[href], button, input, select, summary")])`);
    assert.ok(boxes.length > 3);
    assert.deepEqual([...new Set(boxes.filter(([, reached]) => !reached).map(([where]) => where))], []);
  }, "phone"],

  // With all folds closed, as it is opened.
  ["the page is not too long", async (page) => {
    const height = await page.evaluate("document.documentElement.scrollHeight");
    assert.ok(height < kMostHeight, `${height} pixels`);
  }, "desk"],

  ["without scripts the explorer says what it needs, and no button does nothing", async (page, { url }) => {
    await page.send("Emulation.setScriptExecutionDisabled", { value: true });
    await page.go(url, "true");
    const { root } = await page.send("DOM.getDocument", {});
    const boxes = async (selector) => {
      const { nodeId } = await page.send("DOM.querySelector", { nodeId: root.nodeId, selector });
      return page.send("DOM.getBoxModel", { nodeId }).then(() => true, () => false);
    };
    assert.equal(await boxes("#explorer-needs"), true);
    for (const idle of ["#explorer-app", "#theme", "#claims .filters"]) assert.equal(await boxes(idle), false, idle);
    const { nodeIds } = await page.send("DOM.querySelectorAll", { nodeId: root.nodeId, selector: "button, input, select" });
    for (const nodeId of nodeIds)
      assert.ok(await page.send("DOM.getBoxModel", { nodeId }).then(() => false, () => true),
        (await page.send("DOM.getOuterHTML", { nodeId })).outerHTML);
  }, "own"],
];
