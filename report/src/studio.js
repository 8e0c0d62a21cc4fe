// Pictures of one frame under a sky (sky.js) and a sun: the mean of many drawings, each with one light that casts shadows. This gives ambient occlusion and soft
// shadows; each drawing is shifted by a fraction of a pixel, which smooths edges.
import {
  AddEquation, AmbientLight, BufferAttribute, BufferGeometry, Color, CustomBlending, CylinderGeometry, DirectionalLight, DoubleSide, DynamicDrawUsage, FloatType,
  HalfFloatType, IcosahedronGeometry, InstancedBufferAttribute, InstancedMesh, LineBasicMaterial, LineSegments, Matrix4, Mesh, NearestFilter, NoBlending, OneFactor,
  OrthographicCamera, PCFShadowMap, PerspectiveCamera, PlaneGeometry, Quaternion, Scene, ShaderMaterial, SRGBColorSpace, Vector3, Vector4, WebGLRenderer, WebGLRenderTarget,
} from "three";
import { mergeVertices } from "three/addons/utils/BufferGeometryUtils.js";
import { CornerNormals } from "./corner_normals.js";
import { GroundShade } from "./ground_shade.js";
import { litMaterial, mapOfSky } from "./sky.js";
import { lightBothSides } from "./two_sided_shadows.js";

const usual = { roughness: 0.7, metalness: 0, opacity: 1, smooth: 40, lines: false, hide: false };
const shadowPixels = 1024;
// Edge length of the ground and its distance below what stands on it, in sizes of the run.
const [groundExtent, groundGap] = [60, 1e-4];
// Fraction of the drawings that the sun lights, about its fraction of the light on the ground.
const sunShare = 0.4;
// Radii of drawn rods and particles, in sizes of the run, as in report/blender_runs.py: of those that have none in the scene, and the smallest, about a pixel.
const [defaultRadius, smallestRadius] = [0.003, 0.0008];
const groundLights = 96; // whose shade on the ground is added up, if the drawings have fewer
const up = new Vector3(0, 1, 0);

const quad = `varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }`;
const weighed = `uniform sampler2D picture; uniform float weight; varying vec2 at; void main() { gl_FragColor = texture2D(picture, at) * weight; }`;
// Colours in pictures are multiplied by the covered fraction of a pixel. `filmic` is the curve of K. Narkowicz, "ACES filmic tone mapping curve" (2016).
const shown = `uniform sampler2D picture; varying vec2 at;
  uniform float exposure;
  uniform bool filmic;
  uniform vec4 background;
  void main() {
    vec4 c = texture2D(picture, at);
    float covered = max(c.a, 1e-6);
    c.rgb *= exposure / covered;
    if (filmic) c.rgb = clamp(c.rgb * (2.51 * c.rgb + 0.03) / (c.rgb * (2.43 * c.rgb + 0.59) + 0.14), 0.0, 1.0);
    c = mix(background, vec4(c.rgb, 1.0), c.a);  // the background keeps its colour
    if (background.a == 0.0) c.rgb /= max(c.a, 1e-6);
    vec3 s = mix(c.rgb * 12.92, 1.055 * pow(max(c.rgb, vec3(0.0)), vec3(1.0 / 2.4)) - 0.055, step(vec3(0.0031308), c.rgb));
    gl_FragColor = vec4(s * c.a, c.a);
  }`;

// Returns the i-th number of a van der Corput sequence, which fills [0, 1) evenly.
function radical(i, base) {
  let [sum, part] = [0, 1 / base];
  for (; i > 0; i = Math.floor(i / base), part /= base) sum += part * (i % base);
  return sum;
}

// Returns a ball with shared vertices. three.js repeats each vertex six times, and drawing many balls costs time per vertex.
function ball(detail) {
  const geometry = new IcosahedronGeometry(1, detail);
  geometry.deleteAttribute("uv");
  return mergeVertices(geometry);
}

export class Studio {
  // Throws if the browser has no WebGL. lights: number of drawings that are averaged; background: a CSS colour, or "transparent"; tone: "none" or "filmic".
  // light: {sun, zenith, horizon, sun_angle}, the irradiance of the sun, radiances of the sky, and the angle of the sun's disc [degrees].
  constructor(width, height, { lights, background, exposure, tone, light }) {
    lightBothSides();
    this.renderer = new WebGLRenderer({ antialias: false, preserveDrawingBuffer: true, alpha: true });
    this.renderer.setPixelRatio(1);
    this.renderer.setSize(width, height, false);
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.autoClear = false;
    this.width = width;
    this.height = height;
    this.lights = lights;
    this.light = light;
    this.sky = mapOfSky(this.renderer, light);
    const shownBackground = background === "transparent" ? new Vector4(0, 0, 0, 0) : new Vector4(...new Color().setStyle(background, SRGBColorSpace).toArray(), 1);
    this.one = new WebGLRenderTarget(width, height, { type: HalfFloatType, minFilter: NearestFilter, magFilter: NearestFilter });
    this.sum = new WebGLRenderTarget(width, height, { type: FloatType, minFilter: NearestFilter, magFilter: NearestFilter, depthBuffer: false });
    const pass = (fragmentShader, uniforms, more = {}) => {
      const scene = new Scene();
      const material = new ShaderMaterial({ vertexShader: quad, fragmentShader, uniforms, depthTest: false, depthWrite: false, toneMapped: false, ...more });
      scene.add(new Mesh(new PlaneGeometry(2, 2), material));
      return scene;
    };
    this.flat = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
    this.adding = pass(weighed, { picture: { value: this.one.texture }, weight: { value: 1 / lights } }, {
      blending: CustomBlending, blendEquation: AddEquation, blendSrc: OneFactor, blendDst: OneFactor,
    });
    this.showing = pass(shown, { picture: { value: this.sum.texture }, exposure: { value: exposure }, filmic: { value: tone === "filmic" },
      background: { value: shownBackground } }, { blending: NoBlending });
  }

  get canvas() { return this.renderer.domElement; }

  // Returns the objects of one run to be drawn. looks: appearance per object, over the defaults; ground: {at, colour} or null.
  set(frames, vertical, looks, colours, ground) {
    return new Actors(frames, vertical, looks, colours, ground, this.light, this.sky);
  }

  // sets: [{set, camera, box: [x, y, width, height] in pixels from below}]; drawn side by side.
  draw(views) {
    const { renderer } = this;
    for (const { set, camera } of views) set.shadeGround(renderer, Math.max(groundLights, this.lights), camera);
    renderer.setRenderTarget(this.sum);
    renderer.setClearColor(0x000000, 0);
    renderer.clear();
    for (let i = 0; i < this.lights; ++i) {
      renderer.setRenderTarget(this.one);
      renderer.setClearColor(0x000000, 0);
      renderer.clear();
      const shift = [radical(i + 1, 2) - 0.5, radical(i + 1, 3) - 0.5];
      for (const { set, camera, box } of views) {
        const [x, y, width, height] = box;
        this.one.viewport.set(x, y, width, height);
        this.one.scissor.set(x, y, width, height);
        this.one.scissorTest = true;
        camera.setViewOffset(width, height, ...shift, width, height);
        set.lightUp(i, this.lights, camera);
        renderer.setRenderTarget(this.one);
        renderer.render(set.scene, camera);
        camera.clearViewOffset();
      }
      this.one.viewport.set(0, 0, this.width, this.height);
      this.one.scissorTest = false;
      renderer.setRenderTarget(this.sum);
      renderer.render(this.adding, this.flat);
    }
    renderer.setRenderTarget(null);
    renderer.render(this.showing, this.flat);
  }
}

class Actors {
  constructor(frames, vertical, looks, colours, ground, lighting, sky) {
    Object.assign(this, { frames, vertical, looks, colours, lighting });
    this.turn = new Quaternion().setFromUnitVectors(up, new Vector3(...vertical));
    this.scene = new Scene();
    this.scene.environment = sky;
    this.scene.environmentRotation.setFromQuaternion(this.turn);
    this.mirrored = { value: 1 };
    this.light = new DirectionalLight(0xffffff, 1);
    this.light.castShadow = true;
    this.light.shadow.mapSize.set(shadowPixels, shadowPixels);
    this.light.shadow.bias = -0.0004;
    this.ambient = new AmbientLight(0xffffff, 0);
    this.scene.add(this.light, this.light.target, this.ambient);
    const { low, high } = frames.box();
    this.size = Math.hypot(...low.map((l, c) => high[c] - l)) || 1;
    this.centre = low.map((l, c) => (l + high[c]) / 2);
    this.placed = new Float32Array(3 * frames.vertices);
    this.place(0);
    this.parts = frames.objects.map((object, i) => this.part(object, i));
    if (ground) {
      this.layGround(ground);
      this.scene.traverse((mesh) => mesh.castShadow && mesh.isMesh && this.shade.add(mesh));
    }
  }

  // Returns the vertices of an object's rods and particles, in any order.
  roundedVertices({ edges, points }) {
    const { frames } = this;
    return [...edges.flatMap((e) => [frames.edges[2 * e], frames.edges[2 * e + 1]]), ...points.map((p) => frames.points[p])];
  }

  // Returns the bounding box of what is drawn in some frames, all by default [m].
  box(numbers) {
    const [low, high] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
    const take = (vertices, radius) => {
      const box = this.frames.box(numbers, new Set(vertices));
      box.low.forEach((x, c) => (low[c] = Math.min(low[c], x - radius)));
      box.high.forEach((x, c) => (high[c] = Math.max(high[c], x + radius)));
    };
    for (const part of this.parts.filter(({ look }) => !look.hide)) {
      take(part.corners, 0);
      take(this.roundedVertices(part), part.radius * this.size);
    }
    return { low, high };
  }

  // Returns the height of the lowest point that is drawn in any frame [m].
  lowest() {
    const { frames, vertical, size } = this;
    return Math.min(...this.parts.filter(({ look }) => !look.hide).map((part) => {
      const rounded = frames.lowest(vertical, new Set(this.roundedVertices(part)));
      return Math.min(frames.lowest(vertical, new Set(part.corners)), rounded - part.radius * size);
    }));
  }

  // Adds a plane below everything that is shown, or at a height [m], with the shade on it (ground_shade.js). Without a colour, only the shade is drawn.
  layGround({ at, colour }) {
    const { vertical, size } = this;
    const along = (p) => p.reduce((sum, x, c) => sum + x * vertical[c], 0);
    const height = at ?? this.lowest();
    const material = litMaterial({ color: new Color().setStyle(colour ?? "#ffffff", SRGBColorSpace), roughness: usual.roughness, side: DoubleSide }, this.mirrored);
    // Slightly lower, so that faces that lie on the ground are in front of it.
    const plane = new Mesh(new PlaneGeometry(groundExtent, groundExtent), material);
    plane.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), new Vector3(...vertical));
    plane.position.set(...vertical.map((x) => x * ((height - along(this.centre)) / size - groundGap)));
    plane.frustumCulled = false;
    if (colour !== null) this.scene.add(plane);
    this.ground = { coloured: colour !== null };
    this.shade = new GroundShade(plane);
    this.scene.add(this.shade.mesh);
  }

  look(object) { return { ...usual, ...this.looks(object) }; }

  place(number) {
    const { frames, placed, size } = this;
    const [codes, at] = [frames.codes(number), frames.position(number)];
    const middle = this.centre.map((x, c) => x - frames.origin[c]);
    for (let v = 0; v < frames.vertices; ++v) for (let c = 0; c < 3; ++c) placed[3 * v + c] = (at(codes[c * frames.vertices + v]) - middle[c]) / size;
  }

  part(object, i) {
    const { frames } = this;
    const look = this.look(object.name);
    const part = { look, colour: new Color().setStyle(look.colour ?? this.colours[i % this.colours.length], SRGBColorSpace) };
    if (look.hide) return part;
    const material = (more) => litMaterial({
      side: DoubleSide, shadowSide: DoubleSide, roughness: look.roughness, metalness: look.metalness, opacity: look.opacity, transparent: look.opacity < 1, depthWrite: look.opacity >= 1, ...more,
    }, this.mirrored);
    const add = (mesh) => {
      mesh.castShadow = look.opacity > 0.5;
      mesh.receiveShadow = true;
      mesh.frustumCulled = false;
      this.scene.add(mesh);
      return mesh;
    };
    const mine = (count, from) => Array.from({ length: count }, (_, k) => k).filter((k) => frames.object[from + k] === i);
    part.triangles = mine(frames.triangleCount, 0);
    if (part.triangles.length > 0) {
      part.corners = Uint32Array.from(part.triangles.flatMap((t) => [frames.triangles[3 * t], frames.triangles[3 * t + 1], frames.triangles[3 * t + 2]]));
      part.normals = new CornerNormals(this.placed, part.corners, (look.smooth * Math.PI) / 180);
      part.geometry = new BufferGeometry();
      for (const name of ["position", "normal", "color"])
        part.geometry.setAttribute(name, new BufferAttribute(new Float32Array(3 * part.corners.length), 3).setUsage(DynamicDrawUsage));
      add(new Mesh(part.geometry, material({ vertexColors: true, polygonOffset: look.lines, polygonOffsetFactor: 1, polygonOffsetUnits: 1 })));
      if (look.lines) {
        part.lines = new BufferGeometry();
        part.lines.setAttribute("position", new BufferAttribute(new Float32Array(6 * part.corners.length), 3).setUsage(DynamicDrawUsage));
        const mesh = new LineSegments(part.lines, new LineBasicMaterial({ color: 0x000000, transparent: true, opacity: 0.35 }));
        mesh.frustumCulled = false;
        this.scene.add(mesh);
      }
    }
    const instances = (geometry, list) => {
      const mesh = new InstancedMesh(geometry, material({}), Math.max(1, list.length));
      mesh.instanceColor = new InstancedBufferAttribute(new Float32Array(3 * Math.max(1, list.length)), 3);
      mesh.count = list.length;
      return add(mesh);
    };
    part.edges = mine(frames.edgeCount, frames.triangleCount);
    if (part.edges.length > 0) {
      part.rods = instances(new CylinderGeometry(1, 1, 1, 16, 1, true), part.edges);
      const ends = new Map(part.edges.flatMap((e) => [[frames.edges[2 * e], e], [frames.edges[2 * e + 1], e]]));
      part.ends = [...ends]; // [vertex, an edge of it]
      part.joints = instances(ball(2), part.ends);
    }
    part.points = mine(frames.points.length, frames.triangleCount + frames.edgeCount);
    if (part.points.length > 0) part.balls = instances(ball(part.points.length > 3000 ? 2 : 4), part.points);
    part.radius = object.radius === null || object.radius === undefined ? defaultRadius : Math.max(smallestRadius, object.radius / this.size);
    return part;
  }

  // Places the objects of a frame. colourOf(element, vertex) -> [r, g, b], linear, or null: the colour of the object.
  setFrame(number, colourOf) {
    this.place(number);
    for (const part of this.parts) this.placePart(part, colourOf);
  }

  placePart(part, colourOf) {
    const { frames, placed } = this;
    const colour = (element, vertex) => colourOf?.(element, vertex) ?? [part.colour.r, part.colour.g, part.colour.b];
    if (part.geometry) {
      const { position, normal, color } = part.geometry.attributes;
      part.corners.forEach((v, k) => {
        for (let c = 0; c < 3; ++c) position.array[3 * k + c] = placed[3 * v + c];
        color.array.set(colour(part.triangles[Math.floor(k / 3)], v), 3 * k);
      });
      part.normals.write(placed, normal.array);
      position.needsUpdate = normal.needsUpdate = color.needsUpdate = true;
      if (part.lines) {
        const line = part.lines.attributes.position;
        part.corners.forEach((v, k) => {
          const w = part.corners[k % 3 === 2 ? k - 2 : k + 1];
          for (let c = 0; c < 3; ++c) {
            line.array[6 * k + c] = placed[3 * v + c];
            line.array[6 * k + 3 + c] = placed[3 * w + c];
          }
        });
        line.needsUpdate = true;
      }
    }
    const [a, b, axis, scale, middle, turn, matrix] = [new Vector3(), new Vector3(), new Vector3(), new Vector3(), new Vector3(), new Quaternion(), new Matrix4()];
    const done = (mesh) => (mesh.instanceMatrix.needsUpdate = mesh.instanceColor.needsUpdate = true);
    if (part.rods) {
      const r = part.radius;
      part.edges.forEach((e, k) => {
        const ends = [frames.edges[2 * e], frames.edges[2 * e + 1]];
        a.fromArray(placed, 3 * ends[0]);
        b.fromArray(placed, 3 * ends[1]);
        const length = axis.subVectors(b, a).length();
        turn.setFromUnitVectors(up, axis.divideScalar(length || 1));
        part.rods.setMatrixAt(k, matrix.compose(middle.addVectors(a, b).multiplyScalar(0.5), turn, scale.set(r, length, r)));
        const both = ends.map((v) => colour(frames.triangleCount + e, v));
        part.rods.instanceColor.array.set(both[0].map((x, c) => (x + both[1][c]) / 2), 3 * k);
      });
      part.ends.forEach(([v, e], k) => {
        part.joints.setMatrixAt(k, matrix.makeScale(r, r, r).setPosition(a.fromArray(placed, 3 * v)));
        part.joints.instanceColor.array.set(colour(frames.triangleCount + e, v), 3 * k);
      });
      done(part.rods);
      done(part.joints);
    }
    if (part.balls) {
      const r = part.radius;
      part.points.forEach((p, k) => {
        const v = frames.points[p];
        part.balls.setMatrixAt(k, matrix.makeScale(r, r, r).setPosition(placed[3 * v], placed[3 * v + 1], placed[3 * v + 2]));
        part.balls.instanceColor.array.set(colour(frames.triangleCount + frames.edgeCount + p, v), 3 * k);
      });
      done(part.balls);
    }
  }

  // Returns light i of `count`: a wide sun from behind the camera on the left, or a part of the sky. away: direction to it; intensity, and ambient that comes with it; onGround: the light of
  // all on the ground.
  lightOf(i, count, camera) {
    const { lighting } = this;
    const vertical = new Vector3(...this.vertical);
    const suns = Math.max(1, Math.round(sunShare * count));
    const skies = count - suns;
    const back = camera.position.clone().sub(this.target).normalize();
    const side = new Vector3().crossVectors(vertical, back).normalize();
    const sunward = vertical.clone().multiplyScalar(1.1).addScaledVector(back, 0.8).addScaledVector(side, -0.55).normalize();
    const away = new Vector3();
    if (i < suns) {
      const [across, along] = [new Vector3().crossVectors(sunward, side).normalize(), new Vector3()];
      along.crossVectors(sunward, across);
      const [r, angle] = [((lighting.sun_angle * Math.PI) / 360) * Math.sqrt((i + 0.5) / suns), 2.39996 * i];
      away.copy(sunward).addScaledVector(across, r * Math.cos(angle)).addScaledVector(along, r * Math.sin(angle)).normalize();
    } else {
      // Directions are distributed as the radiance above that of the horizon: by the sine of the elevation, down to almost horizontal ones.
      const k = i - suns;
      const [height, angle] = [Math.sqrt(1 - 0.97 * ((k + 0.5) / skies)), 2.39996 * k];
      const flat = Math.sqrt(1 - height * height);
      away.set(flat * Math.cos(angle), height, flat * Math.sin(angle)).applyQuaternion(this.turn);
    }
    // Irradiances on a surface that faces up: of the sun, of the sky above the horizon's radiance (2/3 of its sum over all directions), and of the latter. This comes from everywhere, also
    // into corners; but the ground is shaded from it as from the sky.
    const sky = Math.PI * (lighting.zenith - lighting.horizon), even = Math.PI * lighting.horizon;
    const onGround = lighting.sun * Math.max(0, sunward.dot(vertical)) + (2 / 3) * sky + even;
    const times = i < suns ? count / suns : count / skies; // each drawing stands for so many
    const intensity = times * (i < suns ? lighting.sun : sky);
    const shaded = intensity * Math.max(0, away.dot(vertical));
    return { away, intensity, sun: i < suns, ambient: skies > 0 ? even : even + (2 / 3) * sky, shaded, even: i < suns ? 0 : times * even, onGround };
  }

  // Draws the shade on the ground, if there is one. A ground without a colour is shaded from the even light as well as from the sky.
  shadeGround(renderer, count, camera) {
    if (!this.ground) return;
    const all = Array.from({ length: count }, (_, i) => this.lightOf(i, count, camera));
    this.shade.draw(renderer, this.middle, this.radius, all.map((one) => ({ away: one.away, weight: (one.shaded + (this.ground.coloured ? 0 : one.even)) / (count * one.onGround) })));
  }

  // Sets the light of drawing i.
  lightUp(i, count, camera) {
    const { away, intensity, ambient, sun } = this.lightOf(i, count, camera);
    this.light.intensity = intensity;
    this.ambient.intensity = ambient;
    this.mirrored.value = sun ? 1 : 0;
    const { radius } = this;
    this.light.target.position.copy(this.middle);
    this.light.position.copy(this.middle).addScaledVector(away, 2 * radius);
    const shadow = this.light.shadow.camera;
    shadow.left = shadow.bottom = -radius;
    shadow.right = shadow.top = radius;
    shadow.near = 0.5 * radius;
    shadow.far = 3.5 * radius;
    shadow.updateProjectionMatrix();
    this.light.shadow.normalBias = (2.5 * radius) / shadowPixels;
    this.light.shadow.needsUpdate = true;
  }

  // Restricts shadows to a box [m].
  focus(low, high) {
    const place = (p) => new Vector3(...p.map((x, c) => (x - this.centre[c]) / this.size));
    const [a, b] = [place(low), place(high)];
    this.middle = a.clone().add(b).multiplyScalar(0.5);
    this.radius = Math.max(1e-3, a.distanceTo(b) / 2);
    this.target = this.middle;
  }

  // Returns the camera of a view: {from, to} [m, of the scene], or {look, turn, lift, zoom}: a direction as in the report, two angles [degrees], and a magnification.
  camera(view, box, aspect) {
    const camera = new PerspectiveCamera(view.angle, aspect, 0.01, 100);
    const vertical = new Vector3(...this.vertical);
    camera.up.copy(vertical);
    const place = (p) => new Vector3(...p.map((x, c) => (x - this.centre[c]) / this.size));
    const target = view.to ? place(view.to) : place(box.low.map((l, c) => (l + box.high[c]) / 2));
    if (view.from) camera.position.copy(place(view.from));
    else {
      const along = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] }[view.look];
      const direction = along ? new Vector3(...along)
        : (Math.abs(vertical.y) > 0.5 ? new Vector3(0.55, 0, 1) : Math.abs(vertical.z) > 0.5 ? new Vector3(0.55, -1, 0) : new Vector3(0, 0.55, 1)).addScaledVector(vertical, 0.5);
      direction.normalize();
      if (Math.abs(direction.dot(vertical)) > 0.99) camera.up.copy(Math.abs(vertical.z) > 0.5 ? new Vector3(0, 1, 0) : new Vector3(0, 0, -1));
      direction.applyAxisAngle(camera.up, (view.turn * Math.PI) / 180);
      direction.applyAxisAngle(new Vector3().crossVectors(direction, camera.up).normalize(), (view.lift * Math.PI) / 180);
      const extent = Math.hypot(...box.low.map((l, c) => box.high[c] - l)) / this.size || 1;
      const away = (0.54 * extent) / Math.tan((view.angle * Math.PI) / 360) / Math.min(1, aspect) / view.zoom;
      camera.position.copy(direction.multiplyScalar(away)).add(target);
    }
    camera.lookAt(target);
    const distance = camera.position.distanceTo(target);
    camera.near = Math.max(0.01 * distance, distance - 2);
    camera.far = distance + (this.ground ? groundExtent : 3);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    return camera;
  }
}
