// A robot by itself: it turns until somebody takes hold of the picture, and a slider moves each of its joints.
class RobotView {
  constructor(root, body, { THREE, OrbitControls }) {
    Object.assign(this, { body, turning: false });
    const find = (name) => root.querySelector(`[data-robot="${name}"]`);
    this.canvas = find("canvas");
    this.turn = find("turn");
    this.scene = new RobotScene(this.canvas, THREE, OrbitControls);
    this.scene.show(body);
    this.joints = this.rest = body.lower.map((low, k) => Math.min(Math.max(0, low), body.upper[k]));
    find("joints").replaceChildren(...body.joints.split("\n").map((name, k) => this.slider(name, k)));
    this.turn.addEventListener("click", () => (this.turning ? this.stop() : this.start()));
    find("reset").addEventListener("click", () => this.reset());
    this.canvas.addEventListener("pointerdown", () => this.stop());
    this.canvas.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.scene.resize()).observe(this.canvas);
    this.scene.resize();
    this.scene.resetView();
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) this.start();
  }

  slider(name, k) {
    const { lower, upper, parts } = this.body, unit = parts.some((part) => part.coordinate === k && part.slides) ? "m" : "rad";
    const range = element("input", { type: "range", min: lower[k], max: upper[k], step: "any", value: this.joints[k] });
    const told = element("output", {});
    const tell = () => {
      told.textContent = `${Number(range.value).toFixed(2)} ${unit}`;
      range.setAttribute("aria-valuetext", told.textContent);
    };
    range.addEventListener("input", () => {
      this.joints = this.joints.map((value, j) => (j === k ? Number(range.value) : value));
      tell();
      this.scene.pose(this.joints);
      this.scene.draw();
    });
    range.tell = tell;
    tell();
    return element("label", {}, element("span", {}, name), range, told);
  }

  reset() {
    this.joints = this.rest;
    [...document.querySelectorAll('[data-robot="joints"] input')].forEach((range, k) => { range.value = this.rest[k]; range.tell(); });
    this.scene.pose(this.joints);
    this.scene.resetView();
    this.scene.draw();
  }

  start() {
    this.turning = true;
    this.turn.textContent = "Stop";
    let before = null;
    const frame = (now) => {
      if (before !== null) this.scene.orbit(Math.min(now - before, 100) / 1000 * 0.5, 0, 0);
      before = now;
      this.next = requestAnimationFrame(frame);
    };
    this.next = requestAnimationFrame(frame);
  }
  stop() {
    this.turning = false;
    cancelAnimationFrame(this.next);
    this.turn.textContent = "Turn";
  }

  key(event) {
    const turns = { "ArrowLeft": [-0.12, 0, 0], "ArrowRight": [0.12, 0, 0], "ArrowUp": [0, 0.1, 0], "ArrowDown": [0, -0.1, 0],
                    "+": [0, 0, 0.1], "=": [0, 0, 0.1], "-": [0, 0, -0.1] }[event.key];
    if (!turns || event.ctrlKey || event.metaKey || event.altKey) return;
    this.stop();
    this.scene.orbit(...turns);
    event.preventDefault();
  }
}

(async () => {
  const root = document.getElementById("robot");
  if (!document.getElementById("pack-three")) return;
  root.hidden = false;
  try {
    root.view = new RobotView(root, new RobotBody(await unpack("robot-shown")), await importThree());
  } catch (error) {
    root.replaceChildren(element("p", { class: "absent" }, `The robot cannot be shown in three dimensions here: ${error.message}`));
  }
})();
