import type { Vec3 } from "../../src/data/messages.ts";

export interface MadeFruit {
  id: number;
  centre: Vec3;
  radius: number;
}

export interface MadePlants {
  vertices: Float32Array;
  triangles: Uint32Array;
  leafTriangles: number;
  /** Middle and normals of leaves. */
  leaves: { centre: Vec3; u: Vec3; v: Vec3 }[];
  fruits: MadeFruit[];
}

/** Two rows of plants at x = ±0.75 m: leaves are quadrangles around a stem, fruits octahedra. */
export function makePlants(next: () => number, plantsPerRow: number): MadePlants {
  const vertices: number[] = [];
  const triangles: number[] = [];
  const leaves: MadePlants["leaves"] = [];
  const fruits: MadeFruit[] = [];
  const around = (size: number) => size * (2 * next() - 1);
  for (const side of [-1, 1])
    for (let p = 0; p < plantsPerRow; ++p) {
      const foot: Vec3 = [0.75 * side + around(0.05), -1.2 + 0.5 * p + around(0.05), 0];
      const height = 1 + 0.7 * next();
      for (let l = 0; l < 26; ++l) {
        const angle = 2 * Math.PI * next();
        const out = 0.08 + 0.14 * next();
        const centre: Vec3 = [foot[0] + out * Math.cos(angle), foot[1] + out * Math.sin(angle), 0.15 + height * (l / 26)];
        const u: Vec3 = [0.07 * Math.cos(angle), 0.07 * Math.sin(angle), around(0.03)];
        const v: Vec3 = [-0.04 * Math.sin(angle), 0.04 * Math.cos(angle), around(0.02)];
        leaves.push({ centre, u, v });
        const first = vertices.length / 3;
        for (const [a, b] of [[-1, 0], [0, -1], [1, 0], [0, 1]])
          vertices.push(...centre.map((c, i) => c + a * u[i] + b * v[i]));
        triangles.push(first, first + 1, first + 2, first, first + 2, first + 3);
      }
      for (let f = 0; f < 4; ++f) {
        const angle = 2 * Math.PI * next();
        const centre: Vec3 = [foot[0] + 0.1 * Math.cos(angle), foot[1] + 0.1 * Math.sin(angle), 0.3 + 0.7 * height * next()];
        fruits.push({ id: fruits.length, centre, radius: 0.03 + 0.012 * next() });
      }
    }
  const leafTriangles = triangles.length / 3;
  for (const { centre, radius } of fruits) {
    const first = vertices.length / 3;
    for (const d of [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
      vertices.push(...centre.map((c, i) => c + radius * d[i]));
    for (let i = 0; i < 4; ++i) {
      triangles.push(first + i, first + ((i + 1) % 4), first + 4);
      triangles.push(first + ((i + 1) % 4), first + i, first + 5);
    }
  }
  return { vertices: Float32Array.from(vertices), triangles: Uint32Array.from(triangles), leafTriangles, leaves, fruits };
}
