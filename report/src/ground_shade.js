// The shade on the ground of pictures: the fraction of the ground's light that objects keep off, of many more lights than the drawings have (studio.js). A plane needs no
// shadow map: each light projects the objects along its direction onto the ground, into a texture that adds up the light that they keep off. This costs a fraction of a drawing, and few
// lights would show as separate shadows on the ground.
import {
  AddEquation, Camera, CustomBlending, DataTexture, DoubleSide, HalfFloatType, InstancedMesh, LessDepth, LinearFilter, Mesh, MeshBasicMaterial, OneFactor, Plane, PlaneGeometry, RGFormat, Scene,
  Vector3, WebGLRenderTarget,
} from "three";

const pixels = 1024; // along an edge of the texture
const reach = 3; // half of the texture's edge, in radii of what is shown
const fadePixels = 64; // of the map that fades the shade out towards the edge
const lightDepth = 0.9; // depths of the lights are between - lightDepth and lightDepth, within the clip space, which ends at 1

// Returns a texture that is 1 in the middle and falls to 0 from 0.7 of the way to the edge on.
function fading() {
  const values = new Uint8Array(2 * fadePixels * fadePixels);
  for (let i = 0; i < fadePixels * fadePixels; ++i) {
    const [x, y] = [i % fadePixels, Math.floor(i / fadePixels)].map((k) => (2 * (k + 0.5)) / fadePixels - 1);
    const t = Math.min(1, Math.max(0, (1 - Math.hypot(x, y)) / 0.3));
    values[2 * i + 1] = 255 * t * t * (3 - 2 * t); // three.js reads the second channel
  }
  const texture = new DataTexture(values, fadePixels, fadePixels, RGFormat);
  texture.magFilter = texture.minFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

export class GroundShade {
  // plane: the ground, whose z axis is the vertical.
  constructor(plane) {
    plane.updateMatrixWorld();
    [this.right, this.back, this.vertical] = [0, 1, 2].map((c) => new Vector3().setFromMatrixColumn(plane.matrixWorld, c));
    this.height = plane.position.dot(this.vertical);
    this.casters = new Scene();
    this.target = new WebGLRenderTarget(pixels, pixels, { type: HalfFloatType, minFilter: LinearFilter, magFilter: LinearFilter });
    // Each light has a depth of its own, nearer than that of those before: of several faces that keep it off, one counts. Clipped is what is below the ground.
    this.material = new MeshBasicMaterial({
      color: 0x000000, side: DoubleSide, transparent: true, blending: CustomBlending, blendEquation: AddEquation, blendSrc: OneFactor, blendDst: OneFactor, depthFunc: LessDepth, toneMapped: false,
      clippingPlanes: [new Plane(this.vertical.clone(), -this.height)],
    });
    this.camera = new Camera();
    this.camera.matrixWorldAutoUpdate = false;
    this.mesh = new Mesh(new PlaneGeometry(1, 1), new MeshBasicMaterial({ color: 0x000000, map: this.target.texture, alphaMap: fading(), transparent: true, toneMapped: false,
      polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1 }));
    this.mesh.quaternion.copy(plane.quaternion);
    this.mesh.frustumCulled = false;
  }

  // Adds an object that keeps light off.
  add(mesh) {
    let caster;
    if (mesh.isInstancedMesh) {
      caster = new InstancedMesh(mesh.geometry, this.material, mesh.instanceMatrix.count);
      caster.instanceMatrix = mesh.instanceMatrix;
      caster.count = mesh.count;
    } else caster = new Mesh(mesh.geometry, this.material);
    caster.frustumCulled = false;
    this.casters.add(caster);
  }

  // Draws the shade below a sphere. lights: [{away, weight}], directions to the lights and fractions of the ground's light.
  draw(renderer, middle, radius, lights) {
    const { right, back, vertical, height, camera, mesh } = this;
    const half = reach * radius;
    const foot = middle.clone().addScaledVector(vertical, height - middle.dot(vertical));
    mesh.position.copy(foot);
    mesh.scale.set(2 * half, 2 * half, 1);
    renderer.setRenderTarget(this.target);
    renderer.setClearColor(0x000000, 0);
    renderer.clear();
    renderer.localClippingEnabled = true;
    lights.forEach(({ away, weight }, i) => {
      const up = away.dot(vertical);
      if (up <= 0) return;
      // A point p goes to p - ((p . n - height) / (away . n)) away.
      const row = (axis) => {
        const slope = away.dot(axis) / up;
        const r = axis.clone().addScaledVector(vertical, -slope).divideScalar(half);
        return [r.x, r.y, r.z, (slope * height - foot.dot(axis)) / half];
      };
      camera.projectionMatrix.set(...row(right), ...row(back), 0, 0, 0, lightDepth * (1 - (2 * i) / lights.length), 0, 0, 0, 1);
      camera.projectionMatrixInverse.copy(camera.projectionMatrix); // unused, and singular
      this.material.opacity = weight;
      renderer.render(this.casters, camera);
    });
    renderer.localClippingEnabled = false;
  }
}
