// A robot's rigid parts and joints (the pack "robot-NAME"): where each part is for given joints. Frames are 3 x 4
// matrices in a list of 12, row after row: a rotation and, in the last column, the place in metres.
class RobotBody {
  constructor({ words, arrays }) {
    Object.assign(this, words);  // parts, joints (names, one a line), lower, upper, pen_part, pen_place, plane, half_side, pieces, places
    this.arrays = arrays;
  }

  // The frame of every part in that of part 0, which stands still. joints: rad or m.
  frames(joints) {
    const frames = [];
    for (const part of this.parts) {
      const below = frames[part.parent];
      if (!below) { frames.push(part.origin); continue; }
      const position = part.multiplier * joints[part.coordinate] + part.offset;
      frames.push(timesFrame(timesFrame(below, part.origin), part.slides ? shiftFrame(part.axis, position) : turnFrame(part.axis, position)));
    }
    return frames;
  }

  // The pen's point in space, and on the board: x and y in metres of the arm, and how far before the board, in metres
  // of the robot.
  penOf(frames) { return placeIn(frames[this.pen_part], this.pen_place); }
  onBoard(point) {
    const { origin, u, v, scale } = this.plane, away = point.map((value, k) => value - origin[k]);
    return { x: dot3(u, away) / scale, y: dot3(v, away) / scale, off: dot3(cross3(u, v), away) };
  }
  fromBoard(x, y, off = 0) {
    const { origin, u, v, scale } = this.plane, normal = cross3(u, v);
    return origin.map((value, k) => value + scale * (x * u[k] + y * v[k]) + off * normal[k]);
  }

  // Positions and normals of a piece, three numbers a vertex, and its triangles.
  surfaces() {
    const { position, normal, triangle } = this.arrays;
    let vertex = 0, corner = 0;
    return this.pieces.map((piece) => {
      const from = 3 * vertex, to = from + 3 * piece.vertices, scale = piece.high.map((high, k) => (high - piece.low[k]) / this.places);
      const surface = {
        ...piece,
        positions: Float32Array.from(position.values.subarray(from, to), (value, i) => piece.low[i % 3] + scale[i % 3] * value),
        normals: Float32Array.from(normal.values.subarray(from, to), (value) => (value - 128) / 127),
        corners: triangle.values.slice(corner, corner + 3 * piece.triangles),
      };
      vertex += piece.vertices;
      corner += 3 * piece.triangles;
      return surface;
    });
  }
}

const dot3 = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross3 = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const placeIn = (f, p) => [0, 4, 8].map((row) => f[row] * p[0] + f[row + 1] * p[1] + f[row + 2] * p[2] + f[row + 3]);

function timesFrame(a, b) {
  const product = [];
  for (let row = 0; row < 12; row += 4) {
    for (let column = 0; column < 4; ++column)
      product.push(a[row] * b[column] + a[row + 1] * b[column + 4] + a[row + 2] * b[column + 8]);
    product[row + 3] += a[row + 3];
  }
  return product;
}
const shiftFrame = (axis, by) => [1, 0, 0, by * axis[0], 0, 1, 0, by * axis[1], 0, 0, 1, by * axis[2]];
function turnFrame([x, y, z], angle) {
  const c = Math.cos(angle), s = Math.sin(angle), d = 1 - c;
  return [c + x * x * d, x * y * d - z * s, x * z * d + y * s, 0,
          y * x * d + z * s, c + y * y * d, y * z * d - x * s, 0,
          z * x * d - y * s, z * y * d + x * s, c + z * z * d, 0];
}
