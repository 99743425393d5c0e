/** Viridis at ninths, from far (dark) to near (bright); even in brightness, for all eyes. */
const kStops = [
  [68, 1, 84],
  [71, 44, 122],
  [59, 81, 139],
  [44, 113, 142],
  [33, 144, 141],
  [39, 173, 129],
  [92, 200, 99],
  [170, 220, 50],
  [253, 231, 37],
];

/** 0 … 1 */
export function viridis(share: number): [number, number, number] {
  const x = Math.min(Math.max(share, 0), 1) * (kStops.length - 1);
  const i = Math.min(Math.floor(x), kStops.length - 2);
  const w = x - i;
  const mix = (c: number) => Math.round((1 - w) * kStops[i][c] + w * kStops[i + 1][c]);
  return [mix(0), mix(1), mix(2)];
}

/** Colours of depths 1 … 255, near ones bright; RGBA. */
export function depthTable(): Uint8ClampedArray {
  const table = new Uint8ClampedArray(256 * 4);
  for (let i = 1; i < 256; ++i) table.set([...viridis((255 - i) / 254), 255], 4 * i);
  return table;
}

/** The scale as a style sheet's gradient, near to far. */
export function depthGradient(): string {
  const stops = [...kStops].reverse().map((c) => `rgb(${c.join()})`);
  return `linear-gradient(to right, ${stops.join()})`;
}
