// Shadows on what is seen from its back. three.js asks for the shadow of a place a little before it, along the normal of its vertices, and does not turn that normal on the
// back of what is drawn from both sides (three 0.187, shadowmap_vertex.glsl.js): the place is then behind the surface, in its own shadow. Only the side towards the light can
// be lit, whoever looks, so the normal is turned towards the light: away from the third row of the shadow's matrix, along which depth grows.
import { ShaderChunk } from "three";

const found = "worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 )";
const turned = `worldPosition + vec4( faceforward( shadowWorldNormal,
  vec3( directionalShadowMatrix[ i ][ 0 ].z, directionalShadowMatrix[ i ][ 1 ].z, directionalShadowMatrix[ i ][ 2 ].z ),
  shadowWorldNormal ) * directionalLightShadows[ i ].shadowNormalBias, 0 )`;

// Changes the shader of every material that is compiled from now on.
export function lightBothSides() {
  if (ShaderChunk.shadowmap_vertex.includes(turned)) return;
  if (!ShaderChunk.shadowmap_vertex.includes(found)) throw new Error("three.js has another shader of shadows: see two_sided_shadows.js");
  ShaderChunk.shadowmap_vertex = ShaderChunk.shadowmap_vertex.replace(found, turned);
}
