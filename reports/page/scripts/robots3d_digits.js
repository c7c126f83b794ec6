// The digits of a replication and how a robot draws them: the arm's from the explorer's pack, another robot's from the
// pack "ways-ROBOT-RR".
async function readDigits(replication) {
  const { words, arrays } = await unpack("explorer-" + replication);
  const of = (name) => arrays["hbr/" + name]?.values;
  const points = words.layers.find(({ group }) => group === "layer1");
  const real = (name, { low, high, from, to }) => {
    const { values, shape: [, columns] } = arrays["layer1/" + name];
    return Float64Array.from(values, (value, i) => {
      const k = i % columns;
      return from[k] + (value - low) / (high - low) * (to[k] - from[k]);
    });
  };
  const joints = real("solution", points.genes), pen = real("measures", points.descriptor), id = [...of("id")];
  const strokes = arrays["hbr/points"].values, each = strokes.length / id.length;
  const count = id.map((_, row) => strokes.subarray(row * each, (row + 1) * each).reduce((sum, n) => sum + n, 0));
  return {
    replication, id, label: of("label"), good: of("good"), confidence: of("confidence"), image: of("image"),
    rowOf: new Map(id.map((value, row) => [value, row])),
    arm: waysOf(joints, points.genes.names.length, of("way"), count),
    penOf: waysOf(pen, 2, of("way"), count),
  };
}

// Function: a digit's row -> the rows of `table` (columns wide) along its way, as lists.
function waysOf(table, columns, way, count) {
  const first = [0];
  for (const n of count) first.push(first.at(-1) + n);
  return (row) => Array.from(way.subarray(first[row], first[row + 1]),
    (at) => Array.from(table.subarray(at * columns, (at + 1) * columns)));
}

// Of the arm `ways` is what readDigits() found; nothing is known of differences or servos.
async function readWays(robot, digits) {
  if (robot === "arm") return { way: digits.arm, smooth: () => false, absolute: () => null, servos: () => null };
  const { words, arrays } = await unpack(`ways-${robot}-${digits.replication}`);
  const values = (name) => arrays[name].values, { shape: [, columns] } = arrays.joints;
  const joints = Float64Array.from(values("joints"), (steps) => steps * words.step);
  return {
    way: waysOf(joints, columns, values("way"), [...values("points")]),
    smooth: (row) => values("smooth")[row] === 1,
    absolute: (row) => values("absolute")[row],
    // Whether servos replayed it, and what came of it.
    servos: (row) => {
      const bits = values("servos")[row];
      return bits ? { offBoard: Boolean(bits & 2), beyondLimit: Boolean(bits & 4), lost: Boolean(bits & 8) } : null;
    },
  };
}

// When a movement passes its postures, seconds: the pen keeps its pace, and no joint turns faster than `jointPace`.
function timesAlong(way, pen, pace = 0.2, jointPace = 1.5) {
  const times = [0];
  for (let k = 1; k < way.length; ++k) {
    const moved = Math.hypot(pen[k][0] - pen[k - 1][0], pen[k][1] - pen[k - 1][1]);
    const turned = Math.max(...way[k].map((value, j) => Math.abs(value - way[k - 1][j])));
    times.push(times[k - 1] + Math.max(moved / pace, turned / jointPace, 0.01));
  }
  return times;
}

// Of each class the good digit that the judge is surest of, or the surest where none is good; all rows without a judge.
function surestDigits({ id, label, good, confidence }) {
  if (!label) return id.slice(0, 10).map((_, row) => row);
  const best = new Map();
  id.forEach((_, row) => {
    const other = best.get(label[row]), worth = (r) => good[r] + confidence[r] / 2;
    if (other === undefined || worth(row) > worth(other)) best.set(label[row], row);
  });
  return [...best.entries()].sort(([a], [b]) => a - b).map(([, row]) => row);
}
