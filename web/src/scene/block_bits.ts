// Voxels out of blocks: which of them can be seen, and which way their surface faces.

/** Blocks of a chunk, a side. */
export const kChunkBlocks = 4;
/** Voxels of a chunk, a side. */
export const kChunk = 8 * kChunkBlocks;
const kPadded = kChunk + 2;

/** The voxels of one chunk: x, y, z in the chunk and flags; surface normal (0: none) each. */
export interface ChunkVoxels {
  count: number;
  cells: Uint8Array; // 4 each
  normals: Int8Array; // 4 each, the last unused
}

/** Octets of a block by its place in the chunk, −1 … kChunkBlocks. */
export type BlockLookup = (x: number, y: number, z: number) => Uint8Array | undefined;

const padded = new Uint8Array(kPadded ** 3);

function paddedIndex(x: number, y: number, z: number): number {
  return ((z + 1) * kPadded + (y + 1)) * kPadded + (x + 1);
}

/** Writes one set (64 octets) of a block as a flag into the padded chunk. */
function spread(block: Uint8Array, set: number, bx: number, by: number, bz: number): void {
  for (let j = 0; j < 64; ++j) {
    const octet = block[64 * set + j];
    if (octet === 0) continue;
    const y = 8 * by + (j & 7);
    const z = 8 * bz + (j >> 3);
    if (y < -1 || y > kChunk || z < -1 || z > kChunk) continue;
    for (let i = 0; i < 8; ++i) {
      const x = 8 * bx + i;
      if ((octet >> i) & 1 && x >= -1 && x <= kChunk) padded[paddedIndex(x, y, z)] |= 1 << set;
    }
  }
}

/** All 26 neighbours: direction and distance in the padded chunk. */
const kNeighbours = (() => {
  const list: { step: number; x: number; y: number; z: number; face: boolean }[] = [];
  for (let z = -1; z <= 1; ++z)
    for (let y = -1; y <= 1; ++y)
      for (let x = -1; x <= 1; ++x)
        if (x || y || z) {
          const step = (z * kPadded + y) * kPadded + x;
          list.push({ step, x, y, z, face: Math.abs(x) + Math.abs(y) + Math.abs(z) === 1 });
        }
  return list;
})();

/**
 * The voxels of a chunk that have a free side (or all of them); `sets`: how many sets of 64 octets a
 * block has. Flag bit i: the voxel is in set i.
 */
export function chunkVoxels(blocks: BlockLookup, sets: number, hideInner: boolean): ChunkVoxels {
  padded.fill(0);
  const rim = hideInner ? 1 : 0;
  for (let bz = -rim; bz < kChunkBlocks + rim; ++bz)
    for (let by = -rim; by < kChunkBlocks + rim; ++by)
      for (let bx = -rim; bx < kChunkBlocks + rim; ++bx) {
        const block = blocks(bx, by, bz);
        if (block) for (let set = 0; set < sets; ++set) spread(block, set, bx, by, bz);
      }

  const cells: number[] = [];
  const normals: number[] = [];
  for (let z = 0; z < kChunk; ++z)
    for (let y = 0; y < kChunk; ++y)
      for (let x = 0, at = paddedIndex(0, y, z); x < kChunk; ++x, ++at) {
        const flags = padded[at];
        if (flags === 0) continue;
        let [nx, ny, nz, free] = [0, 0, 0, false];
        for (const n of kNeighbours) {
          if (padded[at + n.step] !== 0) continue;
          nx += n.x;
          ny += n.y;
          nz += n.z;
          free ||= n.face;
        }
        if (hideInner && !free) continue;
        const length = Math.hypot(nx, ny, nz);
        const scale = length > 0.5 ? 127 / length : 0;
        cells.push(x, y, z, flags);
        normals.push(Math.round(nx * scale), Math.round(ny * scale), Math.round(nz * scale), 0);
      }
  return { count: cells.length / 4, cells: Uint8Array.from(cells), normals: Int8Array.from(normals) };
}
