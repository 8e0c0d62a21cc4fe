// The frames of a run: places of vertices, what they make up, and fields on them. They come in parts, each with ranges of its own; of a run that is under way
// there are more and more.
import { codeFrames, numberOfCode, wholeNumbers } from "./unpack.js";
import { words } from "./format.js";

const named = { velocity: "speed" };

export class Frames {
  static async of(data, scene) {
    const frames = new Frames();
    frames.origin = data.origin;
    frames.vertices = data.vertices;
    [frames.triangles, frames.edges, frames.points, frames.object] = await Promise.all(
      [data.triangles, data.edges, data.points, data.object].map(wholeNumbers));
    const count = frames.object.reduce((most, object) => Math.max(most, object + 1), 0);
    frames.objects = Array.from({ length: count }, (_, i) => scene?.objects[i] ?? { name: `object ${i}`, radius: null });
    frames.fields = data.fields.map(({ name, unit, magnitude, of }, index) => ({
      name, unit, index, lowest: Infinity, highest: -Infinity,
      label: magnitude ? named[name] ?? `${words(name)} (magnitude)` : words(name),
      ofVertices: of === "vertices",
    }));
    frames.list = []; // {time, part, at: its number in the part}
    await frames.append(data);
    return frames;
  }

  async append(data) {
    const part = { codes: await codeFrames(data.positions, data.times.length), place: numberOfCode(data), count: data.times.length,
      fields: data.fields.map((field) => ({ ...field, number: numberOfCode(field) })) };
    data.fields.forEach(({ lowest, highest }, f) => {
      this.fields[f].lowest = Math.min(this.fields[f].lowest, lowest);
      this.fields[f].highest = Math.max(this.fields[f].highest, highest);
    });
    this.list.push(...data.times.map((time, at) => ({ time, part, at })));
    this.written = data.written;
  }

  // Leaves every second one out, but not the last.
  thin() {
    this.list = this.list.filter((_, i) => (this.list.length - 1 - i) % 2 === 0);
  }

  get count() { return this.list.length; }
  get times() { return this.list.map(({ time }) => time); }
  get triangleCount() { return this.triangles.length / 3; }
  get edgeCount() { return this.edges.length / 2; }

  // Of a frame: x of all vertices, then y, then z, as codes, and the number of a code.
  codes(frame) { return this.list[frame].part.codes[this.list[frame].at]; }
  place(frame) { return this.list[frame].part.place; }

  // Of each frame {codes, number of a code}; unpacked when they are first asked for.
  async values(field) {
    const unpacked = new Map();
    for (const { part } of this.list)
      if (!unpacked.has(part)) unpacked.set(part, (part.fields[field.index].codes ??= codeFrames(part.fields[field.index].block, part.count)));
    for (const [part, codes] of unpacked) unpacked.set(part, await codes);
    return this.list.map(({ part, at }) => ({ codes: unpacked.get(part)[at], number: part.fields[field.index].number }));
  }

  // Smallest and largest coordinates in some frames, of some vertices; unless given, of all.
  box(numbers = this.list.keys(), vertices = null) {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (const number of numbers) {
      const [codes, place] = [this.codes(number), this.place(number)];
      for (let c = 0; c < 3; ++c) {
        const take = (v) => {
          const x = place(codes[c * this.vertices + v]);
          if (x < low[c]) low[c] = x;
          if (x > high[c]) high[c] = x;
        };
        if (vertices) vertices.forEach(take);
        else for (let v = 0; v < this.vertices; ++v) take(v);
      }
    }
    return { low, high };
  }

  // Those that elements of an object have.
  verticesOf(object) {
    const own = new Set();
    this.triangles.forEach((v, i) => { if (this.object[Math.floor(i / 3)] === object) own.add(v); });
    this.edges.forEach((v, i) => { if (this.object[this.triangleCount + Math.floor(i / 2)] === object) own.add(v); });
    this.points.forEach((v, i) => { if (this.object[this.triangleCount + this.edgeCount + i] === object) own.add(v); });
    return own;
  }
}
