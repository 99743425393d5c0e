import * as THREE from "three";
import type { Truth, TruthPart } from "../data/messages.ts";
import type { Palette } from "../theme.ts";
import { dispose } from "./matrices.ts";
import { partsByTile, tileMesh } from "./truth_tiles.ts";
import { type ColoredMesh, simplify } from "./simplify.ts";

/** What belongs to plants; the rest is around them. */
const kPlantParts = new Set(["leaf", "stem", "fruit"]);

/** Cells of the coarser meshes, the last one for afar; 0: as it was sent. */
const kCells_m = [0, 0.018, 0.03, 0.05, 0.08, 0.13];

/** How much of the true colours is left. */
const kStrength = 0.6;

/** A piece of what stands there, finer and coarser. */
interface Tile {
  group: THREE.Group;
  parts: TruthPart[];
  box: THREE.Box3;
  /** By level; made when they are needed. */
  meshes: { drawn: THREE.Mesh; mesh: ColoredMesh }[];
}

/** How a frame is to be drawn. */
export interface TruthDetail {
  /** Pixels of a metre at one metre. */
  pixels: number;
  /** Cells up to so many pixels. */
  cellPixels: number;
  /** Not as finely as it was sent, however near. */
  coarse: boolean;
  /** Milliseconds that may be spent on new tiles. */
  budget_ms: number;
}

/** What really stands there, in simulation: pale, to be told from what the robot knows. */
export class TruthModel {
  readonly plants = new THREE.Group();
  readonly around = new THREE.Group();
  private truth: Truth | null = null;
  private tiles: Tile[] = [];
  private readonly material = new THREE.MeshLambertMaterial({
    side: THREE.DoubleSide,
    flatShading: true,
    vertexColors: true,
  });

  constructor() {
    // After the map, which hides most of them: what is hidden costs no pixels.
    for (const group of [this.plants, this.around]) group.renderOrder = 1;
  }

  set(truth: Truth): void {
    this.clear();
    this.truth = truth;
    for (const [group, parts] of [
      [this.plants, truth.parts.filter((p) => kPlantParts.has(p.what))],
      [this.around, truth.parts.filter((p) => !kPlantParts.has(p.what))],
    ] as const)
      for (const tile of partsByTile(truth, parts)) this.tiles.push({ group, parts: tile, box: new THREE.Box3(), meshes: [] });
  }

  /** Tiles that are not made yet. */
  get pending(): number {
    return this.tiles.reduce((sum, { meshes }) => sum + (meshes.length === 0 ? 1 : 0), 0);
  }

  /** Makes what is not made yet, as much as time allows, and chooses how fine each tile is; true: there is more. */
  update(camera: THREE.Camera, { pixels, cellPixels, coarse, budget_ms }: TruthDetail): boolean {
    const begin = performance.now();
    for (const tile of this.tiles) {
      if (performance.now() - begin > budget_ms) return true;
      if (tile.meshes.length === 0) this.build(tile);
      if (!tile.group.visible) continue;
      const largest = (cellPixels / pixels) * tile.box.distanceToPoint(camera.position);
      const byDistance = kCells_m.findLastIndex((cell) => cell <= largest);
      const level = Math.max(byDistance, coarse ? 1 : 0);
      tile.meshes[level] ??= this.levelOf(tile, level);
      tile.meshes.forEach(({ drawn }, l) => (drawn.visible = l === level));
    }
    return false;
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
    this.tiles = [];
    this.truth = null;
  }

  private build(tile: Tile): void {
    if (!this.truth) return;
    const mesh = tileMesh(this.truth, tile.parts);
    tile.box.setFromArray(mesh.vertices);
    tile.meshes.push({ mesh, drawn: this.make(mesh, tile.group) });
  }

  private levelOf({ meshes, group }: Tile, level: number): Tile["meshes"][number] {
    const mesh = simplify(meshes[0].mesh, kCells_m[level]);
    return { mesh, drawn: this.make(mesh, group) };
  }

  private make({ vertices, colors, triangles }: ColoredMesh, group: THREE.Group): THREE.Mesh {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(vertices, 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(colors, 3));
    geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
    const drawn = new THREE.Mesh(geometry, this.material);
    group.add(drawn);
    return drawn;
  }
}
