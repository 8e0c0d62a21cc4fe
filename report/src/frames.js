// The frames of a run: places of vertices, what they make up, and fields on them.
import { codeFrames, numberOfCode, wholeNumbers } from "./unpack.js";
import { words } from "./format.js";

const named = { velocity: "speed" };

export class Frames {
  static async of(data, scene) {
    const frames = new Frames();
    frames.times = data.times;
    frames.written = data.written;
    frames.origin = data.origin;
    frames.vertices = data.vertices;
    [frames.triangles, frames.edges, frames.points, frames.object] = await Promise.all(
      [data.triangles, data.edges, data.points, data.object].map(wholeNumbers));
    frames.codes = await codeFrames(data.positions, data.times.length);
    frames.place = numberOfCode(data);
    const count = frames.object.reduce((most, object) => Math.max(most, object + 1), 0);
    frames.objects = Array.from({ length: count }, (_, i) => scene?.objects[i] ?? { name: `object ${i}`, radius: null });
    frames.fields = data.fields.map((field) => ({
      ...field,
      label: field.magnitude ? named[field.name] ?? `${words(field.name)} (magnitude)` : words(field.name),
      ofVertices: field.of === "vertices",
    }));
    return frames;
  }

  get count() { return this.times.length; }
  get triangleCount() { return this.triangles.length / 3; }
  get edgeCount() { return this.edges.length / 2; }

  // {codes of each frame, number of a code}, unpacked when they are first asked for.
  async values(field) {
    field.codes ??= codeFrames(field.block, this.count);
    return { codes: await field.codes, number: numberOfCode(field) };
  }

  // Smallest and largest coordinates in some frames; without their numbers, in all.
  box(numbers = this.codes.keys()) {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (const number of numbers) {
      const codes = this.codes[number];
      for (let c = 0; c < 3; ++c)
        for (let v = 0; v < this.vertices; ++v) {
          const x = this.place(codes[c * this.vertices + v]);
          if (x < low[c]) low[c] = x;
          if (x > high[c]) high[c] = x;
        }
    }
    return { low, high };
  }
}
