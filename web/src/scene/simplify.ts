/** A mesh with a colour for each vertex. */
export interface ColoredMesh {
  vertices: Float32Array;
  colors: Float32Array;
  triangles: Uint32Array;
}

/**
 * Fewer triangles: vertices of one colour in one cell of a grid become one, their mean. Good enough
 * from afar, and quick.
 */
export function simplify({ vertices, colors, triangles }: ColoredMesh, cell: number): ColoredMesh {
  const count = vertices.length / 3;
  const cellOf = new Uint32Array(count);
  const cells = new Map<string, number>();
  const sums: number[] = [];
  const outColors: number[] = [];
  for (let i = 0; i < count; ++i) {
    const at = 3 * i;
    const key = `${Math.floor(vertices[at] / cell)},${Math.floor(vertices[at + 1] / cell)},${Math.floor(vertices[at + 2] / cell)},${colors[at]},${colors[at + 1]},${colors[at + 2]}`;
    let number = cells.get(key);
    if (number === undefined) {
      cells.set(key, (number = cells.size));
      sums.push(0, 0, 0, 0);
      outColors.push(colors[at], colors[at + 1], colors[at + 2]);
    }
    cellOf[i] = number;
    for (let k = 0; k < 3; ++k) sums[4 * number + k] += vertices[at + k];
    sums[4 * number + 3] += 1;
  }
  const out: number[] = [];
  const seen = new Set<number>();
  for (let i = 0; i + 2 < triangles.length; i += 3) {
    const corners = [cellOf[triangles[i]], cellOf[triangles[i + 1]], cellOf[triangles[i + 2]]];
    const [a, b, c] = [...corners].sort((x, y) => x - y);
    if (a === b || b === c) continue;
    const key = (a * cells.size + b) * cells.size + c;
    if (seen.has(key)) continue;
    seen.add(key);
    out.push(...corners);
  }
  const means = new Float32Array(3 * cells.size);
  for (let i = 0; i < cells.size; ++i)
    for (let k = 0; k < 3; ++k) means[3 * i + k] = sums[4 * i + k] / sums[4 * i + 3];
  return { vertices: means, colors: Float32Array.from(outColors), triangles: Uint32Array.from(out) };
}
