// The frames of a run: positions of vertices, elements, and fields. Frames come in batches, each with its own ranges of codes; a live run appends batches.
import { codeFrames, numberOfCode, wholeNumbers } from "./unpack.js";
import { words } from "./format.js";

const named = { velocity: "speed" };

export class Frames {
  static async of(data, scene) {
    const frames = new Frames();
    frames.origin = data.origin; // [m], of the coordinates that position() returns
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
    frames.list = []; // {time, batch, at: index in the batch}
    await frames.append(data);
    return frames;
  }

  async append(data) {
    const batch = { codes: await codeFrames(data.positions, data.times.length), position: numberOfCode(data), count: data.times.length,
      fields: data.fields.map((field) => ({ ...field, number: numberOfCode(field) })) };
    data.fields.forEach(({ lowest, highest }, f) => {
      this.fields[f].lowest = Math.min(this.fields[f].lowest, lowest);
      this.fields[f].highest = Math.max(this.fields[f].highest, highest);
    });
    this.list.push(...data.times.map((time, at) => ({ time, batch, at })));
    this.written = data.written;
  }

  // Drops every second frame, but not the last.
  thin() {
    this.list = this.list.filter((_, i) => (this.list.length - 1 - i) % 2 === 0);
  }

  get count() { return this.list.length; }
  get times() { return this.list.map(({ time }) => time); }
  get triangleCount() { return this.triangles.length / 3; }
  get edgeCount() { return this.edges.length / 2; }

  // Returns the codes of a frame: x of all vertices, then y, then z.
  codes(frame) { return this.list[frame].batch.codes[this.list[frame].at]; }
  // Returns the function from codes to coordinates relative to the origin [m].
  position(frame) { return this.list[frame].batch.position; }

  // Returns {codes, number: function from codes to numbers} of a field for each frame; unpacked on first use.
  async values(field) {
    const unpacked = new Map();
    for (const { batch } of this.list)
      if (!unpacked.has(batch)) unpacked.set(batch, (batch.fields[field.index].codes ??= codeFrames(batch.fields[field.index].block, batch.count)));
    for (const [batch, codes] of unpacked) unpacked.set(batch, await codes);
    return this.list.map(({ batch, at }) => ({ codes: unpacked.get(batch)[at], number: batch.fields[field.index].number }));
  }

  // Returns the smallest and largest coordinates [m, of the scene] in the given frames and vertices; by default in all.
  box(numbers = this.list.keys(), vertices = null) {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (const number of numbers) {
      const [codes, position] = [this.codes(number), this.position(number)];
      for (let c = 0; c < 3; ++c) {
        const take = (v) => {
          const x = this.origin[c] + position(codes[c * this.vertices + v]);
          if (x < low[c]) low[c] = x;
          if (x > high[c]) high[c] = x;
        };
        if (vertices) vertices.forEach(take);
        else for (let v = 0; v < this.vertices; ++v) take(v);
      }
    }
    return { low, high };
  }

  // Returns the smallest coordinate along a direction [m, of the scene] of some vertices in all frames; Infinity: of none.
  lowest(direction, vertices) {
    let low = Infinity;
    const start = direction.reduce((sum, d, c) => sum + d * this.origin[c], 0);
    for (let number = 0; number < this.count; ++number) {
      const [codes, position] = [this.codes(number), this.position(number)];
      for (const v of vertices) {
        const x = start + direction.reduce((sum, d, c) => sum + d * position(codes[c * this.vertices + v]), 0);
        if (x < low) low = x;
      }
    }
    return low;
  }

  // Returns the vertices of an object's elements.
  verticesOf(object) {
    const own = new Set();
    this.triangles.forEach((v, i) => { if (this.object[Math.floor(i / 3)] === object) own.add(v); });
    this.edges.forEach((v, i) => { if (this.object[this.triangleCount + Math.floor(i / 2)] === object) own.add(v); });
    this.points.forEach((v, i) => { if (this.object[this.triangleCount + this.edgeCount + i] === object) own.add(v); });
    return own;
  }
}
