import * as THREE from "three";
import type { CloudLook } from "./block_cloud.ts";

// How voxels and targets are drawn. Flags of a map voxel: 1 occupied, 2 ROI; of a target: 1 ROI, 2
// occupied, 4 border.

/** Colours and which sets are shown, shared by the materials of a cloud. */
export interface CloudUniforms {
  [name: string]: THREE.IUniform;
  size: { value: number };
  pixels: { value: number };
  nearer: { value: number };
  shown: { value: THREE.Vector3 };
  colorA: { value: THREE.Color };
  colorB: { value: THREE.Color };
  colorC: { value: THREE.Color };
}

export function cloudUniforms(): CloudUniforms {
  return {
    size: { value: 0.01 },
    pixels: { value: 500 },
    nearer: { value: 0.5 },
    shown: { value: new THREE.Vector3(1, 1, 1) },
    colorA: { value: new THREE.Color() },
    colorB: { value: new THREE.Color() },
    colorC: { value: new THREE.Color() },
  };
}

const kCommon = /* glsl */ `
uniform float size, pixels, nearer;
uniform vec3 shown, colorA, colorB, colorC;
const float kRoiSize = 0.6;
varying vec3 vColor;
bool has(float flags, float bit) { return mod(floor(flags / bit), 2.0) > 0.5; }
const vec4 kNowhere = vec4(2.0, 2.0, 2.0, 1.0);
`;

/**
 * Occupied in the cloud's colour, paler at the floor; ROI in its own, and small, so that fitted
 * shapes are seen between. `scale`: of a voxel's edge, 0 where it is not shown.
 */
const kMapColor = /* glsl */ `
void pick(float flags, float height, out vec3 color, out float scale) {
  bool roi = has(flags, 2.0) && shown.y > 0.5;
  bool occupied = has(flags, 1.0) && shown.x > 0.5;
  scale = roi ? kRoiSize : occupied ? 1.0 : 0.0;
  vec3 plant = mix(colorA * 0.8, colorA * 1.2, clamp(height / 2.2, 0.0, 1.0));
  color = roi ? colorB : mix(colorC, plant, smoothstep(0.0, 0.1, height));
}
float shaded(float height) { return mix(0.3, 1.0, smoothstep(0.0, 0.1, height)); }
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
  float scale;
  pick(cell.w, world.z, color, scale);
  vColor = vec3(0.0);
  gl_Position = kNowhere;
  gl_PointSize = 1.0;
  if (scale > 0.0) {
    vec3 toEye = normalize(cameraPosition - world.xyz);
    vColor = color * mix(1.0, light(facing, toEye), shaded(world.z));
    // As near as a cube's front, or the leaf inside would shine through. Larger cells would hide fruits.
    if (scale == 1.0) world.xyz += nearer * size * toEye;
    vec4 eye = viewMatrix * world;
    gl_Position = projectionMatrix * eye;
    gl_PointSize = max(1.5, 1.25 * scale * size * pixels / -eye.z);
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
  float scale;
  pick(cell.w, world.z, color, scale);
  vColor = vec3(0.0);
  gl_Position = kNowhere;
  if (scale > 0.0) {
    int face = gl_VertexID / 4;
    vec3 side = vec3(face == 0, face == 1, face == 2);
    vec3 normal = side * sign(toEye);
    vec3 corner = position * mix(vec3(1.0), sign(toEye), side);
    world.xyz += corner * size * 0.96 * scale;
    gl_Position = projectionMatrix * viewMatrix * world;
    toEye = normalize(toEye);
    float lit = 0.45 * light(normal, toEye) + 0.55 * light(facing, toEye);
    vColor = color * mix(1.0, lit, shaded(world.z));
  }
}`,
    fragmentShader: kFragment,
  });
  return { sets: 2, hideInner: true, points: levels(points), cubes };
}

/** A material for each size of cells; all other uniforms are shared. */
function levels(points: THREE.ShaderMaterial): THREE.ShaderMaterial[] {
  const { vertexShader, fragmentShader, uniforms } = points;
  const own = () => ({ ...uniforms, size: { value: 1 }, nearer: { value: 0 } });
  const larger = () => new THREE.ShaderMaterial({ vertexShader, fragmentShader, uniforms: own() });
  return [points, larger(), larger(), larger()];
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
  return { sets: 3, hideInner: false, points: levels(points) };
}
