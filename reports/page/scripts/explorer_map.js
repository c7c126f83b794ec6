// A map of a layer's elites on a canvas: two coordinates of their descriptors as places, a quantity as colour,
// images where there are some.
class EliteMap {
  // `hover` is told of the place under the pointer in descriptor units, or null; `choose` of an elite's row;
  // `step` of an arrow key's direction.
  constructor(layer, { hover, choose, step }) {
    Object.assign(this, { layer, axes: [0, 1], visible: [], selected: null, twin: null, cursor: null });
    this.canvas = element("canvas", { "aria-hidden": "true" });
    this.box = element("div", { class: "map", tabindex: "0", role: "application",
      "aria-label": `Map of ${layer.title.toLowerCase()}: arrow keys move to neighbours` }, this.canvas);
    this.count = element("span", { class: "place" });
    this.root = element("figure", { class: "elite-map" },
      element("figcaption", {}, element("b", {}, layer.title), " ", element("code", {}, layer.layer), " ", this.count),
      this.box);
    this.box.addEventListener("pointermove", (event) => hover(this.placeAt(event)));
    this.box.addEventListener("pointerleave", () => hover(null));
    this.box.addEventListener("click", (event) => {
      const row = this.nearest(...this.placeAt(event));
      if (row !== null) choose(row);
    });
    this.box.addEventListener("keydown", (event) => {
      const direction = { "ArrowLeft": [-1, 0], "ArrowRight": [1, 0], "ArrowUp": [0, 1], "ArrowDown": [0, -1] }[event.key];
      if (!direction || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      const row = this.neighbour(direction);
      if (row !== null) step(row);
    });
    new ResizeObserver(() => this.draw()).observe(this.box);
  }

  show({ axes, visible, scale }) {
    Object.assign(this, { axes, visible, scale, sprites: null });
    this.count.textContent = visible.length === this.layer.size ? `${shortNumber(this.layer.size)} elites`
      : `${shortNumber(visible.length)} of ${shortNumber(this.layer.size)} elites`;
    this.draw();
  }

  // Between descriptor units and pixels of the page.
  get margin() { return { left: 52, right: 10, top: 10, bottom: 34 }; }
  get plot() {
    const { left, right, top, bottom } = this.margin;
    return { x: left, y: top, w: this.box.clientWidth - left - right, h: this.box.clientHeight - top - bottom };
  }
  // Who asks for many places measures the plot once.
  xy(place, { x, y, w, h } = this.plot) {
    const share = place.map((value, k) => {
      const [low, high] = this.layer.range(this.axes[k]);
      return (value - low) / (high - low);
    });
    return [x + share[0] * w, y + (1 - share[1]) * h];
  }
  placeAt(event) {
    const { x, y, w, h } = this.plot, box = this.box.getBoundingClientRect();
    const share = [(event.clientX - box.left - x) / w, 1 - (event.clientY - box.top - y) / h];
    return share.map((value, k) => {
      const [low, high] = this.layer.range(this.axes[k]);
      return low + value * (high - low);
    });
  }
  place(row) { return this.axes.map((d) => this.layer.place(row, d)); }

  nearest(...place) {
    const { plot } = this, [x, y] = this.xy(place, plot);
    let best = null, least = Infinity;
    for (const row of this.visible) {
      const [u, v] = this.xy(this.place(row), plot), distance = (u - x) ** 2 + (v - y) ** 2;
      if (distance < least) [best, least] = [row, distance];
    }
    return best;
  }
  // The nearest elite within 45 degrees of a direction, or else in that half of the map.
  neighbour([dx, dy]) {
    if (this.selected === null) return this.visible[0] ?? null;
    const { plot } = this, [x, y] = this.xy(this.place(this.selected), plot);
    let best = null, least = Infinity;
    for (const row of this.visible) {
      const [u, v] = this.xy(this.place(row), plot), ahead = (u - x) * dx - (v - y) * dy;
      const aside = Math.abs((u - x) * dy + (v - y) * dx);
      const distance = Math.hypot(ahead, aside) + (aside > ahead ? 1e6 : 0);
      if (row !== this.selected && ahead > 0.01 && distance < least) [best, least] = [row, distance];
    }
    return best;
  }

  draw() {
    const { clientWidth: width, clientHeight: height } = this.box;
    if (!this.scale || width === 0) return;
    const paper = sharpCanvas(this.canvas, width, height);
    this.drawAxes(paper);
    if (this.layer.draws) this.drawImages(paper, width);
    else this.drawPoints(paper);
    this.drawMarks(paper, width, height);
  }
  drawAxes(paper) {
    const { x, y, w, h } = this.plot;
    paper.strokeStyle = themeColour("faint");
    paper.strokeRect(x - 0.5, y - 0.5, w + 1, h + 1);
    paper.fillStyle = themeColour("soft");
    paper.font = "12px " + getComputedStyle(this.box).fontFamily;
    const label = (d) => this.layer.descriptor.names[d] + (this.layer.descriptor.units[d] ? `, ${this.layer.descriptor.units[d]}` : "");
    const ends = this.axes.map((d) => this.layer.range(d));
    const text = (what, at, up, align) => { paper.textAlign = align; paper.fillText(what, at, up); };
    text(shortNumber(ends[0][0]), x, y + h + 16, "left");
    text(shortNumber(ends[0][1]), x + w, y + h + 16, "right");
    text(label(this.axes[0]), x + w / 2, y + h + 28, "center");
    if (this.axes[1] >= this.layer.dimensions) return;
    text(shortNumber(ends[1][0]), x - 5, y + h, "right");
    text(shortNumber(ends[1][1]), x - 5, y + 10, "right");
    paper.save();
    paper.translate(12, y + h / 2);
    paper.rotate(-Math.PI / 2);
    text(label(this.axes[1]), 0, 0, "center");
    paper.restore();
  }
  drawPoints(paper) {
    const radius = this.layer.size > 800 ? 2.2 : 3, { plot } = this, { of } = this.layer.quantity(this.scale.key);
    for (const row of this.visible) {
      const [x, y] = this.xy(this.place(row), plot);
      paper.fillStyle = this.scale.colour(of(row));
      paper.beginPath();
      paper.arc(x, y, radius, 0, 7);
      paper.fill();
    }
  }
  // The digits themselves in their colours.
  drawImages(paper, width) {
    const side = Math.round(Math.min(26, Math.max(15, width / 19))), { plot } = this;
    this.sprites ??= new Map(this.visible.map((row) => [row, tinted(this.layer.of("image").values, row,
      this.scale.colour(this.layer.quantity(this.scale.key).of(row)))]));
    for (const row of this.visible) {
      const [x, y] = this.xy(this.place(row), plot);
      paper.drawImage(this.sprites.get(row), x - side / 2, y - side / 2, side, side);
    }
  }
  drawMarks(paper, width, height) {
    paper.strokeStyle = themeColour("ink");
    const near = this.cursor && this.nearest(...this.cursor);
    if (this.layer.kind === "points") this.drawPosture(paper, near ?? this.selected);
    if (this.cursor) {
      const [x, y] = this.xy(this.cursor);
      paper.globalAlpha = 0.35;
      paper.beginPath();
      paper.moveTo(x, 0); paper.lineTo(x, height);
      paper.moveTo(0, y); paper.lineTo(width, y);
      paper.stroke();
      paper.globalAlpha = 1;
      if (near !== null) this.ring(paper, near, 1, []);
    }
    if (this.twin !== null) this.ring(paper, this.twin, 2, [4, 3]);
    if (this.selected !== null) this.ring(paper, this.selected, 2.5, []);
    if (this.cursor && near !== null && this.layer.draws) this.drawCloser(paper, near, width);
  }
  // A digit that the pointer is at, large enough to be read.
  drawCloser(paper, row, width) {
    const [x, y] = this.xy(this.place(row)), side = 72;
    const left = x + 20 + side > width ? x - 20 - side : x + 20, top = Math.max(4, y - 20 - side);
    paper.fillStyle = themeColour("card");
    paper.fillRect(left, top, side, side);
    paper.strokeRect(left + 0.5, top + 0.5, side - 1, side - 1);
    paper.drawImage(this.sprites.get(row), left, top, side, side);
  }
  // The map of points is the drawing area itself.
  drawPosture(paper, row) {
    if (row === null || !this.layer.robot.links) return;
    paper.save();
    paper.lineJoin = paper.lineCap = "round";
    paper.beginPath();
    for (const joint of this.layer.way(row).arms[0]) paper.lineTo(...this.xy(joint));
    for (const [colour, width] of [["card", 7], ["ink", 3]]) {
      paper.strokeStyle = themeColour(colour);
      paper.lineWidth = width;
      paper.stroke();
    }
    paper.restore();
  }
  ring(paper, row, width, dash) {
    const [x, y] = this.xy(this.place(row));
    paper.lineWidth = width;
    paper.setLineDash(dash);
    paper.beginPath();
    paper.arc(x, y, this.layer.draws ? 15 : 8, 0, 7);
    paper.stroke();
    paper.setLineDash([]);
    paper.lineWidth = 1;
  }
}

// A canvas of the screen's own resolution, empty; pixels are those of the page.
function sharpCanvas(canvas, width, height) {
  const ratio = devicePixelRatio || 1, paper = canvas.getContext("2d");
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  paper.setTransform(ratio, 0, 0, ratio, 0, 0);
  return paper;
}

// Image `row` of many 28 x 28 ones, ink in a colour, as a canvas.
function tinted(images, row, colour) {
  const canvas = element("canvas", { width: "28", height: "28" }), paper = canvas.getContext("2d");
  const pixels = paper.createImageData(28, 28), [r, g, b] = colour.startsWith("#") ? rgb(colour) : colour.match(/\d+/g).map(Number);
  for (let p = 0; p < 784; ++p) pixels.data.set([r, g, b, images[row * 784 + p]], 4 * p);
  paper.putImageData(pixels, 0, 0);
  return canvas;
}
