import * as THREE from "three";
import type { CloudLook } from "./block_cloud.ts";

// How voxels and targets are drawn. Flags of a map voxel: 1 occupied, 2 ROI; of a target: 1 ROI, 2
// occupied, 4 border.

/** Colours and which sets are shown, shared by the materials of a cloud. */
export interface CloudUniforms {
  [name: string]: THREE.IUniform;
  size: { value: number };
  pixels: { value: number };
  shown: { value: THREE.Vector3 };
  colorA: { value: THREE.Color };
  colorB: { value: THREE.Color };
  colorC: { value: THREE.Color };
}

export function cloudUniforms(): CloudUniforms {
  return {
    size: { value: 0.01 },
    pixels: { value: 500 },
    shown: { value: new THREE.Vector3(1, 1, 1) },
    colorA: { value: new THREE.Color() },
    colorB: { value: new THREE.Color() },
    colorC: { value: new THREE.Color() },
  };
}

const kCommon = /* glsl */ `
uniform float size, pixels;
uniform vec3 shown, colorA, colorB, colorC;
varying vec3 vColor;
bool has(float flags, float bit) { return mod(floor(flags / bit), 2.0) > 0.5; }
const vec4 kNowhere = vec4(2.0, 2.0, 2.0, 1.0);
`;

/** Occupied in the cloud's colour, ROI in its own; false: neither is shown. */
const kMapColor = /* glsl */ `
bool pick(float flags, float height, out vec3 color) {
  bool roi = has(flags, 2.0) && shown.y > 0.5;
  if (!roi && !(has(flags, 1.0) && shown.x > 0.5)) return false;
  color = roi ? colorB : mix(colorA * 0.72, colorA * 1.22, clamp(height / 2.2, 0.0, 1.0));
  return true;
}
float light(vec3 n, vec3 toEye) {
  float l = length(n);
  if (l < 0.1) return 0.82;
  n /= l;
  float up = 0.5 + 0.5 * dot(n, normalize(vec3(-0.35, -0.5, 0.8)));
  return mix(0.5, 1.12, up) * mix(0.86, 1.0, abs(dot(n, toEye)));
}
`;

const kFragment = /* glsl */ `
varying vec3 vColor;
void main() {
  gl_FragColor = vec4(vColor, 1.0);
  #include <colorspace_fragment>
}`;

export function mapLook(uniforms: CloudUniforms): CloudLook {
  const points = new THREE.ShaderMaterial({
    uniforms,
    vertexShader: /* glsl */ `
attribute vec4 cell;
attribute vec3 facing;
${kCommon}${kMapColor}
void main() {
  vec4 world = modelMatrix * vec4((cell.xyz + 0.5) * size, 1.0);
  vec3 color;
  vColor = vec3(0.0);
  gl_Position = kNowhere;
  gl_PointSize = 1.0;
  if (pick(cell.w, world.z, color)) {
    vec4 eye = viewMatrix * world;
    gl_Position = projectionMatrix * eye;
    gl_PointSize = max(1.5, 1.25 * size * pixels / -eye.z);
    vColor = color * light(facing, normalize(cameraPosition - world.xyz));
  }
}`,
    fragmentShader: kFragment,
  });
  const cubes = new THREE.ShaderMaterial({
    uniforms,
    side: THREE.DoubleSide,
    vertexShader: /* glsl */ `
attribute vec4 cell;
attribute vec3 facing;
${kCommon}${kMapColor}
void main() {
  vec4 world = modelMatrix * vec4((cell.xyz + 0.5) * size, 1.0);
  vec3 toEye = cameraPosition - world.xyz;
  vec3 color;
  vColor = vec3(0.0);
  gl_Position = kNowhere;
  if (pick(cell.w, world.z, color)) {
    int face = gl_VertexID / 4;
    vec3 side = vec3(face == 0, face == 1, face == 2);
    vec3 normal = side * sign(toEye);
    vec3 corner = position * mix(vec3(1.0), sign(toEye), side);
    world.xyz += corner * size * 0.96;
    gl_Position = projectionMatrix * viewMatrix * world;
    toEye = normalize(toEye);
    vColor = color * (0.45 * light(normal, toEye) + 0.55 * light(facing, toEye));
  }
}`,
    fragmentShader: kFragment,
  });
  return { sets: 2, hideInner: true, points, cubes };
}

/** Targets: discs (ROI), squares (occupied) and diamonds (border), so that shape tells them apart too. */
export function targetLook(uniforms: CloudUniforms): CloudLook {
  const points = new THREE.ShaderMaterial({
    uniforms,
    vertexShader: /* glsl */ `
attribute vec4 cell;
varying float vShape;
${kCommon}
void main() {
  vec4 world = modelMatrix * vec4((cell.xyz + 0.5) * size, 1.0);
  bool roi = has(cell.w, 1.0) && shown.x > 0.5;
  bool occupied = has(cell.w, 2.0) && shown.y > 0.5;
  bool border = has(cell.w, 4.0) && shown.z > 0.5;
  vShape = roi ? 0.0 : occupied ? 1.0 : 2.0;
  vColor = roi ? colorA : occupied ? colorB : colorC;
  gl_Position = kNowhere;
  gl_PointSize = 1.0;
  if (roi || occupied || border) {
    vec4 eye = viewMatrix * world;
    gl_Position = projectionMatrix * eye;
    gl_PointSize = clamp(0.8 * size * pixels / -eye.z, 1.5, 14.0);
  }
}`,
    fragmentShader: /* glsl */ `
varying vec3 vColor;
varying float vShape;
void main() {
  vec2 p = abs(gl_PointCoord - 0.5);
  if (vShape < 0.5 ? length(p) > 0.5 : vShape < 1.5 ? max(p.x, p.y) > 0.4 : p.x + p.y > 0.5) discard;
  gl_FragColor = vec4(vColor, 1.0);
  #include <colorspace_fragment>
}`,
  });
  return { sets: 3, hideInner: false, points };
}
