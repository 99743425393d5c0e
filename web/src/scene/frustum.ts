import * as THREE from "three";
import type { Pose } from "../data/fields.ts";
import type { Camera } from "../data/messages.ts";
import { transform } from "../data/kinematics.ts";
import type { Palette } from "../theme.ts";
import { matrixOf } from "./matrices.ts";

/** Directions (depth 1) through the corners of the picture, in the optical frame. */
export function cornerRays(camera: Camera): [number, number, number][] {
  const at = (u: number, v: number): [number, number, number] => [
    (u - camera.cx) / camera.fx,
    (v - camera.cy) / camera.fy,
    1,
  ];
  const { width: w, height: h } = camera;
  return [at(0, 0), at(w, 0), at(w, h), at(0, h)];
}

/** Where a point of the world is in the picture, in pixels, and how deep; null: behind. */
export function project(camera: Camera, p_camera: ArrayLike<number>): { u: number; v: number; depth: number } | null {
  const depth = p_camera[2];
  if (depth <= 0.01) return null;
  return {
    u: (camera.fx * p_camera[0]) / depth + camera.cx,
    v: (camera.fy * p_camera[1]) / depth + camera.cy,
    depth,
  };
}

/** A camera's pyramid of sight. */
export class Frustum {
  readonly group = new THREE.Group();
  private readonly lines: THREE.LineSegments;
  private readonly material = new THREE.LineBasicMaterial();
  private camera: Camera | null = null;

  /** The base is so far from the camera. */
  constructor(private readonly depth: number) {
    this.group.matrixAutoUpdate = false;
    this.lines = new THREE.LineSegments(new THREE.BufferGeometry(), this.material);
    this.group.add(this.lines);
  }

  set(camera: Camera): void {
    this.lines.visible = true;
    if (camera === this.camera) return;
    this.camera = camera;
    const corners = cornersAt(camera, this.depth);
    const points: number[] = [];
    corners.forEach((corner, i) => points.push(0, 0, 0, ...corner, ...corner, ...corners[(i + 1) % 4]));
    this.lines.geometry.dispose();
    this.lines.geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    this.lines.geometry.computeBoundingSphere();
  }

  clear(): void {
    this.lines.visible = false;
  }

  move(T_world_camera: Pose): void {
    moveTo(this.group, T_world_camera);
  }

  paint(_palette: Palette, color: string = _palette.ink): void {
    this.material.color.set(color);
  }
}

/** A picture, hung up where it was taken. */
export class PictureSheet {
  readonly group = new THREE.Group();
  private readonly material = new THREE.MeshBasicMaterial({ side: THREE.DoubleSide, transparent: true, opacity: 0.92 });
  private readonly mesh = new THREE.Mesh(new THREE.BufferGeometry(), this.material);
  private readonly canvas = document.createElement("canvas");
  private readonly texture = new THREE.CanvasTexture(this.canvas);
  private camera: Camera | null = null;

  /** So far before the camera. */
  constructor(private readonly depth: number) {
    this.group.matrixAutoUpdate = false;
    this.texture.colorSpace = THREE.SRGBColorSpace;
    this.texture.generateMipmaps = false;
    this.texture.minFilter = THREE.LinearFilter;
    this.material.map = this.texture;
    this.mesh.visible = false;
    this.group.add(this.mesh);
  }

  private set(camera: Camera): void {
    if (camera === this.camera) return;
    this.camera = camera;
    const { geometry } = this.mesh;
    geometry.dispose();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(cornersAt(camera, this.depth).flat(), 3));
    geometry.setAttribute("uv", new THREE.Float32BufferAttribute([0, 1, 1, 1, 1, 0, 0, 0], 2));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    geometry.computeBoundingSphere();
  }

  clear(): void {
    this.mesh.visible = false;
  }

  show(image: ImageBitmap, camera: Camera, T_world_camera: Pose): void {
    this.mesh.visible = true;
    this.set(camera);
    if (this.canvas.width !== image.width || this.canvas.height !== image.height) {
      this.canvas.width = image.width;
      this.canvas.height = image.height;
      this.texture.dispose();
    }
    this.canvas.getContext("2d")?.drawImage(image, 0, 0);
    this.texture.needsUpdate = true;
    moveTo(this.group, T_world_camera);
  }
}

/** A place behind the camera to look over its shoulder from, and what to look at. */
export function shoulder(T_world_camera: Pose): { position: THREE.Vector3; target: THREE.Vector3 } {
  return {
    position: new THREE.Vector3(...transform(T_world_camera, [0.14, -0.3, -0.5])),
    target: new THREE.Vector3(...transform(T_world_camera, [0, 0.02, 0.6])),
  };
}

function cornersAt(camera: Camera, depth: number): number[][] {
  return cornerRays(camera).map((ray) => ray.map((x) => x * depth));
}

function moveTo(group: THREE.Group, T: Pose): void {
  group.matrix.copy(matrixOf(T));
  group.matrixWorldNeedsUpdate = true;
}
