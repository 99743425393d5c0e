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

/** What the camera sees now: a pyramid, and the picture at its base where there is one. */
export class Frustum {
  readonly group = new THREE.Group();
  private readonly lines: THREE.LineSegments;
  private readonly sheet: THREE.Mesh;
  private readonly lineMaterial = new THREE.LineBasicMaterial();
  private readonly sheetMaterial = new THREE.MeshBasicMaterial({ side: THREE.DoubleSide, transparent: true, opacity: 0.92 });
  private readonly texture: THREE.CanvasTexture;
  private readonly canvas = document.createElement("canvas");
  private camera: Camera | null = null;

  /** The base is so far from the camera. */
  constructor(private readonly depth: number) {
    this.group.matrixAutoUpdate = false;
    this.lines = new THREE.LineSegments(new THREE.BufferGeometry(), this.lineMaterial);
    this.texture = new THREE.CanvasTexture(this.canvas);
    this.texture.colorSpace = THREE.SRGBColorSpace;
    this.texture.generateMipmaps = false;
    this.texture.minFilter = THREE.LinearFilter;
    this.sheet = new THREE.Mesh(new THREE.BufferGeometry(), this.sheetMaterial);
    this.sheet.visible = false;
    this.group.add(this.lines, this.sheet);
  }

  set(camera: Camera): void {
    this.camera = camera;
    const corners = cornerRays(camera).map((ray) => ray.map((x) => x * this.depth));
    const points: number[] = [];
    corners.forEach((corner, i) => points.push(0, 0, 0, ...corner, ...corner, ...corners[(i + 1) % 4]));
    this.lines.geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    this.lines.geometry.computeBoundingSphere();
    const sheet = this.sheet.geometry;
    sheet.setAttribute("position", new THREE.Float32BufferAttribute(corners.flat(), 3));
    sheet.setAttribute("uv", new THREE.Float32BufferAttribute([0, 1, 1, 1, 1, 0, 0, 0], 2));
    sheet.setIndex([0, 1, 2, 0, 2, 3]);
    sheet.computeBoundingSphere();
  }

  /** The picture at the base; null: none. */
  picture(image: CanvasImageSource | null, width = 0, height = 0): void {
    this.sheet.visible = image !== null;
    if (!image) return;
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
      this.texture.dispose();
    }
    this.canvas.getContext("2d")?.drawImage(image, 0, 0);
    this.sheetMaterial.map = this.texture;
    this.sheetMaterial.needsUpdate = true;
    this.texture.needsUpdate = true;
  }

  move(T_world_camera: Pose): void {
    this.group.matrix.copy(matrixOf(T_world_camera));
    this.group.matrixWorldNeedsUpdate = true;
  }

  paint(palette: Palette, color: string = palette.ink): void {
    this.lineMaterial.color.set(color);
  }

  /** A place behind the camera to look over its shoulder from, and what to look at. */
  shoulder(T_world_camera: Pose): { position: THREE.Vector3; target: THREE.Vector3 } {
    return {
      position: new THREE.Vector3(...transform(T_world_camera, [0.25, -0.55, -1.1])),
      target: new THREE.Vector3(...transform(T_world_camera, [0, 0, 0.55])),
    };
  }

  get ready(): boolean {
    return this.camera !== null;
  }
}
