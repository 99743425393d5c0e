import * as THREE from "three";
import { blockIndex, blockKey } from "../data/timeline.ts";
import type { History } from "../data/history.ts";
import { type ChunkVoxels, chunkVoxels, kChunk, kChunkBlocks } from "./block_bits.ts";

/** What a cloud of voxels looks like. */
export interface CloudLook {
  /** Sets of 64 octets a block has. */
  sets: number;
  /** Voxels with neighbours all around are left out. */
  hideInner: boolean;
  /** Draws one point per voxel. */
  points: THREE.ShaderMaterial;
  /** Draws one cube per voxel near the camera; none: always points. */
  cubes?: THREE.ShaderMaterial;
}

interface Chunk {
  box: THREE.Box3;
  origin: THREE.Vector3;
  voxels: ChunkVoxels;
  points: THREE.Points;
  cubes: THREE.Mesh | null;
}

/** Milliseconds a frame may spend on new chunks. */
const kBudget_ms = 10;

/** Voxels in blocks, drawn chunk by chunk; only what changed between two moments is made anew. */
export class BlockCloud {
  readonly group = new THREE.Group();
  /** Voxels drawn as cubes at most; the others are points. */
  cubeLimit = 150000;
  private readonly blocks = new Map<number, Uint8Array>();
  private readonly chunks = new Map<number, Chunk>();
  private readonly dirty = new Set<number>();
  private shown = -1;
  private resolution = 0.01;

  constructor(private readonly look: CloudLook) {}

  /** Voxels that are drawn. */
  get count(): number {
    let count = 0;
    for (const chunk of this.chunks.values()) count += chunk.voxels.count;
    return count;
  }

  /** Forgets all; voxels are so large from now on. */
  reset(resolution: number): void {
    for (const key of [...this.chunks.keys()]) this.drop(key);
    this.blocks.clear();
    this.dirty.clear();
    this.shown = -1;
    this.resolution = resolution;
    for (const material of [this.look.points, this.look.cubes])
      if (material) material.uniforms.size.value = resolution;
  }

  /** Shows the history after this step. */
  show(history: History<Uint8Array>, step: number): void {
    if (step === this.shown) return;
    for (const key of history.changedBetween(this.shown, step)) {
      const block = history.at(key, step);
      if (block === this.blocks.get(key)) continue;
      if (block) this.blocks.set(key, block);
      else this.blocks.delete(key);
      this.touch(key);
    }
    this.shown = step;
  }

  /** Makes what is not made yet, as much as time allows; true: there is more. */
  update(camera: THREE.Camera, cubesWithin: number): boolean {
    const begin = performance.now();
    for (const key of this.dirty) {
      this.make(key);
      this.dirty.delete(key);
      if (performance.now() - begin > kBudget_ms) break;
    }
    if (this.look.cubes) this.chooseCubes(camera, cubesWithin);
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
      this.blocks.get(blockKey(ox + x, oy + y, oz + z));
    const voxels = chunkVoxels(lookup, this.look.sets, this.look.hideInner);
    if (voxels.count === 0) return;
    const edge = kChunk * this.resolution;
    const origin = new THREE.Vector3(cx, cy, cz).multiplyScalar(edge);
    const box = new THREE.Box3(origin, origin.clone().addScalar(edge));
    const points = this.makePoints(voxels, box);
    points.position.copy(origin);
    this.group.add(points);
    this.chunks.set(key, { box, origin, voxels, points, cubes: null });
  }

  private makePoints(voxels: ChunkVoxels, box: THREE.Box3): THREE.Points {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("cell", new THREE.BufferAttribute(voxels.cells, 4));
    geometry.setAttribute("facing", new THREE.BufferAttribute(voxels.normals, 4, true));
    geometry.setDrawRange(0, voxels.count);
    geometry.boundingSphere = sphereOf(box);
    return new THREE.Points(geometry, this.look.points);
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

  /** The nearest chunks become cubes, as far as the limit goes. */
  private chooseCubes(camera: THREE.Camera, within: number): void {
    const near = [...this.chunks.values()]
      .map((chunk) => ({ chunk, distance: chunk.box.distanceToPoint(camera.position) }))
      .sort((a, b) => a.distance - b.distance);
    let left = this.cubeLimit;
    for (const { chunk, distance } of near) {
      left -= chunk.voxels.count;
      const asCubes = distance < within && left >= 0;
      if (asCubes && !chunk.cubes) {
        chunk.cubes = this.makeCubes(chunk.voxels, chunk.box);
        chunk.cubes.position.copy(chunk.origin);
        this.group.add(chunk.cubes);
      }
      if (chunk.cubes) chunk.cubes.visible = asCubes;
      chunk.points.visible = !asCubes;
    }
  }

  private drop(key: number): void {
    const chunk = this.chunks.get(key);
    if (!chunk) return;
    for (const object of [chunk.points, chunk.cubes]) {
      if (!object) continue;
      object.geometry.dispose();
      this.group.remove(object);
    }
    this.chunks.delete(key);
  }
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
