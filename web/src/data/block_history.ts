import { History } from "./history.ts";
import type { Blocks } from "./messages.ts";

/** Blocks of one message at most; enough for the largest map. */
const kBlocks = 2 ** 24;

/** Block indices as one number: 17 bits a coordinate. */
export function blockKey(x: number, y: number, z: number): number {
  return ((x + 65536) * 131072 + (y + 65536)) * 131072 + (z + 65536);
}

export function blockIndex(key: number): [number, number, number] {
  const z = key % 131072;
  const rest = (key - z) / 131072;
  const y = rest % 131072;
  return [(rest - y) / 131072 - 65536, y - 65536, z - 65536];
}

/**
 * Blocks of voxels at every step. Their octets stay where they came in; a version is one number that
 * says where, for a run has hundreds of thousands.
 */
export class BlockHistory {
  private readonly versions = new History<number>();
  private readonly messages: Blocks[] = [];

  add(step: number, blocks: Blocks): void {
    const first = kBlocks * this.messages.push(blocks) - kBlocks;
    const { index, octets, each } = blocks;
    for (let i = 0; 3 * i < index.length; ++i) {
      const key = blockKey(index[3 * i], index[3 * i + 1], index[3 * i + 2]);
      const begin = each * i;
      let empty = true;
      for (let k = begin; empty && k < begin + each; ++k) empty = octets[k] === 0;
      this.versions.set(step, key, empty ? undefined : first + i);
    }
  }

  /** Names the version of a block after a step; nothing where it is empty. */
  at(key: number, step: number): number | undefined {
    return this.versions.at(key, step);
  }

  /** The octets of a version. */
  octets(version: number): Uint8Array {
    const { octets, each } = this.messages[Math.floor(version / kBlocks)];
    const begin = each * (version % kBlocks);
    return octets.subarray(begin, begin + each);
  }

  changedBetween(a: number, b: number): Generator<number> {
    return this.versions.changedBetween(a, b);
  }

  /** All blocks that are not empty. */
  *entriesAt(step: number): Generator<[number, Uint8Array]> {
    for (const [key, version] of this.versions.entriesAt(step)) yield [key, this.octets(version)];
  }
}
