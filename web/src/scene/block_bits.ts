// Voxels out of blocks: which of them can be seen, and which way their surface faces.

/** Blocks of a chunk, a side. */
export const kChunkBlocks = 8;
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

/** Appends the visible voxels of the block that begins there. */
function collect(x0: number, y0: number, z0: number, hideInner: boolean, cells: number[], normals: number[]): void {
  for (let z = z0; z < z0 + 8; ++z)
    for (let y = y0; y < y0 + 8; ++y)
      for (let x = x0, at = paddedIndex(x0, y, z); x < x0 + 8; ++x, ++at) {
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
}

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
  for (let bz = 0; bz < kChunkBlocks; ++bz)
    for (let by = 0; by < kChunkBlocks; ++by)
      for (let bx = 0; bx < kChunkBlocks; ++bx)
        if (blocks(bx, by, bz)) collect(8 * bx, 8 * by, 8 * bz, hideInner, cells, normals);
  return { count: cells.length / 4, cells: Uint8Array.from(cells), normals: Int8Array.from(normals) };
}

/** The same surface in cells of 2 × 2 × 2 voxels, for afar. */
export function coarser({ count, cells, normals }: ChunkVoxels): ChunkVoxels {
  const sums = new Map<number, [number, number, number, number]>();
  for (let i = 0; i < 4 * count; i += 4) {
    const key = ((cells[i + 2] >> 1) * kChunk + (cells[i + 1] >> 1)) * kChunk + (cells[i] >> 1);
    let sum = sums.get(key);
    if (!sum) sums.set(key, (sum = [0, 0, 0, 0]));
    for (let k = 0; k < 3; ++k) sum[k] += normals[i + k];
    sum[3] |= cells[i + 3];
  }
  const out = { count: sums.size, cells: new Uint8Array(4 * sums.size), normals: new Int8Array(4 * sums.size) };
  let at = 0;
  for (const [key, [x, y, z, flags]] of sums) {
    const scale = 127 / Math.max(1, Math.hypot(x, y, z));
    out.cells.set([key % kChunk, Math.floor(key / kChunk) % kChunk, Math.floor(key / kChunk ** 2), flags], at);
    out.normals.set([x * scale, y * scale, z * scale, 0], at);
    at += 4;
  }
  return out;
}
