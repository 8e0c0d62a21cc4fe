// The 3D picture of one frame: surfaces, rods as cylinders, particles as balls; camera, cut plane. It is drawn only after
// changes.
import {
  AmbientLight, BufferAttribute, BufferGeometry, Color, CylinderGeometry, DirectionalLight, DoubleSide, DynamicDrawUsage,
  IcosahedronGeometry, InstancedBufferAttribute, InstancedMesh, Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial, PerspectiveCamera,
  Plane, Quaternion, SRGBColorSpace, Scene, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { surfaceColours } from "./theme.js";

const radiusMin = 0.0012;    // smallest drawn radius of a rod or particle, of the size of the first frame
const radiusDefault = 0.004; // of objects without a radius, of the size of the first frame
const axes = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];

const diagonal = (low, high) => Math.hypot(...low.map((l, c) => high[c] - l));

export class Stage {
  // Throws if the browser has no WebGL.
  constructor(canvas, changed) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: "low-power" });
    this.renderer.localClippingEnabled = true;
    this.changed = changed;
    this.camera = new PerspectiveCamera(32, 1, 0.01, 100);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener("change", () => this.request());
    this.plane = new Plane();
    this.planes = [];
    this.lines = false;
    this.hidden = new Set();
  }

  // Shows another run.
  show(frames, up) {
    this.frames = frames;
    this.hidden.clear();
    this.up = up;
    this.scene = new Scene();
    this.light = new DirectionalLight(0xffffff, 1.5);
    this.scene.add(this.camera, new AmbientLight(0xffffff, 1.9), this.light, this.light.target);
    const { low, high } = Object.assign(this, frames.box());
    this.size = diagonal(low, high) || 1;
    this.centre = low.map((l, c) => (l + high[c]) / 2);
    const first = frames.box([0]);
    this.firstSize = (diagonal(first.low, first.high) || this.size) / this.size;
    this.placed = new Float32Array(3 * frames.vertices);
    this.makeSurface();
    this.makeRods();
    this.makeBalls();
    this.makeShells();
    this.fit(this.firstSize < 0.5 ? 0 : null);
    this.look("corner");
  }

  // Enlarges the box of the run by the given frames.
  grow(numbers) {
    const { low, high } = this.frames.box(numbers);
    this.low = this.low.map((x, c) => Math.min(x, low[c]));
    this.high = this.high.map((x, c) => Math.max(x, high[c]));
  }

  // Sets the target of the camera: a frame, or, without a number, the whole run.
  fit(frame) { this.fitBox(frame === null ? this : this.frames.box([frame])); }
  // Sets the target to a box, with a margin inside `within`.
  fitBox({ low, high }, within = null) {
    this.target = low.map((l, c) => ((l + high[c]) / 2 - this.centre[c]) / this.size);
    const own = diagonal(low, high);
    this.extent = (within ? Math.min(2.5 * own, Math.max(own, diagonal(within.low, within.high))) : own) / this.size || 1;
  }

  material(Kind, more) {
    return new Kind({ side: DoubleSide, clippingPlanes: this.planes, ...more });
  }

  makeSurface() {
    const n = this.frames.triangleCount;
    this.surface = new BufferGeometry();
    for (const name of ["position", "color"]) {
      const attribute = new BufferAttribute(new Float32Array(9 * n), 3);
      attribute.setUsage(DynamicDrawUsage);
      this.surface.setAttribute(name, attribute);
    }
    const solid = new Mesh(this.surface, this.material(MeshLambertMaterial, {
      vertexColors: true, flatShading: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    }));
    this.wires = new Mesh(this.surface, this.material(MeshBasicMaterial, { color: 0x000000, wireframe: true, transparent: true, opacity: 0.28 }));
    this.wires.visible = this.lines;
    for (const mesh of [solid, this.wires]) {
      mesh.frustumCulled = false;
      this.scene.add(mesh);
    }
  }

  // Makes surfaces at half of the contact range: contact begins where two of them meet.
  makeShells() {
    const { frames } = this;
    this.shelled = frames.objects.some((object) => object.reach > 0);
    if (!this.shelled) return;
    this.shell = new BufferGeometry();
    this.shell.setAttribute("position", new BufferAttribute(new Float32Array(18 * frames.triangleCount), 3).setUsage(DynamicDrawUsage));
    const mesh = new Mesh(this.shell, this.material(MeshBasicMaterial, { color: 0x2a7fff, transparent: true, opacity: 0.22, depthWrite: false }));
    mesh.frustumCulled = false;
    this.shells = [mesh, ...[this.rods, this.balls].map((of) => {
      const other = new InstancedMesh(of.geometry, mesh.material, Math.max(1, of.instanceMatrix.count));
      other.frustumCulled = false;
      return other;
    })];
    for (const one of this.shells) {
      one.visible = this.withShells ?? false;
      this.scene.add(one);
    }
  }

  setShells(shown) {
    this.withShells = shown;
    for (const one of this.shells ?? []) one.visible = shown;
    if (shown && this.shelled) this.placeShells();
    this.request();
  }

  placeShells() {
    const { frames, placed, hidden, size } = this;
    const normals = new Float32Array(3 * frames.vertices);
    const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
    for (let t = 0; t < frames.triangleCount; ++t) {
      const v = [0, 1, 2].map((corner) => frames.triangles[3 * t + corner]);
      a.fromArray(placed, 3 * v[0]);
      b.fromArray(placed, 3 * v[1]).sub(a);
      c.fromArray(placed, 3 * v[2]).sub(a);
      b.cross(c);
      for (const one of v) for (let k = 0; k < 3; ++k) normals[3 * one + k] += b.getComponent(k);
    }
    const out = this.shell.attributes.position;
    let at = 0;
    for (let t = 0; t < frames.triangleCount; ++t) {
      const { reach = 0 } = frames.objects[frames.object[t]];
      if (hidden.has(frames.object[t]) || !(reach > 0)) continue;
      for (const side of [1, -1])
        for (let corner = 0; corner < 3; ++corner, at += 3) {
          const v = frames.triangles[3 * t + corner];
          a.fromArray(normals, 3 * v).normalize().multiplyScalar((side * reach) / size);
          for (let k = 0; k < 3; ++k) out.array[at + k] = placed[3 * v + k] + a.getComponent(k);
        }
    }
    out.needsUpdate = true;
    this.shell.setDrawRange(0, at / 3);
    const grown = (mesh, of, first, radial) => {
      const [matrix, place, turn, scale] = [new Matrix4(), new Vector3(), new Quaternion(), new Vector3()];
      const elements = Array.from({ length: frames.object.length - first }, (_, i) => frames.object[first + i]).filter((object) => !hidden.has(object));
      for (let i = 0; i < of.count; ++i) {
        of.getMatrixAt(i, matrix);
        matrix.decompose(place, turn, scale);
        const more = (frames.objects[elements[i]].reach ?? 0) / size;
        scale.x += more;
        scale.z += more;
        if (radial) scale.y += more;
        mesh.setMatrixAt(i, matrix.compose(place, turn, scale));
      }
      mesh.count = of.count;
      mesh.instanceMatrix.needsUpdate = true;
    };
    grown(this.shells[1], this.rods, frames.triangleCount, false);
    grown(this.shells[2], this.balls, frames.triangleCount + frames.edgeCount, true);
  }

  instances(geometry, count) {
    const mesh = new InstancedMesh(geometry, this.material(MeshLambertMaterial, {}), Math.max(1, count));
    mesh.count = count;
    mesh.frustumCulled = false;
    mesh.instanceColor = new InstancedBufferAttribute(new Float32Array(3 * Math.max(1, count)), 3);
    mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    this.scene.add(mesh);
    return mesh;
  }

  makeRods() { this.rods = this.instances(new CylinderGeometry(1, 1, 1, 10, 1), this.frames.edgeCount); }
  makeBalls() { this.balls = this.instances(new IcosahedronGeometry(1, this.frames.points.length > 3000 ? 1 : 3), this.frames.points.length); }

  // Returns the drawn radius of an object, in units of the camera's scene.
  radius(object) {
    const radius = this.frames.objects[object].radius;
    return radius === null ? radiusDefault * this.firstSize : Math.max(radiusMin * this.firstSize, radius / this.size);
  }

  // colourOf(element, vertex, out, at) writes the colour of a corner.
  setFrame(number, colourOf) {
    const { frames, placed, size } = this;
    const [codes, position] = [frames.codes(number), frames.position(number)];
    const middle = this.centre.map((x, c) => x - frames.origin[c]);
    const n = frames.vertices;
    for (let v = 0; v < n; ++v) for (let c = 0; c < 3; ++c) placed[3 * v + c] = (position(codes[c * n + v]) - middle[c]) / size;
    this.placeSurface(colourOf);
    this.placeRods(colourOf);
    this.placeBalls(colourOf);
    if (this.shelled && this.withShells) this.placeShells();
    this.request();
  }

  placeSurface(colourOf) {
    const { frames, placed, hidden } = this;
    const { position, color } = this.surface.attributes;
    let at = 0;
    for (let t = 0; t < frames.triangleCount; ++t) {
      if (hidden.has(frames.object[t])) continue;
      for (let corner = 0; corner < 3; ++corner, at += 3) {
        const v = frames.triangles[3 * t + corner];
        for (let c = 0; c < 3; ++c) position.array[at + c] = placed[3 * v + c];
        colourOf(t, v, color.array, at);
      }
    }
    position.needsUpdate = color.needsUpdate = true;
    this.surface.setDrawRange(0, at / 3);
  }

  placeRods(colourOf) {
    const { frames, placed, hidden } = this;
    const [a, b, axis, middle] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];
    const [turn, scale, matrix] = [new Quaternion(), new Vector3(), new Matrix4()];
    const colours = [new Float32Array(3), new Float32Array(3)];
    let shown = 0;
    for (let e = 0; e < frames.edgeCount; ++e) {
      const element = frames.triangleCount + e;
      const object = frames.object[element];
      if (hidden.has(object)) continue;
      const [v, w] = [frames.edges[2 * e], frames.edges[2 * e + 1]];
      a.fromArray(placed, 3 * v);
      b.fromArray(placed, 3 * w);
      axis.subVectors(b, a);
      const length = axis.length();
      turn.setFromUnitVectors(axes[1], axis.divideScalar(length || 1));
      const r = this.radius(object);
      matrix.compose(middle.addVectors(a, b).multiplyScalar(0.5), turn, scale.set(r, length, r));
      this.rods.setMatrixAt(shown, matrix);
      colourOf(element, v, colours[0], 0);
      colourOf(element, w, colours[1], 0);
      for (let c = 0; c < 3; ++c) this.rods.instanceColor.array[3 * shown + c] = (colours[0][c] + colours[1][c]) / 2;
      ++shown;
    }
    this.finish(this.rods, shown);
  }

  placeBalls(colourOf) {
    const { frames, placed, hidden } = this;
    const matrix = new Matrix4();
    let shown = 0;
    for (let p = 0; p < frames.points.length; ++p) {
      const element = frames.triangleCount + frames.edgeCount + p;
      const object = frames.object[element];
      if (hidden.has(object)) continue;
      const v = frames.points[p];
      const r = this.radius(object);
      matrix.makeScale(r, r, r).setPosition(placed[3 * v], placed[3 * v + 1], placed[3 * v + 2]);
      this.balls.setMatrixAt(shown, matrix);
      colourOf(element, v, this.balls.instanceColor.array, 3 * shown);
      ++shown;
    }
    this.finish(this.balls, shown);
  }

  finish(mesh, shown) {
    mesh.count = shown;
    mesh.instanceMatrix.needsUpdate = mesh.instanceColor.needsUpdate = true;
  }

  static objectColours() {
    return surfaceColours.map((c) => new Color().setStyle(c, SRGBColorSpace).toArray());
  }

  setLines(shown) {
    this.lines = this.wires.visible = shown;
    this.request();
  }

  // Cuts away one side of a plane. axis: 0, 1, 2, or null for none; fraction: position in the box of the run, 0 to 1.
  cut(axis, fraction, flipped) {
    this.planes.length = 0;
    if (axis !== null) {
      const at = (this.low[axis] + fraction * (this.high[axis] - this.low[axis]) - this.centre[axis]) / this.size;
      this.plane.setComponents(...axes[axis].clone().multiplyScalar(flipped ? 1 : -1).toArray(), flipped ? -at : at);
      this.planes.push(this.plane);
    }
    this.scene.traverse((object) => { if (object.material) object.material.needsUpdate = true; });
    this.request();
  }

  // Turns the camera. from: "corner", or an axis: "x", "y", "z".
  look(from) {
    const directions = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
    const up = new Vector3(...this.up);
    let direction = new Vector3(...(directions[from] ?? [0, 0, 0]));
    if (from === "corner") {
      const side = Math.abs(up.y) > 0.5 ? new Vector3(0.55, 0, 1) : Math.abs(up.z) > 0.5 ? new Vector3(0.55, -1, 0) : new Vector3(0, 0.55, 1);
      direction = side.addScaledVector(up, 0.5);
    }
    direction.normalize();
    // In a view from above, the back is at the top of the picture.
    const back = Math.abs(up.z) > 0.5 ? axes[1] : axes[2].clone().negate();
    this.camera.up.copy(Math.abs(direction.dot(up)) > 0.99 ? back : up);
    this.controls.target.set(...this.target);
    const away = (0.54 * this.extent) / Math.tan((this.camera.fov * Math.PI) / 360) / Math.min(1, this.camera.aspect);
    this.camera.position.copy(direction.multiplyScalar(away)).add(this.controls.target);
    this.controls.update();
    this.request();
  }

  // Returns position, target [m] and angle [rad] of the camera.
  view() {
    const metres = (p) => p.toArray().map((x, c) => x * this.size + this.centre[c]);
    return { from: metres(this.camera.position), to: metres(this.controls.target), angle: (this.camera.fov * Math.PI) / 180 };
  }

  // Angles in radians; zoom as a factor of the distance.
  orbit(across, along, zoom = 1) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const side = new Vector3().crossVectors(this.camera.up, offset).normalize();
    offset.applyAxisAngle(this.camera.up, across);
    const turned = offset.clone().applyAxisAngle(side, along);
    if (turned.angleTo(this.camera.up) > 0.05 && turned.angleTo(this.camera.up) < Math.PI - 0.05) offset.copy(turned);
    this.camera.position.copy(offset.multiplyScalar(zoom)).add(this.controls.target);
    this.controls.update();
    this.request();
  }

  resize(width, height) {
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.request();
  }

  setBackground(css) {
    this.renderer.setClearColor(new Color().setStyle(css, SRGBColorSpace), 1);
    this.request();
  }

  request() {
    if (this.pending) return;
    this.pending = requestAnimationFrame(() => this.render());
  }

  render() {
    this.pending = 0;
    if (!this.scene) return;
    this.light.position.copy(this.camera.position).addScaledVector(this.camera.up, 0.6);
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = Math.max(0.02 * distance, distance - 2);
    this.camera.far = distance + 3;
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.scene, this.camera);
    this.changed();
  }

  // Returns the directions of the axes on the screen, y upwards.
  triad() {
    const turn = this.camera.quaternion.clone().invert();
    return axes.map((axis) => axis.clone().applyQuaternion(turn));
  }
}
