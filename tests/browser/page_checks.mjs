// The page as a whole.
import assert from "node:assert/strict";

const kMostBytes = 10e6, kMostHeight = 16000;
const sections = "[...document.querySelectorAll('main > section')]";

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
    await page.go(url, "!document.getElementById('explorer-app')?.hidden");
    await page.evaluate("dispatchEvent(new Event('beforeprint'))");
    await page.send("Emulation.setEmulatedMedia", { media: "print" });
    const shown = await page.evaluate(`${sections}.filter((s) => s.getBoundingClientRect().height > 0).map((s) => s.id)`);
    const all = await page.evaluate(`${sections}.map((s) => s.id)`);
    assert.ok(all.length >= 8);
    assert.deepEqual(shown, all.filter((id) => id !== "explorer"));
    assert.equal(await page.evaluate("document.querySelectorAll('details:not([open])').length"), 0);
    const { data } = await page.send("Page.printToPDF", {});
    assert.ok(data.length > 100_000, "the printed page is empty");
  }, "own"],

  ["every control says what it is", async (page) => {
    const { nodes } = await page.send("Accessibility.getFullAXTree");
    const controls = nodes.filter(({ ignored, role }) =>
      !ignored && ["button", "combobox", "slider", "link", "application", "img"].includes(role?.value));
    assert.ok(controls.length > 30);
    for (const { name, role, backendDOMNodeId } of controls)
      assert.ok(name?.value.trim(), `a ${role.value} has no name (node ${backendDOMNodeId})`);
  }, "desk"],

  ["nothing is wider than a phone", async (page) => {
    const views = await page.evaluate("document.querySelectorAll('.explorer-bar .filters button').length");
    for (let k = 0; k < views; ++k) {
      await page.evaluate(`document.querySelectorAll('.explorer-bar .filters button')[${k}].click()`);
      assert.ok(await page.evaluate("document.documentElement.scrollWidth <= innerWidth"), `view ${k}`);
    }
  }, "phone"],

  // Or it can't be read without a pointer.
  ["what scrolls within its box can be reached by the keyboard", async (page) => {
    const boxes = await page.evaluate(`[...document.querySelectorAll("main *")].filter((box) =>
      /auto|scroll/.test(getComputedStyle(box).overflow) && box.getBoundingClientRect().height > 0 &&
      (box.scrollWidth > box.clientWidth || box.scrollHeight > box.clientHeight + 1)).map((box) =>
      [box.className, box.tabIndex >= 0 || !!box.querySelector("a[href], button, input, select, summary")])`);
    assert.ok(boxes.length > 3);
    assert.deepEqual(boxes.filter(([, reached]) => !reached), []);
  }, "phone"],

  // With all folds closed, as it is opened.
  ["the page is not too long", async (page) => {
    const height = await page.evaluate("document.documentElement.scrollHeight");
    assert.ok(height < kMostHeight, `${height} pixels`);
  }, "desk"],

  ["without scripts the explorer says what it needs", async (page, { url }) => {
    await page.send("Emulation.setScriptExecutionDisabled", { value: true });
    await page.go(url, "true");
    const { root } = await page.send("DOM.getDocument", {});
    const boxes = async (selector) => {
      const { nodeId } = await page.send("DOM.querySelector", { nodeId: root.nodeId, selector });
      return page.send("DOM.getBoxModel", { nodeId }).then(() => true, () => false);
    };
    assert.equal(await boxes("#explorer-needs"), true);
    assert.equal(await boxes("#explorer-app"), false);
  }, "own"],
];
