/** A mesh with a colour for each vertex. */
export interface ColoredMesh {
  vertices: Float32Array;
  colors: Float32Array;
  triangles: Uint32Array;
}

/** What a cell gathers of its vertices: sums of place and colour, and how many. */
const kSums = 7;

/**
 * Fewer triangles: vertices in one cell of a grid become one, their mean. Good enough from afar, and
 * quick.
 */
export function simplify({ vertices, colors, triangles }: ColoredMesh, cell: number): ColoredMesh {
  const { cellOf, count } = intoCells(vertices, cell);
  const sums = new Float64Array(kSums * count);
  cellOf.forEach((number, i) => {
    for (let k = 0; k < 3; ++k) {
      sums[kSums * number + k] += vertices[3 * i + k];
      sums[kSums * number + 3 + k] += colors[3 * i + k];
    }
    sums[kSums * number + 6] += 1;
  });
  const mean = (first: number) =>
    Float32Array.from({ length: 3 * count }, (_, i) => {
      const at = kSums * Math.floor(i / 3);
      return sums[at + first + (i % 3)] / sums[at + 6];
    });
  return { vertices: mean(0), colors: mean(3), triangles: remaining(triangles, cellOf, count) };
}

/** The number of each vertex' cell, 0 … count − 1. */
function intoCells(vertices: Float32Array, cell: number): { cellOf: Uint32Array; count: number } {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < vertices.length; ++i) {
    if (vertices[i] < low[i % 3]) low[i % 3] = vertices[i];
    if (vertices[i] > high[i % 3]) high[i % 3] = vertices[i];
  }
  const [nx, ny] = low.map((from, k) => Math.floor((high[k] - from) / cell) + 1);
  const cells = new Map<number, number>();
  const cellOf = new Uint32Array(vertices.length / 3);
  const along = (i: number, k: number) => Math.floor((vertices[3 * i + k] - low[k]) / cell);
  for (let i = 0; i < cellOf.length; ++i) {
    const key = (along(i, 2) * ny + along(i, 1)) * nx + along(i, 0);
    let number = cells.get(key);
    if (number === undefined) cells.set(key, (number = cells.size));
    cellOf[i] = number;
  }
  return { cellOf, count: cells.size };
}

/** Triangles between three different cells, each once. */
function remaining(triangles: Uint32Array, cellOf: Uint32Array, count: number): Uint32Array {
  const out = new Uint32Array(triangles.length);
  const seen = new Set<number>();
  let length = 0;
  for (let i = 0; i + 2 < triangles.length; i += 3) {
    const [a, b, c] = [cellOf[triangles[i]], cellOf[triangles[i + 1]], cellOf[triangles[i + 2]]];
    if (a === b || b === c || c === a) continue;
    const low = Math.min(a, b, c);
    const high = Math.max(a, b, c);
    const key = (low * count + (a + b + c - low - high)) * count + high;
    if (seen.has(key)) continue;
    seen.add(key);
    out.set([a, b, c], length);
    length += 3;
  }
  return out.slice(0, length);
}
