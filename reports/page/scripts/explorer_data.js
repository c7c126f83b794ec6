// The explorer's data: each layer of a replication, its values in the units that its attributes name.
const kNone = (values) => (values instanceof Uint16Array ? 65535 : -1);

// What is stored as `low` ... `high` in column c stands for from[c] ... to[c].
const inUnits = (columns, value, c) =>
  columns.from[c] + ((value - columns.low) / (columns.high - columns.low)) * (columns.to[c] - columns.from[c]);

class ExplorerLayer {
  constructor(words, arrays, points) {
    const of = (name) => arrays[`${words.group}/${name}`];
    Object.assign(this, words);
    this.points = points ?? this;  // layer 1, whose elites ways are made of
    this.of = of;
    this.id = of("id").values;
    this.parent = of("parent").values;
    this.size = this.id.length;
    this.rowOf = new Map(Array.from(this.id, (id, row) => [id, row]));
    this.dimensions = of("measures").shape[1];
    this.draws = Boolean(of("image"));
    this.quantities = this.listQuantities();
  }

  get title() {
    return { hbr: "Digits of the hierarchy", flat: "Flat digits" }[this.group]
      ?? this.kind[0].toUpperCase() + this.kind.slice(1).replaceAll("_", " ");
  }

  // A descriptor of one number has its elites in the middle of the other axis.
  place(row, d) {
    return d < this.dimensions ? inUnits(this.descriptor, this.of("measures").values[row * this.dimensions + d], d) : 0;
  }
  range(d) { return d < this.dimensions ? [this.descriptor.from[d], this.descriptor.to[d]] : [-1, 1]; }
  generation(row) { return Math.floor(this.id[row] / this.batch) + 1; }
  genome(row) {
    const { shape, values } = this.of("solution"), length = this.of("length")?.values[row] ?? shape[1];
    return Array.from({ length }, (_, g) => inUnits(this.genes, values[row * shape[1] + g], g));
  }
  children(row) { return [...this.parent.keys()].filter((child) => this.parent[child] === this.id[row]); }

  // What elites can be coloured and filtered by; `larger` says that the larger ones are the better ones. A cost is
  // what the fitness is minus of.
  listQuantities() {
    const all = [];
    const add = (key, name, unit, of, meaning = "", larger = false) =>
      all.push({ key, name, unit: unit.replaceAll("^2", "²"), of, meaning: meaning.replaceAll("^2", "²"), larger });
    const fitness = this.of("objective").values, { meaning, units } = this.fitness;
    const cost = meaning.replace(/^minus (the )?/, ""), sign = cost === meaning ? 1 : -1;
    if (this.draws) add("error", "network’s error", units, (row) => -fitness[row], cost);
    else if (fitness.some((value) => value !== fitness[0]))
      add("fitness", cost.length < 40 ? cost : sign < 0 ? "cost" : "fitness", units, (row) => sign * fitness[row], cost, sign > 0);
    const label = this.of("label")?.values, confidence = this.of("confidence")?.values,
          uncertainty = this.of("uncertainty")?.values;
    if (label) add("class", "class", "", (row) => label[row], "as the judge reads it");
    if (confidence) add("confidence", "judge’s confidence", "", (row) => confidence[row]);
    if (uncertainty) add("uncertainty", "uncertainty", "of the range", (row) => uncertainty[row],
      "mean distance of the samples from the descriptor");
    for (let d = 2; d < this.dimensions; ++d)
      add("measure" + d, this.descriptor.names[d], this.descriptor.units[d], (row) => this.place(row, d));
    add("birth", "birth", "generation", (row) => this.generation(row));
    return all;
  }
  quantity(key) { return this.quantities.find((quantity) => quantity.key === key); }

  // Postures and pen positions of an elite in order, and where each stroke begins.
  way(row) {
    if (this.of("way")) return this.points.through(...this.storedWay(row));
    if (this.of("stops")) return this.points.through(...this.storedStops(row));
    return this.kind === "points" ? this.through([row], [0]) : this.ownWay(row);
  }
  storedWay(row) {
    const { shape: [, strokes], values: lengths } = this.of("points");
    this.firsts ??= lengths.reduce((ends, n) => { ends.push(ends.at(-1) + n); return ends; }, [0]);
    const begin = this.firsts[row * strokes];
    const starts = Array.from({ length: strokes }, (_, k) => this.firsts[row * strokes + k] - begin);
    return [this.of("way").values.subarray(begin, this.firsts[(row + 1) * strokes]), starts];
  }
  storedStops(row) {
    const { shape: [, executions, stops], values } = this.of("stops"), rows = [], starts = [];
    for (let e = 0; e < executions; ++e) {
      starts.push(rows.length);
      for (let k = 0; k < stops; ++k) {
        const stop = values[(row * executions + e) * stops + k];
        if (stop !== kNone(values)) rows.push(stop);
      }
    }
    return [rows, starts];
  }
  // Of layer 1: through these of its elites, whose genes are the joint angles.
  through(rows, starts) { return this.posed(Array.from(rows, (row) => this.genome(row)), starts); }
  // A flat genome: the pen's width, then configurations of all joints.
  ownWay(row) {
    const joints = this.robot.links.length, genome = this.genome(row), postures = [];
    if (this.start === "straight_arm") postures.push(new Array(joints).fill(0));
    for (let at = genome.length % joints; at + joints <= genome.length; at += joints) {
      const from = postures.at(-1), to = genome.slice(at, at + joints);
      const steps = this.pen === "joints" && from ? 8 : 1;
      for (let s = 1; s < steps; ++s)
        postures.push(to.map((angle, joint) => from[joint] + ((angle - from[joint]) * s) / steps));
      postures.push(to);
    }
    return this.posed(postures, [0]);
  }
  posed(postures, starts) {
    const arms = postures.map((angles) => armAt(this.robot.links, angles));
    return { arms, pen: arms.map((arm) => arm.at(-1)), starts };
  }
}

// Base, joints and tip of the planar arm, m.
function armAt(links, angles) {
  const arm = [[0, 0]];
  let turned = 0;
  links.forEach((link, joint) => {
    const [x, y] = arm.at(-1);
    turned += angles[joint];
    arm.push([x + link * Math.cos(turned), y + link * Math.sin(turned)]);
  });
  return arm;
}

// All layers of a replication by their groups.
async function readExplorer(replication) {
  const { words, arrays } = await unpack("explorer-" + replication);
  const robot = { links: words.links, halfSide: words.half_side }, layers = new Map();
  let points;
  for (const layer of [...words.layers].sort((a, b) => b.group.startsWith("layer1") - a.group.startsWith("layer1"))) {
    layers.set(layer.group, new ExplorerLayer({ ...layer, robot }, arrays, points));
    points ??= layers.get(layer.group);
  }
  return layers;
}
