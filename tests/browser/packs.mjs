// A second reader of the page's packs, from the file itself, as reports/page/pack.h describes them.
import { inflateSync } from "node:zlib";

const known = new Map();  // by their texts

export function packOf(html, name) {
  const opening = `<script type="text/plain" id="pack-${name}">`, at = html.indexOf(opening) + opening.length;
  const text = html.slice(at, html.indexOf("<", at));
  if (!known.has(text)) known.set(text, unpacked(inflateSync(Buffer.from(text, "base64"))));
  return known.get(text);
}

function unpacked(bytes) {
  const length = bytes.readUInt32LE(0), { words, arrays } = JSON.parse(bytes.toString("utf8", 4, 4 + length));
  const read = {};
  let begin = 4 + length;
  for (const { name: array, type, shape, delta } of arrays) {
    const n = shape.reduce((a, b) => a * b, 1), size = { u8: 1, u16: 2, i32: 4, f32: 4 }[type];
    const whole = Buffer.alloc(4 * n);
    for (let i = 0; i < n; ++i)
      for (let byte = 0; byte < size; ++byte) whole[4 * i + byte] = bytes[begin + byte * n + i];
    const values = [];
    for (let i = 0; i < n; ++i) {
      const bits = (whole.readUInt32LE(4 * i) + (delta > 0 && i >= delta ? values[i - delta] : 0)) % 2 ** (8 * size);
      values.push(bits);
    }
    values.forEach((bits, i) => whole.writeUInt32LE(bits, 4 * i));
    const as = (i) => (type === "f32" ? whole.readFloatLE(4 * i) : type === "i32" ? whole.readInt32LE(4 * i) : whole.readUInt32LE(4 * i));
    read[array] = { shape, values: values.map((_, i) => as(i)) };
    begin += n * size;
  }
  return { words, arrays: read };
}
