// Unpacks the numbers of a report, which framework/report/packing.hpp packs.

// block: index of a block in the page, or the text of a block.
async function bytesOf(block) {
  const text = atob(typeof block === "string" ? block : document.getElementById(`block-${block}`).textContent);
  const packed = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) packed[i] = text.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Converts planes of bytes to the bytes of numbers.
function interleaved(planes, width) {
  const n = planes.length / width;
  const bytes = new Uint8Array(planes.length);
  for (let b = 0; b < width; ++b) for (let i = 0; i < n; ++i) bytes[i * width + b] = planes[b * n + i];
  return bytes.buffer;
}

const floats = (planes) => new Float32Array(interleaved(planes, 4));
const doubles = (planes) => new Float64Array(interleaved(planes, 8));

export const wholeNumbers = async (block) => Uint32Array.from(floats(await bytesOf(block)));

// Returns {columns, rows, of, get(name) -> numbers or undefined}.
export async function numberTable(table) {
  const bytes = await bytesOf(table.block);
  const wideBytes = 8 * table.rows * table.wide.length;
  const wide = doubles(bytes.subarray(0, wideBytes));
  const narrow = floats(bytes.subarray(wideBytes));
  const columns = new Map();
  let w = 0;
  let n = 0;
  table.columns.forEach((name, c) => {
    const isWide = table.wide.includes(c);
    const from = (isWide ? w++ : n++) * table.rows;
    columns.set(name, (isWide ? wide : narrow).subarray(from, from + table.rows));
  });
  return { columns: table.columns, rows: table.rows, of: table.of, get: (name) => columns.get(name) };
}

// Returns one array of codes per frame.
export async function codeFrames(block, count) {
  const bytes = await bytesOf(block);
  const n = bytes.length / 2 / count;
  const frames = [];
  for (let f = 0; f < count; ++f) {
    const low = bytes.subarray(2 * n * f, 2 * n * f + n);
    const high = bytes.subarray(2 * n * f + n, 2 * n * (f + 1));
    const now = new Uint16Array(n);
    const before = frames[f - 1];
    for (let i = 0; i < n; ++i) {
      const code = low[i] | (high[i] << 8);
      const difference = (code >>> 1) ^ -(code & 1);
      now[i] = (before ? before[i] : i > 0 ? now[i - 1] : 0) + difference;
    }
    frames.push(now);
  }
  return frames;
}

// Returns a function from codes to numbers; NaN for code 0.
export function numberOfCode({ lowest, highest, levels }) {
  const step = levels > 1 ? (highest - lowest) / (levels - 1) : 0;
  return (code) => (code === 0 ? NaN : lowest + step * (code - 1));
}
