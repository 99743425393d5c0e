import * as THREE from "three";
import type { Truth, TruthPart } from "../data/messages.ts";
import type { Palette } from "../theme.ts";
import { dispose } from "./matrices.ts";
import { type ColoredMesh, simplify } from "./simplify.ts";

/** What belongs to plants; the rest is around them. */
const kPlantParts = new Set(["leaf", "stem", "fruit"]);

/** Cells of the coarse mesh. */
const kCell_m = 0.018;

/** How much of the true colours is left. */
const kStrength = 0.6;

/** What really stands there, in simulation: pale, to be told from what the robot knows. */
export class TruthModel {
  readonly plants = new THREE.Group();
  readonly around = new THREE.Group();
  private readonly material = new THREE.MeshLambertMaterial({
    side: THREE.DoubleSide,
    flatShading: true,
    vertexColors: true,
  });

  set(truth: Truth): void {
    this.clear();
    for (const [group, parts] of [
      [this.plants, truth.parts.filter((p) => kPlantParts.has(p.what))],
      [this.around, truth.parts.filter((p) => !kPlantParts.has(p.what))],
    ] as const) {
      const mesh = meshOf(truth, parts);
      group.add(this.make(mesh));
      if (mesh.triangles.length > 3 * 20000) group.add(this.make(simplify(mesh, kCell_m)));
    }
    this.setCoarse(false);
  }

  /** Draws fewer triangles. */
  setCoarse(coarse: boolean): void {
    for (const group of [this.plants, this.around]) {
      const last = group.children.length - 1;
      group.children.forEach((child, i) => (child.visible = i === (coarse ? last : 0)));
    }
  }

  paint(palette: Palette): void {
    this.material.color.setScalar(kStrength);
    this.material.emissive.set(palette.background).multiplyScalar(1 - kStrength);
  }

  /** A corner of a plant. */
  somewhere(): [number, number, number] {
    const mesh = this.plants.children[0] as THREE.Mesh | undefined;
    const position = mesh?.geometry.getAttribute("position");
    if (!position) return [0, 0, 0];
    const triangle = mesh?.geometry.index?.array.slice(0, 3) ?? [0, 1, 2];
    const mean = (k: number) => [0, 1, 2].reduce((sum, i) => sum + position.getComponent(triangle[i], k) / 3, 0);
    return [mean(0), mean(1), mean(2)];
  }

  clear(): void {
    for (const group of [this.plants, this.around]) for (const child of [...group.children]) dispose(child);
  }

  private make({ vertices, colors, triangles }: ColoredMesh): THREE.Mesh {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(vertices, 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(colors, 3));
    geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
    return new THREE.Mesh(geometry, this.material);
  }
}

/** These parts as one mesh. */
function meshOf(truth: Truth, parts: TruthPart[]): ColoredMesh {
  const numbers = new Int32Array(truth.vertices.length / 3);
  const vertices: number[] = [];
  const colors: number[] = [];
  const triangles: number[] = [];
  for (const part of parts) {
    // Vertices are numbered anew for each part, with its colour.
    numbers.fill(-1);
    const color = new THREE.Color().setRGB(
      part.color[0] / 255,
      part.color[1] / 255,
      part.color[2] / 255,
      THREE.SRGBColorSpace,
    );
    for (let i = 3 * part.first; i < 3 * (part.first + part.triangles); ++i) {
      const corner = truth.triangles[i];
      if (numbers[corner] < 0) {
        numbers[corner] = vertices.length / 3;
        for (let k = 0; k < 3; ++k) vertices.push(truth.vertices[3 * corner + k]);
        colors.push(color.r, color.g, color.b);
      }
      triangles.push(numbers[corner]);
    }
  }
  return {
    vertices: Float32Array.from(vertices),
    colors: Float32Array.from(colors),
    triangles: Uint32Array.from(triangles),
  };
}
