import * as THREE from "three";
import type { Truth } from "../data/messages.ts";
import type { Palette } from "../theme.ts";
import { dispose } from "./matrices.ts";

/** What really stands there, in simulation: pale, to be told from what the robot knows. */
export class TruthModel {
  readonly group = new THREE.Group();
  private readonly materials: { material: THREE.MeshLambertMaterial; color: THREE.Color }[] = [];
  private palette: Palette | null = null;

  set(truth: Truth): void {
    this.clear();
    for (const part of truth.parts) {
      const color = new THREE.Color().setRGB(
        part.color[0] / 255,
        part.color[1] / 255,
        part.color[2] / 255,
        THREE.SRGBColorSpace,
      );
      const material = new THREE.MeshLambertMaterial({ side: THREE.DoubleSide, flatShading: true });
      this.materials.push({ material, color });
      const geometry = new THREE.BufferGeometry();
      const [vertices, triangles] = pieceOf(truth, part.first, part.triangles);
      geometry.setAttribute("position", new THREE.BufferAttribute(vertices, 3));
      geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
      this.group.add(new THREE.Mesh(geometry, material));
    }
    if (this.palette) this.paint(this.palette);
  }

  paint(palette: Palette): void {
    this.palette = palette;
    const paper = new THREE.Color(palette.background);
    for (const { material, color } of this.materials) material.color.copy(color).lerp(paper, 0.45);
  }

  clear(): void {
    for (const child of [...this.group.children]) dispose(child);
    this.materials.length = 0;
  }
}

/** A part with vertices of its own, numbered anew. */
function pieceOf(truth: Truth, first: number, count: number): [Float32Array, Uint32Array] {
  const corners = truth.triangles.slice(3 * first, 3 * (first + count));
  const numbers = new Map<number, number>();
  const vertices: number[] = [];
  for (let i = 0; i < corners.length; ++i) {
    let number = numbers.get(corners[i]);
    if (number === undefined) {
      numbers.set(corners[i], (number = numbers.size));
      for (let k = 0; k < 3; ++k) vertices.push(truth.vertices[3 * corners[i] + k]);
    }
    corners[i] = number;
  }
  return [Float32Array.from(vertices), corners];
}
