import * as THREE from "three";
import type { Truth } from "../data/messages.ts";
import type { Palette } from "../theme.ts";
import { dispose } from "./matrices.ts";

/** Rings around the true fruits: solid for those that count. */
export class TrueFruits {
  readonly group = new THREE.Group();
  private readonly counted = new THREE.MeshBasicMaterial({ wireframe: true });
  private readonly others = new THREE.MeshBasicMaterial({ wireframe: true, transparent: true, opacity: 0.3 });
  private truth: Truth | null = null;

  set(truth: Truth): void {
    this.clear();
    this.truth = truth;
    const ball = new THREE.IcosahedronGeometry(1, 2);
    for (const counts of [true, false]) {
      const fruits = truth.fruits.filter((f) => f.counted === counts);
      const mesh = new THREE.InstancedMesh(ball, counts ? this.counted : this.others, Math.max(1, fruits.length));
      mesh.count = fruits.length;
      mesh.frustumCulled = false;
      fruits.forEach((fruit, i) => {
        const matrix = new THREE.Matrix4().makeScale(fruit.radius, fruit.radius, fruit.radius);
        mesh.setMatrixAt(i, matrix.setPosition(...fruit.centre));
      });
      this.group.add(mesh);
    }
  }

  /** Where they are; empty where there are none. */
  box(): THREE.Box3 {
    const box = new THREE.Box3();
    for (const fruit of this.truth?.fruits ?? []) box.expandByPoint(new THREE.Vector3(...fruit.centre));
    return box;
  }

  paint(palette: Palette): void {
    this.counted.color.set(palette.ink);
    this.others.color.set(palette.ink);
  }

  clear(): void {
    for (const child of [...this.group.children]) dispose(child);
    this.truth = null;
  }
}
