import * as THREE from "three";
import type { ChunkVoxels } from "./block_bits.ts";

/** Cells of a chunk, and where the chunk begins, in such cells. */
export interface FarCells {
  cells: ChunkVoxels;
  begin: readonly [number, number, number];
}

/** The largest cells of many chunks, drawn at once: each drawing by itself costs more than its few points. */
export class FarPoints {
  readonly points: THREE.Points;

  constructor(material: THREE.Material) {
    this.points = new THREE.Points(new THREE.BufferGeometry(), material);
    this.points.frustumCulled = false;
    this.points.visible = false;
  }

  /** These, and no others. */
  set(chunks: FarCells[]): void {
    const count = chunks.reduce((sum, { cells }) => sum + cells.count, 0);
    const places = new Int16Array(4 * count);
    const normals = new Int8Array(4 * count);
    let at = 0;
    for (const { cells, begin } of chunks) {
      for (let i = 0; i < 4 * cells.count; ++i) places[at + i] = cells.cells[i] + (begin[i & 3] ?? 0);
      normals.set(cells.normals, at);
      at += 4 * cells.count;
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("cell", new THREE.BufferAttribute(places, 4));
    geometry.setAttribute("facing", new THREE.BufferAttribute(normals, 4, true));
    geometry.setDrawRange(0, count);
    this.points.geometry.dispose();
    this.points.geometry = geometry;
    this.points.visible = count > 0;
  }
}
