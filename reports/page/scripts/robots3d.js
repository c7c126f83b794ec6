// Robots that draw the digits in three dimensions: which robot, which digit, and how far it has drawn. Other scripts
// choose a digit by the event "hbr-digit" (detail: the replication's name, and id), an address by #hbr/REP/ID, where REP
// counts the explorer's replications, which may be more than those that all robots have.
class RobotPlayer {
  constructor(root, index) {
    Object.assign(this, { root, index, robot: index.robots[0].name, replication: index.replications[0], at: 0, playing: false });
    const find = (name) => root.querySelector(`[data-r3="${name}"]`);
    this.parts = Object.fromEntries(["canvas", "robot", "replication", "digits", "previous", "next", "which", "play", "scrub",
      "speed", "reset", "facts", "state"].map((name) => [name, find(name)]));
    const { robot, replication, previous, next, play, scrub, reset } = this.parts;
    robot.append(...index.robots.map(({ name, title }) => new Option(title, name)));
    replication.append(...index.replications.map((name) => new Option(String(Number(name)), name)));
    replication.closest("label").hidden = index.replications.length < 2;
    robot.addEventListener("change", () => this.choose({ robot: robot.value }));
    replication.addEventListener("change", () => this.choose({ replication: replication.value, row: null }));
    previous.addEventListener("click", () => this.step(-1));
    next.addEventListener("click", () => this.step(1));
    play.addEventListener("click", () => (this.playing ? this.pause() : this.play()));
    scrub.addEventListener("input", () => { this.pause(); this.moveTo(Number(scrub.value) / 1000 * this.duration); });
    reset.addEventListener("click", () => { this.scene.resetView(); this.scene.draw(); });
    this.parts.canvas.addEventListener("keydown", (event) => this.key(event));
  }

  async open({ THREE, OrbitControls }) {
    this.scene = new RobotScene(this.parts.canvas, THREE, OrbitControls);
    this.bodies = new Map();
    new ResizeObserver(() => this.scene.resize()).observe(this.parts.canvas);
    addEventListener("hbr-digit", ({ detail }) => this.chooseDigit(detail.replication, detail.id));
    addEventListener("hashchange", () => this.followAddress());
    if (!(await this.followAddress())) await this.choose({});
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) this.play();
  }

  async followAddress() {
    const [, replication, id] = location.hash.match(/^#hbr\/(\d+)\/(\d+)$/) ?? [];
    if (replication === undefined) return false;
    return this.chooseDigit((await unpack("explorer")).words.replications[Number(replication)], Number(id));
  }
  async chooseDigit(replication, id) {
    if (!this.index.replications.includes(replication)) return false;
    const row = (await readDigits(replication)).rowOf.get(id);
    if (row === undefined) return false;
    await this.choose({ replication, row });
    return true;
  }

  // Another robot, replication or digit; what is not named stays. Without a row the surest digit is shown.
  async choose({ robot = this.robot, replication = this.replication, row = this.row }) {
    const asked = (this.asked = {});  // what is asked for last counts
    if (!this.bodies.has(robot)) this.bodies.set(robot, new RobotBody(await unpack("robot-" + robot)));
    const digits = this.digits?.replication === replication ? this.digits : await readDigits(replication);
    const ways = await readWays(robot, digits);
    if (asked !== this.asked) return;
    if (digits !== this.digits) this.surest = surestDigits(digits);
    const body = this.bodies.get(robot);
    Object.assign(this, { robot, replication, digits, ways, row: row ?? this.firstRow(digits) });
    this.parts.robot.value = robot;
    this.parts.replication.value = replication;
    if (this.scene.body !== body) { this.scene.show(body); this.scene.resize(); this.scene.resetView(); }
    this.load();
  }
  // The surest digit that is neither 0 nor 1, which are too plain.
  firstRow({ label, good, confidence }) {
    const worth = (row) => (label && label[row] > 1 ? 1 : 0) + (good ? good[row] + confidence[row] / 2 : 0);
    return [...this.surest].sort((a, b) => worth(b) - worth(a))[0];
  }
  step(by) {
    const n = this.digits.id.length;
    this.choose({ row: (this.row + by + n) % n });
  }

  // The way of the present digit: postures, where they put the pen, and when.
  load() {
    const { body } = this.scene;
    this.way = this.ways.way(this.row);
    this.pens = this.way.map((joints) => body.onBoard(body.penOf(body.frames(joints))));
    const pen = this.pens.map(({ x, y }) => [x, y]);
    this.times = timesAlong(this.way, pen);
    this.duration = this.times.at(-1);
    this.scene.setStrokes(this.digits.penOf(this.row), pen);
    this.showDigits();
    this.showFacts();
    this.moveTo(this.playing ? 0 : this.duration);
  }

  play() {
    if (!(this.duration > 0)) return;
    if (this.at >= this.duration) this.at = 0;
    this.playing = true;
    this.parts.play.textContent = "Pause";
    let before = null;
    const frame = (now) => {
      const passed = before === null || !this.visible ? 0 : Math.min((now - before) / 1000, 0.1);
      before = now;
      if (passed > 0) this.moveTo(Math.min(this.at + passed * Number(this.parts.speed.value), this.duration));
      if (this.at >= this.duration) this.pause();
      else this.next = requestAnimationFrame(frame);
    };
    this.next = requestAnimationFrame(frame);
  }
  pause() {
    this.playing = false;
    cancelAnimationFrame(this.next);
    this.parts.play.textContent = "Play";
  }

  // Shows the robot as it is `at` seconds from its start.
  moveTo(at) {
    this.at = at;
    let k = 0;
    while (k + 2 < this.times.length && this.times[k + 1] <= at) ++k;
    const to = this.way[k + 1] ?? this.way[k], span = this.times[k + 1] - this.times[k];
    const share = span > 0 ? Math.min(Math.max((at - this.times[k]) / span, 0), 1) : 0;
    this.joints = this.way[k].map((value, j) => value + share * (to[j] - value));
    this.frames = this.scene.pose(this.joints);
    this.scene.reveal(share >= 1 ? this.way.length : k + 1);
    this.scene.draw();
    const { scrub, state } = this.parts, { off } = this.scene.body.onBoard(this.scene.body.penOf(this.frames));
    scrub.value = String(Math.round(this.duration > 0 ? 1000 * at / this.duration : 1000));
    const words = `${at.toFixed(1)} of ${this.duration.toFixed(1)} s, posture ${k + 1 + Math.round(share)} of ${this.way.length}`;
    scrub.setAttribute("aria-valuetext", words);
    state.textContent = `${words}; pen ${(1000 * Math.abs(off)).toFixed(1)} mm off the board`;
  }

  showDigits() {
    const { digits, which } = this.parts;
    if (digits.dataset.of !== this.replication) {
      digits.dataset.of = this.replication;
      digits.replaceChildren(...this.surest.map((row) => {
        const button = element("button", { type: "button", value: String(row), "aria-label": `Digit ${this.digits.id[row]}` +
          (this.digits.label ? `, a ${this.digits.label[row]}` : "") }, this.thumbnail(row));
        button.addEventListener("click", () => this.choose({ row }));
        return button;
      }));
    }
    for (const button of digits.children) button.setAttribute("aria-pressed", String(Number(button.value) === this.row));
    which.textContent = `${this.row + 1} of ${this.digits.id.length}`;
  }
  thumbnail(row) {
    const pen = this.digits.penOf(row), xs = pen.map(([x]) => x), ys = pen.map(([, y]) => y);
    const left = Math.min(...xs), top = Math.max(...ys), side = Math.max(Math.max(...xs) - left, top - Math.min(...ys)) || 1;
    const shift = (side - (Math.max(...xs) - left)) / 2;
    const canvas = element("canvas", { class: "ink", width: "64", height: "64", "aria-hidden": "true" });
    const paper = canvas.getContext("2d");
    paper.lineWidth = 5;
    paper.lineCap = paper.lineJoin = "round";
    for (const [x, y] of pen) paper.lineTo(9 + 46 * (x - left + shift) / side, 9 + 46 * (top - y) / side);
    paper.stroke();
    return canvas;
  }

  showFacts() {
    const { label, good, confidence, id } = this.digits, { row } = this, facts = [["Digit", String(id[row])]];
    if (label) facts.push(["Judge", `${label[row]}, ${good[row] ? "good" : "not good"}; confidence ${confidence[row].toFixed(2)}`]);
    const difference = this.ways.absolute(row);
    if (difference !== null) facts.push(["Pixel difference from the arm’s", `${(100 * difference).toFixed(2)} %`]);
    const { lower, upper } = this.scene.body, slack = 1e-5;
    const beyond = this.way.some((joints) => joints.some((q, k) => q < lower[k] - slack || q > upper[k] + slack));
    facts.push(["Joints", beyond ? "beyond their limits" : "within their limits"]);
    if (this.robot !== "arm") facts.push(["Postures", this.ways.smooth(row) ? "as little turning as can be" : "as layer 1 has each place"]);
    const servos = this.ways.servos(row);
    if (servos) {
      const faults = [servos.offBoard && "leave the board", servos.beyondLimit && "ask a joint for too much", servos.lost && "read otherwise"].filter(Boolean);
      facts.push(["Replayed by servos", faults.length ? faults.join(", ") : "on the board, within all limits" + (good?.[row] ? ", read as before" : "")]);
    }
    this.parts.facts.replaceChildren(...facts.map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value))));
  }

  key(event) {
    const turns = { "ArrowLeft": [-0.12, 0, 0], "ArrowRight": [0.12, 0, 0], "ArrowUp": [0, 0.1, 0], "ArrowDown": [0, -0.1, 0],
                    "+": [0, 0, 0.1], "=": [0, 0, 0.1], "-": [0, 0, -0.1] }[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (turns) this.scene.orbit(...turns);
    else if (event.key === " ") this.playing ? this.pause() : this.play();
    else if (event.key === "Home") { this.scene.resetView(); this.scene.draw(); }
    else return;
    event.preventDefault();
  }
}

// The viewer begins when it comes near the screen, and rests while it is off it.
function openRobots() {
  const root = document.getElementById("robots3d");
  if (!root || !document.getElementById("pack-three")) return;
  root.hidden = false;
  let begun = false, visible = false, player = null;
  new IntersectionObserver(async (entries) => {
    visible = entries.at(-1).isIntersecting;
    if (player) player.visible = visible;
    if (!visible || begun) return;
    begun = true;
    try {
      player = new RobotPlayer(root, (await unpack("robots3d")).words);
      player.visible = visible;
      root.player = player;
      await player.open(await importThree());
      linkSelectors(player);
    } catch (error) {
      root.replaceChildren(element("p", { class: "absent" }, `The robots cannot be shown in three dimensions here: ${error.message}`));
    }
  }, { rootMargin: "300px" }).observe(root);
}

// The figures below are those of the robot that is shown.
function linkSelectors(player) {
  const buttons = [...document.querySelectorAll("#robots .filters button")];
  const own = (name) => buttons.find((button) => button.value === "robot-" + name);
  player.parts.robot.addEventListener("change", () => own(player.parts.robot.value)?.click());
  for (const { name } of player.index.robots)
    own(name)?.addEventListener("click", () => { if (player.robot !== name) player.choose({ robot: name }); });
}

openRobots();
