import * as THREE from "three";
import type { FruitPoints } from "../data/messages.ts";
import type { Palette } from "../theme.ts";

/** The points a fruit's shape was fitted to, seen through everything. */
export class SurfacePoints {
  readonly group = new THREE.Group();
  private readonly material = new THREE.PointsMaterial({ size: 3, sizeAttenuation: false, depthTest: false, transparent: true });
  private shown: FruitPoints | null = null;

  show(fruit: FruitPoints | null): void {
    if (fruit === this.shown) return;
    this.shown = fruit;
    for (const old of [...this.group.children]) {
      this.group.remove(old);
      (old as THREE.Points).geometry.dispose();
    }
    if (!fruit) return;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(fruit.points, 3));
    const points = new THREE.Points(geometry, this.material);
    points.renderOrder = 5;
    this.group.add(points);
  }

  paint(palette: Palette): void {
    this.material.color.set(palette.ink);
  }
}
