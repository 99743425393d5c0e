import type { Fruit } from "./data/messages.ts";

/** The brightest channel of a fruit's colour as it is shown. */
const kBrightest = 222;

/** A fruit's colour without its shadows: hue as the camera saw it, brightness for the eye. 0 … 255 */
export function fruitColor({ color }: Fruit): [number, number, number] {
  const most = Math.max(1, ...color);
  return color.map((c) => Math.round((Math.max(0, c) * kBrightest) / most)) as [number, number, number];
}

/** The same for style sheets. */
export function fruitCss(fruit: Fruit): string {
  return `rgb(${fruitColor(fruit).join()})`;
}
