import * as THREE from "three";
import type { Timeline } from "../data/timeline.ts";
import { upperBound } from "../data/search.ts";
import { kindColor, type Palette } from "../theme.ts";
import { matrixOf } from "./matrices.ts";

/** A small pyramid where each picture was taken, pointing where the camera looked. */
export class ViewMarks {
  readonly group = new THREE.Group();
  private mesh: THREE.InstancedMesh | null = null;
  private made = 0;
  private palette: Palette | null = null;
  private readonly geometry = pyramid();
  private readonly material = new THREE.MeshLambertMaterial({ flatShading: true, side: THREE.DoubleSide });

  show(timeline: Timeline, t: number): void {
    const views = timeline.views;
    if (!this.mesh || this.mesh.instanceMatrix.count < views.length) this.grow(views.length);
    const mesh = this.mesh;
    if (!mesh || !this.palette) return;
    for (; this.made < views.length; ++this.made) {
      const view = views[this.made];
      mesh.setMatrixAt(this.made, matrixOf(view.T_world_camera));
      mesh.setColorAt(this.made, new THREE.Color(kindColor(this.palette, view.kind)));
      mesh.instanceMatrix.needsUpdate = true;
      if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    }
    mesh.count = upperBound(timeline.viewTimes, t);
  }

  paint(palette: Palette): void {
    this.palette = palette;
    this.made = 0;
  }

  reset(): void {
    this.made = 0;
    if (this.mesh) this.mesh.count = 0;
  }

  private grow(wanted: number): void {
    this.mesh?.dispose();
    this.group.clear();
    this.mesh = new THREE.InstancedMesh(this.geometry, this.material, Math.max(64, 2 * wanted));
    this.mesh.frustumCulled = false;
    this.mesh.count = 0;
    this.group.add(this.mesh);
    this.made = 0;
  }
}

/** Its tip is the optical centre; z forward. */
function pyramid(): THREE.BufferGeometry {
  const [w, h, d] = [0.014, 0.01, 0.024];
  const geometry = new THREE.BufferGeometry();
  const corners = [0, 0, 0, -w, -h, d, w, -h, d, w, h, d, -w, h, d];
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(corners, 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1, 1, 3, 2, 1, 4, 3]);
  const flat = geometry.toNonIndexed();
  flat.computeVertexNormals();
  return flat;
}
