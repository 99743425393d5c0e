import { depthTable } from "./false_color.ts";
import type { Grey } from "./picture_store.ts";

/** The detection's colour over the picture: stands out from leaves and from fruits. */
const kOverlay = [0, 235, 255];

const kDepthColors = depthTable();

/** Grey values as a picture with colours. */
function tinted(grey: Grey, colorOf: (i: number, out: Uint8ClampedArray, at: number) => void): OffscreenCanvas | null {
  const canvas = new OffscreenCanvas(grey.width, grey.height);
  const image = new ImageData(grey.width, grey.height);
  for (let i = 0; i < grey.pixels.length; ++i) colorOf(i, image.data, 4 * i);
  canvas.getContext("2d")?.putImageData(image, 0, 0);
  return canvas;
}

/** What was taken for fruit: its rim strong, its inside faint. */
export function detectionOverlay(mask: Grey): OffscreenCanvas | null {
  const { width: w, height: h, pixels } = mask;
  return tinted(mask, (i, out, at) => {
    if (pixels[i] === 0) return;
    const [x, y] = [i % w, Math.floor(i / w)];
    const rim =
      (x > 0 && pixels[i - 1] === 0) ||
      (x < w - 1 && pixels[i + 1] === 0) ||
      (y > 0 && pixels[i - w] === 0) ||
      (y < h - 1 && pixels[i + w] === 0);
    out.set([...kOverlay, rim ? 255 : 70], at);
  });
}

/** Depth in colours; nothing where there was no return. */
export function depthPicture(depth: Grey): OffscreenCanvas | null {
  return tinted(depth, (i, out, at) => {
    const value = 4 * depth.pixels[i];
    out.set(kDepthColors.subarray(value, value + 4), at);
  });
}

/** Draws pictures over all of a canvas, which takes the size of the first. */
export function paintLayers(canvas: HTMLCanvasElement, layers: (CanvasImageSource & { width: number; height: number } | null)[]): void {
  const there = layers.filter((l) => l !== null);
  const context = canvas.getContext("2d");
  if (!context) return;
  if (there.length === 0) {
    context.clearRect(0, 0, canvas.width, canvas.height);
    return;
  }
  const { width, height } = there[0];
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  context.clearRect(0, 0, width, height);
  context.imageSmoothingEnabled = false;
  for (const layer of there) context.drawImage(layer, 0, 0, width, height);
}
