import * as THREE from "three";
import type { Palette } from "../theme.ts";
import { dispose } from "./matrices.ts";

/** The floor: a plane and a grid of half metres under everything that is known. */
export class Ground {
  readonly group = new THREE.Group();
  private box = new THREE.Box3(new THREE.Vector3(-2, -2, 0), new THREE.Vector3(2, 2, 1));
  private palette: Palette | null = null;

  /** So much space is needed. */
  cover(box: THREE.Box3): void {
    this.box = box.clone();
    this.make();
  }

  paint(palette: Palette): void {
    this.palette = palette;
    this.make();
  }

  private make(): void {
    if (!this.palette) return;
    for (const child of [...this.group.children]) dispose(child);
    const low = this.box.min.clone().subScalar(1.5).multiplyScalar(2).floor().divideScalar(2);
    const high = this.box.max.clone().addScalar(1.5).multiplyScalar(2).ceil().divideScalar(2);
    const plane = new THREE.Mesh(
      new THREE.PlaneGeometry(high.x - low.x, high.y - low.y),
      new THREE.MeshBasicMaterial({ color: this.palette.ground }),
    );
    plane.position.set((low.x + high.x) / 2, (low.y + high.y) / 2, -0.004);
    const points: number[] = [];
    for (let x = low.x; x <= high.x + 1e-6; x += 0.5) points.push(x, low.y, 0, x, high.y, 0);
    for (let y = low.y; y <= high.y + 1e-6; y += 0.5) points.push(low.x, y, 0, high.x, y, 0);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    const grid = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: this.palette.grid }));
    this.group.add(plane, grid);
  }
}
