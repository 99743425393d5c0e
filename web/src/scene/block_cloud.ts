import * as THREE from "three";
import { type BlockHistory, blockIndex, blockKey } from "../data/block_history.ts";
import { type ChunkVoxels, chunkVoxels, coarser, kChunk, kChunkBlocks } from "./block_bits.ts";
import { type FarCells, FarPoints } from "./far_points.ts";

/** What a cloud of voxels looks like. */
export interface CloudLook {
  /** Sets of 64 octets a block has. */
  sets: number;
  /** Voxels with neighbours all around are left out. */
  hideInner: boolean;
  /** Draw one point per voxel, per 2 × 2 × 2, 4 × 4 × 4 and so on. */
  points: THREE.ShaderMaterial[];
  /** Draws one cube per voxel near the camera; none: always points. */
  cubes?: THREE.ShaderMaterial;
}

interface Chunk {
  box: THREE.Box3;
  origin: THREE.Vector3;
  voxels: ChunkVoxels;
  /** By level: voxels, and larger cells; made when they are needed. The largest are drawn with those of other chunks. */
  points: THREE.Points[];
  largest: ChunkVoxels | null;
  /** −1: cubes. */
  level: number;
  cubes: THREE.Mesh | null;
}

/** How a frame is to be drawn. */
export interface Detail {
  /** Cubes up to this distance from the camera, metres. */
  cubesWithin: number;
  /** Cells of twice the size beyond this one, of twice that beyond its double, and so on. */
  coarseBeyond: number;
  /** Milliseconds that may be spent on new chunks. */
  budget_ms: number;
}

/** Voxels in blocks, drawn chunk by chunk; only what changed between two moments is made anew. */
export class BlockCloud {
  readonly group = new THREE.Group();
  /** Voxels drawn as cubes at most; the others are points. */
  cubeLimit = 150000;
  private readonly blocks = new Map<number, { version: number; octets: Uint8Array }>();
  private readonly chunks = new Map<number, Chunk>();
  private readonly dirty = new Set<number>();
  private readonly far: FarPoints;
  private farChanged = false;
  private shown = -1;
  private resolution = 0.01;

  constructor(private readonly look: CloudLook) {
    this.far = new FarPoints(look.points[look.points.length - 1]);
    this.group.add(this.far.points);
  }

  /** Voxels that are drawn. */
  get count(): number {
    let count = 0;
    for (const chunk of this.chunks.values()) count += chunk.voxels.count;
    return count;
  }

  /** Chunks that are not made yet. */
  get pending(): number {
    return this.dirty.size;
  }

  /** The middle of a voxel that has all these flags, at least half a metre above the floor. */
  somewhere(flags: number): [number, number, number] {
    const size = this.resolution;
    for (const { voxels, origin } of this.chunks.values())
      for (let i = 0; i < 4 * voxels.count; i += 4) {
        if ((voxels.cells[i + 3] & flags) !== flags) continue;
        const at = [0, 1, 2].map((k) => origin.getComponent(k) + (voxels.cells[i + k] + 0.5) * size);
        if (at[2] > 0.5) return [at[0], at[1], at[2]];
      }
    return [0, 0, 0];
  }

  /** Forgets all; voxels are so large from now on. */
  reset(resolution: number): void {
    for (const key of [...this.chunks.keys()]) this.drop(key);
    this.blocks.clear();
    this.dirty.clear();
    this.shown = -1;
    this.resolution = resolution;
    const { points, cubes } = this.look;
    points.forEach((material, level) => (material.uniforms.size.value = resolution * 2 ** level));
    if (cubes) cubes.uniforms.size.value = resolution;
  }

  /** Shows the history after this step. */
  show(history: BlockHistory, step: number): void {
    if (step === this.shown) return;
    for (const key of history.changedBetween(this.shown, step)) {
      const version = history.at(key, step);
      if (version === this.blocks.get(key)?.version) continue;
      if (version === undefined) this.blocks.delete(key);
      else this.blocks.set(key, { version, octets: history.octets(version) });
      this.touch(key);
    }
    this.shown = step;
  }

  /** Makes what is not made yet, as much as time allows; true: there is more. */
  update(camera: THREE.Camera, detail: Detail): boolean {
    const begin = performance.now();
    for (const key of this.dirty) {
      this.make(key);
      this.dirty.delete(key);
      if (performance.now() - begin > detail.budget_ms) break;
    }
    this.chooseDetail(camera, detail);
    return this.dirty.size > 0;
  }

  private touch(key: number): void {
    const [x, y, z] = blockIndex(key);
    this.dirty.add(chunkOf(x, y, z));
    if (!this.look.hideInner) return;
    // Its neighbours may have become visible.
    for (const d of [-1, 1]) {
      for (const other of [chunkOf(x + d, y, z), chunkOf(x, y + d, z), chunkOf(x, y, z + d)])
        if (this.chunks.has(other)) this.dirty.add(other);
    }
  }

  private make(key: number): void {
    this.drop(key);
    const [cx, cy, cz] = blockIndex(key);
    const [ox, oy, oz] = [cx * kChunkBlocks, cy * kChunkBlocks, cz * kChunkBlocks];
    const lookup = (x: number, y: number, z: number) =>
      this.blocks.get(blockKey(ox + x, oy + y, oz + z))?.octets;
    const voxels = chunkVoxels(lookup, this.look.sets, this.look.hideInner);
    if (voxels.count === 0) return;
    const edge = kChunk * this.resolution;
    const origin = new THREE.Vector3(cx, cy, cz).multiplyScalar(edge);
    const box = new THREE.Box3(origin, origin.clone().addScalar(edge));
    this.chunks.set(key, { box, origin, voxels, points: [], largest: null, level: 0, cubes: null });
  }

  private makeCubes(voxels: ChunkVoxels, box: THREE.Box3): THREE.Mesh {
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setAttribute("position", threeFaces());
    geometry.setIndex([0, 1, 2, 2, 1, 3, 4, 5, 6, 6, 5, 7, 8, 9, 10, 10, 9, 11]);
    geometry.setAttribute("cell", new THREE.InstancedBufferAttribute(voxels.cells, 4));
    geometry.setAttribute("facing", new THREE.InstancedBufferAttribute(voxels.normals, 4, true));
    geometry.instanceCount = voxels.count;
    geometry.boundingSphere = sphereOf(box);
    return new THREE.Mesh(geometry, this.look.cubes);
  }

  private place<T extends THREE.Object3D>(object: T, origin: THREE.Vector3): T {
    object.position.copy(origin);
    this.group.add(object);
    return object;
  }

  /** The nearest chunks become cubes, as far as the limit goes; those far away become coarse. */
  private chooseDetail(camera: THREE.Camera, { cubesWithin, coarseBeyond }: Detail): void {
    const near = [...this.chunks.values()]
      .map((chunk) => ({ chunk, distance: chunk.box.distanceToPoint(camera.position) }))
      .sort((a, b) => a.distance - b.distance);
    const coarsest = this.look.points.length - 1;
    let left = this.look.cubes ? this.cubeLimit : 0;
    for (const { chunk, distance } of near) {
      left -= chunk.voxels.count;
      const asCubes = distance < cubesWithin && left >= 0;
      const level = asCubes ? -1 : Math.min(coarsest, Math.max(0, 1 + Math.floor(Math.log2(distance / coarseBeyond))));
      if (chunk.level !== level && (chunk.level === coarsest || level === coarsest)) this.farChanged = true;
      chunk.level = level;
      if (asCubes) chunk.cubes ??= this.place(this.makeCubes(chunk.voxels, chunk.box), chunk.origin);
      else if (level === coarsest) chunk.largest ??= coarserBy(level, chunk.voxels);
      else chunk.points[level] ??= this.place(this.makePoints(chunk, level), chunk.origin);
      if (chunk.cubes) chunk.cubes.visible = asCubes;
      chunk.points.forEach((points, l) => (points.visible = l === level));
    }
    if (this.farChanged) this.far.set([...this.farCells(coarsest)]);
    this.farChanged = false;
  }

  private *farCells(coarsest: number): Generator<FarCells> {
    for (const [key, { level, largest }] of this.chunks) {
      if (level !== coarsest || !largest) continue;
      const [x, y, z] = blockIndex(key);
      const side = kChunk / 2 ** coarsest;
      yield { cells: largest, begin: [x * side, y * side, z * side] };
    }
  }

  private makePoints({ voxels, box }: Chunk, level: number): THREE.Points {
    return makePoints(coarserBy(level, voxels), box, this.look.points[level]);
  }

  private drop(key: number): void {
    const chunk = this.chunks.get(key);
    if (!chunk) return;
    if (chunk.largest) this.farChanged = true;
    for (const object of [...chunk.points, chunk.cubes]) {
      if (!object) continue;
      object.geometry.dispose();
      this.group.remove(object);
    }
    this.chunks.delete(key);
  }
}

function coarserBy(levels: number, voxels: ChunkVoxels): ChunkVoxels {
  for (let l = 0; l < levels; ++l) voxels = coarser(voxels);
  return voxels;
}

function makePoints(voxels: ChunkVoxels, box: THREE.Box3, material: THREE.Material): THREE.Points {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("cell", new THREE.BufferAttribute(voxels.cells, 4));
  geometry.setAttribute("facing", new THREE.BufferAttribute(voxels.normals, 4, true));
  geometry.setDrawRange(0, voxels.count);
  geometry.boundingSphere = sphereOf(box);
  return new THREE.Points(geometry, material);
}

function chunkOf(x: number, y: number, z: number): number {
  return blockKey(
    Math.floor(x / kChunkBlocks),
    Math.floor(y / kChunkBlocks),
    Math.floor(z / kChunkBlocks),
  );
}

/** Bounding spheres are in the chunk's own frame. */
function sphereOf(box: THREE.Box3): THREE.Sphere {
  const sphere = box.getBoundingSphere(new THREE.Sphere());
  sphere.center.sub(box.min);
  return sphere;
}

/** Three faces of the cube ±0.5; the shader turns them to the camera. */
function threeFaces(): THREE.BufferAttribute {
  const corners: number[] = [];
  for (let axis = 0; axis < 3; ++axis)
    for (const [u, v] of [[-0.5, -0.5], [0.5, -0.5], [-0.5, 0.5], [0.5, 0.5]]) {
      const corner = [0, 0, 0];
      corner[axis] = 0.5;
      corner[(axis + 1) % 3] = u;
      corner[(axis + 2) % 3] = v;
      corners.push(...corner);
    }
  return new THREE.BufferAttribute(Float32Array.from(corners), 3);
}
