import { deflateSync } from "node:zlib";

/** A frame as it goes over the wire: a line of JSON, and octets. */
export function frame(head: Record<string, unknown>, ...octets: ArrayBufferView[]): Uint8Array {
  const parts = octets.map((o) => Buffer.from(o.buffer, o.byteOffset, o.byteLength));
  const payload = Buffer.concat(parts);
  return Buffer.concat([Buffer.from(`${JSON.stringify({ ...head, bytes: payload.length })}\n`), payload]);
}

/** [uint32 length][frame] after the other. */
export function file(frames: Uint8Array[]): Uint8Array {
  return Buffer.concat(
    frames.flatMap((f) => {
      const length = Buffer.alloc(4);
      length.writeUInt32LE(f.length);
      return [length, f];
    }),
  );
}

function crc(data: Uint8Array): number {
  let c = ~0;
  for (const byte of data) {
    c ^= byte;
    for (let k = 0; k < 8; ++k) c = (c >>> 1) ^ (c & 1 ? 0xedb88320 : 0);
  }
  return ~c >>> 0;
}

/** An 8 bit PNG: grey with one channel, RGB with three. */
export function png(width: number, height: number, channels: 1 | 3, pixels: Uint8Array): Uint8Array {
  const chunk = (name: string, data: Uint8Array) => {
    const body = Buffer.concat([Buffer.from(name), data]);
    const length = Buffer.alloc(4);
    length.writeUInt32BE(data.length);
    const sum = Buffer.alloc(4);
    sum.writeUInt32BE(crc(body));
    return Buffer.concat([length, body, sum]);
  };
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, channels === 1 ? 0 : 2, 0, 0, 0], 8);
  const row = width * channels;
  const lines = Buffer.alloc((row + 1) * height);
  for (let y = 0; y < height; ++y) lines.set(pixels.subarray(y * row, (y + 1) * row), y * (row + 1) + 1);
  return Buffer.concat([
    Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]),
    chunk("IHDR", head),
    chunk("IDAT", deflateSync(lines)),
    chunk("IEND", new Uint8Array(0)),
  ]);
}

/** Numbers between 0 and 1, the same ones for the same seed. */
export function random(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}
