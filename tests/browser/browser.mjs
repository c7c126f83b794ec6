// A browser over the DevTools protocol, through two pipes: messages end with a zero byte. Needs no packages.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export class Browser {
  static async start(program = "chromium") {
    const browser = new Browser();
    browser.profile = mkdtempSync(join(tmpdir(), "hbr-browser-"));
    browser.process = spawn(program, ["--headless=new", "--remote-debugging-pipe", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
      "--no-first-run", "--disable-dev-shm-usage", "--disable-background-networking", "--disable-extensions", "--mute-audio",
      `--user-data-dir=${browser.profile}`],
      { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"], detached: true });
    browser.listen();
    await browser.send("Browser.getVersion");
    return browser;
  }

  listen() {
    Object.assign(this, { next: 1, waiting: new Map(), pages: new Map(), rest: [] });
    this.process.stdio[4].on("data", (bytes) => {
      let begin = 0;
      for (let end = bytes.indexOf(0); end >= 0; end = bytes.indexOf(0, begin)) {
        const message = JSON.parse(Buffer.concat([...this.rest, bytes.subarray(begin, end)]).toString());
        this.rest = [];
        begin = end + 1;
        this.receive(message);
      }
      this.rest.push(bytes.subarray(begin));
    });
    this.process.on("error", (error) => this.fail(error));
    this.process.on("exit", () => this.fail(new Error("the browser ended")));
  }
  fail(error) {
    for (const { reject } of this.waiting.values()) reject(error);
    this.waiting.clear();
  }
  receive(message) {
    const waiting = this.waiting.get(message.id);
    if (!waiting) return this.pages.get(message.sessionId)?.hear(message);
    this.waiting.delete(message.id);
    if (message.error) waiting.reject(new Error(`${waiting.method}: ${message.error.message}`));
    else waiting.resolve(message.result);
  }
  send(method, params = {}, sessionId = undefined) {
    const id = this.next++;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { method, resolve, reject });
      this.process.stdio[3].write(JSON.stringify({ id, method, params, sessionId }) + "\0");
    });
  }

  async close() {
    const ended = new Promise((resolve) => this.process.once("exit", resolve));
    process.kill(-this.process.pid, "SIGKILL");  // its group: what it started writes into the profile, too
    await ended;
    rmSync(this.profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 100 });
  }

  async page() {
    const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
    const { sessionId } = await this.send("Target.attachToTarget", { targetId, flatten: true });
    const page = new Page(this, sessionId, targetId);
    this.pages.set(sessionId, page);
    for (const domain of ["Page", "Runtime", "Network", "Log"]) await page.send(domain + ".enable");
    return page;
  }
}

export class Page {
  constructor(browser, session, target) {
    // What went wrong, and what was asked for.
    Object.assign(this, { browser, session, target, faults: [], requests: [], loads: 0 });
  }
  send(method, params) { return this.browser.send(method, params, this.session); }
  close() { return this.browser.send("Target.closeTarget", { targetId: this.target }); }

  hear({ method, params }) {
    if (method === "Runtime.exceptionThrown")
      this.faults.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    if (method === "Runtime.consoleAPICalled" && ["error", "warning", "assert"].includes(params.type))
      this.faults.push(params.args.map((arg) => arg.value ?? arg.description).join(" "));
    if (method === "Log.entryAdded" && params.entry.level === "error") this.faults.push(params.entry.text);
    if (method === "Network.requestWillBeSent") this.requests.push(params.request.url);
    if (method === "Page.loadEventFired") ++this.loads;
  }

  // Goes to an address, or loads the present one again; until `ready`, an expression, holds.
  async go(url, ready) {
    const loads = this.loads;
    await (url ? this.send("Page.navigate", { url }) : this.send("Page.reload"));
    await this.until(() => this.loads > loads, "the page is loaded");
    await this.holds(ready);
  }
  async until(condition, what, seconds = 60) {
    const end = Date.now() + 1000 * seconds;
    while (!(await condition())) {
      if (Date.now() > end) throw new Error(`after ${seconds} s still not: ${what}`);
      await new Promise((resolve) => setTimeout(resolve, 20));
    }
  }
  holds(expression) { return this.until(() => this.evaluate(expression), expression); }

  async evaluate(expression) {
    const { result, exceptionDetails } = await this.send("Runtime.evaluate",
      { expression, awaitPromise: true, returnByValue: true, userGesture: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  size(width, height) {
    return this.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
  }
  media(features) {
    return this.send("Emulation.setEmulatedMedia", { features: Object.entries(features).map(([name, value]) => ({ name, value })) });
  }
  async click(x, y) {
    for (const type of ["mouseMoved", "mousePressed", "mouseReleased"])
      await this.send("Input.dispatchMouseEvent", { type, x, y, button: type === "mouseMoved" ? "none" : "left", clickCount: 1 });
  }
  async press(key) {
    const text = key === "Enter" ? "\r" : key === " " ? " " : undefined;
    const code = { Tab: 9, Enter: 13, " ": 32, ArrowLeft: 37, ArrowUp: 38, ArrowRight: 39, ArrowDown: 40, Home: 36, End: 35 }[key];
    for (const type of [text ? "keyDown" : "rawKeyDown", "keyUp"])
      await this.send("Input.dispatchKeyEvent", { type, key, code: key === " " ? "Space" : key, text, windowsVirtualKeyCode: code });
  }
  async picture(clip) {
    const { data } = await this.send("Page.captureScreenshot", { format: "png", ...(clip && { clip: { ...clip, scale: 1 }, captureBeyondViewport: true }) });
    return Buffer.from(data, "base64");
  }
}
