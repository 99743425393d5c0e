import type { Fruit } from "../data/messages.ts";

/** |x|^p with the sign of x. */
function signedPower(x: number, p: number): number {
  return Math.sign(x) * Math.abs(x) ** p;
}

/**
 * A point of the surface in the shape's own frame, by latitude −π/2 … π/2 and longitude:
 * (|x/a|^(2/e2) + |y/b|^(2/e2))^(e2/e1) + |z/c|^(2/e1) = 1.
 */
export function surfacePoint(
  { semiAxes: [a, b, c], e1, e2 }: Pick<Fruit, "semiAxes" | "e1" | "e2">,
  latitude: number,
  longitude: number,
): [number, number, number] {
  const ring = signedPower(Math.cos(latitude), e1);
  return [
    a * ring * signedPower(Math.cos(longitude), e2),
    b * ring * signedPower(Math.sin(longitude), e2),
    c * signedPower(Math.sin(latitude), e1),
  ];
}

/** A closed surface: (rows + 1) × columns points from pole to pole, and its triangles. */
export function surface(
  fruit: Pick<Fruit, "semiAxes" | "e1" | "e2">,
  rows = 14,
  columns = 24,
): { points: Float32Array; triangles: number[] } {
  const points = new Float32Array(3 * (rows + 1) * columns);
  const triangles: number[] = [];
  for (let r = 0; r <= rows; ++r)
    for (let c = 0; c < columns; ++c) {
      const latitude = Math.PI * (r / rows - 0.5);
      points.set(surfacePoint(fruit, latitude, (2 * Math.PI * c) / columns), 3 * (r * columns + c));
      if (r === rows) continue;
      const [low, next] = [r * columns + c, r * columns + ((c + 1) % columns)];
      triangles.push(low, next, low + columns, next, next + columns, low + columns);
    }
  return { points, triangles };
}
