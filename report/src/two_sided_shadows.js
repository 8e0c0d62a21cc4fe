// Corrects shadows on back faces of two-sided materials. three.js looks up the shadow at a point offset along the vertex normal, and does not flip that normal on back faces
// (three 0.187, shadowmap_vertex.glsl.js): the point is then behind the surface, in its own shadow. Only the side towards the light can be lit, from any view, so the normal is
// flipped towards the light: away from the third row of the shadow matrix, along which depth grows.
import { ShaderChunk } from "three";

const found = "worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 )";
const turned = `worldPosition + vec4( faceforward( shadowWorldNormal,
  vec3( directionalShadowMatrix[ i ][ 0 ].z, directionalShadowMatrix[ i ][ 1 ].z, directionalShadowMatrix[ i ][ 2 ].z ),
  shadowWorldNormal ) * directionalLightShadows[ i ].shadowNormalBias, 0 )`;

// Changes the shader of all materials that are compiled after this call.
export function lightBothSides() {
  if (ShaderChunk.shadowmap_vertex.includes(turned)) return;
  if (!ShaderChunk.shadowmap_vertex.includes(found)) throw new Error("three.js has another shader of shadows: see two_sided_shadows.js");
  ShaderChunk.shadowmap_vertex = ShaderChunk.shadowmap_vertex.replace(found, turned);
}
