// Data that the page brings along: what reports/page/pack.h wrote into <script id="pack-NAME">, as
// words and arrays, each of them values with a shape. A pack is read once, when it is first asked for.
const unpacked = new Map();

function unpack(name) {
  if (!unpacked.has(name)) unpacked.set(name, inflate(document.getElementById("pack-" + name).textContent));
  return unpacked.get(name);
}

async function inflate(text) {
  const characters = atob(text), packed = new Uint8Array(characters.length);
  for (let i = 0; i < packed.length; ++i) packed[i] = characters.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const length = new DataView(bytes.buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  const arrays = {};
  let at = 4 + length;
  for (const { name, type, shape, delta } of header.arrays) {
    const n = shape.reduce((product, size) => product * size, 1);
    const values = packedValues(bytes, at, n, delta, type);
    arrays[name] = { shape, values };
    at += n * values.BYTES_PER_ELEMENT;
  }
  return { words: header.words, arrays };
}

// The bits of n values from their bytes, plane by plane, each added to the one `delta` before it.
function packedValues(bytes, at, n, delta, type) {
  const size = { u8: 1, u16: 2, i32: 4, f32: 4 }[type];
  const bits = new (size === 1 ? Uint8Array : size === 2 ? Uint16Array : Uint32Array)(n);
  for (let byte = 0; byte < size; ++byte)
    for (let i = 0; i < n; ++i) bits[i] |= bytes[at + byte * n + i] << (8 * byte);
  if (delta > 0) for (let i = delta; i < n; ++i) bits[i] += bits[i - delta];
  return type === "f32" ? new Float32Array(bits.buffer) : type === "i32" ? new Int32Array(bits.buffer) : bits;
}
