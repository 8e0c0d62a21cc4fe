// Normals of triangle corners: smooth on smooth surfaces, sharp at edges. The normal of a corner is the mean over triangles chosen in the first frame: those
// around its vertex, of the same object, whose normals differ from that of its own triangle by less than an angle.

function faceNormals(places, triangles) {
  const normals = new Float32Array(triangles.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const [ux, uy, uz] = [places[b] - places[a], places[b + 1] - places[a + 1], places[b + 2] - places[a + 2]];
    const [vx, vy, vz] = [places[c] - places[a], places[c + 1] - places[a + 1], places[c + 2] - places[a + 2]];
    normals[t] = uy * vz - uz * vy;
    normals[t + 1] = uz * vx - ux * vz;
    normals[t + 2] = ux * vy - uy * vx;
  }
  return normals; // as long as twice the area
}

export class CornerNormals {
  // places: 3 coordinates per vertex; triangles: 3 vertices each; angle [rad]; 0: flat shading.
  constructor(places, triangles, angle) {
    this.triangles = triangles;
    const normals = faceNormals(places, triangles);
    const length = (t) => Math.hypot(normals[3 * t], normals[3 * t + 1], normals[3 * t + 2]) || 1;
    const around = new Map();
    for (let corner = 0; corner < triangles.length; ++corner) {
      const v = triangles[corner];
      if (!around.has(v)) around.set(v, []);
      around.get(v).push(Math.floor(corner / 3));
    }
    const least = Math.cos(angle);
    this.start = new Uint32Array(triangles.length + 1);
    const members = [];
    for (let corner = 0; corner < triangles.length; ++corner) {
      const own = Math.floor(corner / 3);
      for (const t of around.get(triangles[corner])) {
        const dot = normals[3 * own] * normals[3 * t] + normals[3 * own + 1] * normals[3 * t + 1] + normals[3 * own + 2] * normals[3 * t + 2];
        if (t === own || (angle > 0 && dot > least * length(own) * length(t))) members.push(t);
      }
      this.start[corner + 1] = members.length;
    }
    this.members = Uint32Array.from(members);
  }

  // Writes 3 numbers per corner.
  write(places, out) {
    const normals = faceNormals(places, this.triangles);
    for (let corner = 0; corner < this.triangles.length; ++corner) {
      let [x, y, z] = [0, 0, 0];
      for (let i = this.start[corner]; i < this.start[corner + 1]; ++i) {
        const t = 3 * this.members[i];
        x += normals[t];
        y += normals[t + 1];
        z += normals[t + 2];
      }
      const length = Math.hypot(x, y, z) || 1;
      out[3 * corner] = x / length;
      out[3 * corner + 1] = y / length;
      out[3 * corner + 2] = z / length;
    }
  }
}
