// The arm while it draws an elite: played, paused, and moved by hand to any of its postures.
class ArmPlayer {
  constructor() {
    this.canvas = element("canvas", { role: "img", "aria-label": "The arm while it draws" });
    this.box = element("div", { class: "arm" }, this.canvas);
    this.play = element("button", { type: "button", class: "play" }, "Play");
    this.scrub = element("input", { type: "range", min: "0", value: "0", step: "1", "aria-label": "Posture" });
    this.speed = element("select", { "aria-label": "Speed" },
      ...[["0.25", "¼ ×"], ["0.5", "½ ×"], ["1", "1 ×"], ["2", "2 ×"]].map(([value, text]) => element("option", { value }, text)));
    this.speed.value = "1";
    this.controls = element("div", { class: "player" }, this.play, this.scrub, this.speed);
    this.root = element("div", { class: "arm-player" }, this.box, this.controls);
    this.play.addEventListener("click", () => (this.playing ? this.pause() : this.start()));
    this.scrub.addEventListener("input", () => { this.pause(); this.at = Number(this.scrub.value); this.draw(); });
    new ResizeObserver(() => this.draw()).observe(this.box);
  }

  show(way, halfSide) {
    this.way = way;
    this.halfSide = halfSide;
    const last = way.arms.length - 1;
    this.at = last;
    this.scrub.max = String(Math.max(0, last));
    this.controls.hidden = last < 1;
    this.pause();
    if (last > 0 && !matchMedia("(prefers-reduced-motion: reduce)").matches) this.start();
    this.draw();
  }

  // A way takes about four seconds, a posture at most a third of one.
  get pace() { return Math.max(3, this.way.arms.length / 4) * Number(this.speed.value); }
  start() {
    if (this.at >= this.way.arms.length - 1) this.at = 0;
    this.playing = true;
    this.play.textContent = "Pause";
    let before = performance.now();
    const frame = (now) => {
      this.at = Math.min(this.at + ((now - before) / 1000) * this.pace, this.way.arms.length - 1);
      before = now;
      this.draw();
      if (this.at >= this.way.arms.length - 1) this.pause();
      else this.next = requestAnimationFrame(frame);
    };
    this.next = requestAnimationFrame(frame);
  }
  pause() {
    this.playing = false;
    cancelAnimationFrame(this.next);
    this.play.textContent = "Play";
  }

  draw() {
    const side = this.box.clientWidth;
    if (!this.way || side === 0) return;
    const paper = sharpCanvas(this.canvas, side, side), most = this.halfSide * 1.06;
    const xy = ([x, y]) => [(x / most + 1) * side / 2, (1 - y / most) * side / 2];
    const line = (points, from, to) => {
      paper.beginPath();
      for (let k = from; k < to; ++k) paper.lineTo(...xy(points[k]));
      paper.stroke();
    };
    const { arms, pen, starts } = this.way, now = Math.floor(this.at), last = arms.length - 1;
    this.scrub.value = String(now);
    this.scrub.setAttribute("aria-valuetext", `posture ${now + 1} of ${arms.length}`);
    paper.strokeStyle = themeColour("faint");
    const [left, top] = xy([-this.halfSide, this.halfSide]), [right, bottom] = xy([this.halfSide, -this.halfSide]);
    paper.strokeRect(left, top, right - left, bottom - top);
    paper.lineJoin = paper.lineCap = "round";
    paper.lineWidth = 2;
    starts.forEach((from, k) => {
      const to = starts[k + 1] ?? last + 1;
      paper.strokeStyle = themeColour("faint");
      line(pen, from, to);
      paper.strokeStyle = themeColour("vermilion");
      line(pen, from, Math.min(to, now + 1));
    });
    const arm = arms[now];
    if (!arm) return;
    paper.strokeStyle = themeColour("blue");
    paper.lineWidth = 4;
    line(arm, 0, arm.length);
    paper.fillStyle = themeColour("card");
    paper.lineWidth = 1.5;
    for (const joint of arm.slice(0, -1)) this.dot(paper, xy(joint), 3.5, true);
    paper.fillStyle = themeColour("vermilion");
    this.dot(paper, xy(arm.at(-1)), 4, false);
  }
  dot(paper, [x, y], radius, outlined) {
    paper.beginPath();
    paper.arc(x, y, radius, 0, 7);
    paper.fill();
    if (outlined) paper.stroke();
  }
}
