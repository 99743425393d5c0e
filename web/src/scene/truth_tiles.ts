import * as THREE from "three";
import type { Truth, TruthPart } from "../data/messages.ts";
import type { ColoredMesh } from "./simplify.ts";

/** The side of a tile on the ground. */
const kTile_m = 1;

/** Parts by where their first corner stands: what is out of sight need not be drawn, what is far may be coarse. */
export function partsByTile(truth: Truth, parts: TruthPart[]): TruthPart[][] {
  const tiles = new Map<string, TruthPart[]>();
  for (const part of parts) {
    if (part.triangles === 0) continue;
    const corner = 3 * truth.triangles[3 * part.first];
    const key = [0, 1].map((k) => Math.floor(truth.vertices[corner + k] / kTile_m)).join();
    const tile = tiles.get(key);
    if (tile) tile.push(part);
    else tiles.set(key, [part]);
  }
  return [...tiles.values()];
}

/** These parts as one mesh. Vertices are numbered anew for each part, with its colour. */
export function tileMesh(truth: Truth, parts: TruthPart[]): ColoredMesh {
  const corners = 3 * parts.reduce((sum, part) => sum + part.triangles, 0);
  const vertices = new Float32Array(3 * corners);
  const colors = new Float32Array(3 * corners);
  const triangles = new Uint32Array(corners);
  let count = 0;
  let at = 0;
  const numbers = new Map<number, number>();
  for (const part of parts) {
    numbers.clear();
    const [r, g, b] = part.color.map((c) => c / 255);
    const color = new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace).toArray();
    for (let i = 3 * part.first; i < 3 * (part.first + part.triangles); ++i) {
      const corner = truth.triangles[i];
      let number = numbers.get(corner);
      if (number === undefined) {
        numbers.set(corner, (number = count++));
        for (let k = 0; k < 3; ++k) {
          vertices[3 * number + k] = truth.vertices[3 * corner + k];
          colors[3 * number + k] = color[k];
        }
      }
      triangles[at++] = number;
    }
  }
  return { vertices: vertices.slice(0, 3 * count), colors: colors.slice(0, 3 * count), triangles };
}
