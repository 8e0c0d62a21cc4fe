// The sky of pictures. Its radiance grows from the horizon to the zenith with the sine of the elevation, and is that of the horizon below it, as in a studio with a bright ceiling.
// Diffuse light of it comes from drawings with one light each, which cast shadows (studio.js); what glossy and metallic surfaces mirror comes from a map of it.
import { DataTexture, EquirectangularReflectionMapping, FloatType, MeshStandardMaterial, PMREMGenerator, RGBAFormat, ShaderChunk } from "three";

// Pixels of the map of the sky, which only depends on the elevation; three.js blurs maps of at least 64 x 32 pixels.
const [mapWidth, mapHeight] = [64, 32];

// light: {zenith, horizon}, radiances. sine: of the elevation.
export const radiance = ({ zenith, horizon }, sine) => horizon + (zenith - horizon) * Math.max(0, sine);

// Returns the map that surfaces of any roughness mirror, with y upwards.
export function mapOfSky(renderer, light) {
  const pixels = new Float32Array(4 * mapWidth * mapHeight);
  for (let row = 0; row < mapHeight; ++row) {
    const value = radiance(light, Math.sin(((row + 0.5) / mapHeight - 0.5) * Math.PI));
    for (let column = 0; column < mapWidth; ++column) pixels.set([value, value, value, 1], 4 * (row * mapWidth + column));
  }
  const texture = new DataTexture(pixels, mapWidth, mapHeight, RGBAFormat, FloatType, EquirectangularReflectionMapping);
  texture.needsUpdate = true;
  const generator = new PMREMGenerator(renderer);
  const map = generator.fromEquirectangular(texture).texture;
  generator.dispose();
  texture.dispose();
  return map;
}

// three.js would add the map's diffuse light, which knows no shadows, and the reflection of every light: of the few that stand for the sky these are spots.
const mapIrradiance = "iblIrradiance += getIBLIrradiance( geometryNormal );";
const lightReflection = "reflectedLight.directSpecular += irradiance *";

// Returns a material that mirrors the map of the sky, is lit diffusely by lights alone, and mirrors these as far as mirrored.value says (1: a sun; 0: a part of the sky).
export function litMaterial(parameters, mirrored) {
  const material = new MeshStandardMaterial(parameters);
  material.onBeforeCompile = (shader) => {
    const replaced = (text, found, by) => {
      if (!text.includes(found)) throw new Error("three.js has another shader of reflections: see sky.js");
      return text.replace(found, by);
    };
    shader.uniforms.mirrored = mirrored;
    let text = shader.fragmentShader;
    for (const chunk of ["lights_physical_pars_fragment", "lights_fragment_maps"]) text = replaced(text, `#include <${chunk}>`, ShaderChunk[chunk]);
    text = replaced(text, mapIrradiance, "");
    text = replaced(text, lightReflection, `${lightReflection} mirrored *`);
    shader.fragmentShader = `uniform float mirrored;\n${text}`;
  };
  return material;
}
