import { FrameError } from "./fields.ts";
import type { Blocks } from "./messages.ts";

/** Takes little-endian numbers off the octets of a message, from the front. */
export class Octets {
  private at = 0;

  constructor(
    private readonly bytes: Uint8Array,
    private readonly where: string,
  ) {}

  /** The next octets, not copied. */
  take(count: number): Uint8Array {
    if (!(count >= 0) || this.at + count > this.bytes.length)
      throw new FrameError(`${this.where}: ${this.bytes.length} octets are too few`);
    this.at += count;
    return this.bytes.subarray(this.at - count, this.at);
  }

  float32(count: number): Float32Array {
    return new Float32Array(this.aligned(count));
  }

  int16(count: number): Int16Array {
    return new Int16Array(this.aligned(count, 2));
  }

  int32(count: number): Int32Array {
    return new Int32Array(this.aligned(count));
  }

  uint32(count: number): Uint32Array {
    return new Uint32Array(this.aligned(count));
  }

  blocks(count: number, each: number): Blocks {
    const left = this.bytes.length - this.at;
    if (count * (12 + each) > left)
      throw new FrameError(`${this.where}: ${left} octets are too few for ${count} blocks`);
    const blocks: Blocks = { index: new Int32Array(3 * count), octets: new Uint8Array(each * count), each };
    const numbers = new DataView(this.bytes.buffer, this.bytes.byteOffset);
    for (let i = 0; i < count; ++i) {
      for (let k = 0; k < 3; ++k) blocks.index[3 * i + k] = numbers.getInt32(this.at + 4 * k, true);
      this.at += 12;
      blocks.octets.set(this.take(each), each * i);
    }
    return blocks;
  }

  /** All must have been taken. */
  finish(): void {
    const left = this.bytes.length - this.at;
    if (left !== 0) throw new FrameError(`${this.where}: ${left} octets too many`);
  }

  /** How many are left. */
  get left(): number {
    return this.bytes.length - this.at;
  }

  /** Typed arrays need their own, aligned memory. */
  private aligned(count: number, each = 4): ArrayBuffer {
    const bytes = this.take(each * count);
    const copy = new ArrayBuffer(bytes.length);
    new Uint8Array(copy).set(bytes);
    return copy;
  }
}
