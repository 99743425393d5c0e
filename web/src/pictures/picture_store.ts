import type { Picture } from "../data/messages.ts";
import type { Timeline } from "../data/timeline.ts";

/** A picture of one value a pixel. */
export interface Grey {
  width: number;
  height: number;
  pixels: Uint8Array;
}

/** Decoded pictures kept at most, of each sort. */
const kKept = 48;

/** Decodes pictures of views when they are asked for, and keeps the last ones. */
export class PictureStore {
  timeline: Timeline | null = null;
  private readonly colors = new Map<Picture, Promise<ImageBitmap | null>>();
  private readonly greys = new Map<Picture, Promise<Grey | null>>();

  /** Pictures are those of this run from now on. */
  begin(timeline: Timeline): void {
    this.timeline = timeline;
    this.colors.clear();
    this.greys.clear();
  }

  /** What the camera saw in a view; null: there is no picture, or it is damaged. */
  color(view: number): Promise<ImageBitmap | null> {
    const picture = this.timeline?.pictures.get(view)?.color;
    return picture ? kept(this.colors, picture, decode, kKept) : Promise.resolve(null);
  }

  /** 0: no return, else 1 … 255 from `min` to `max` of the message. */
  depth(view: number): Promise<Grey | null> {
    return this.grey(this.timeline?.pictures.get(view)?.depth);
  }

  /** Not 0 where fruit was seen. */
  fruit(view: number): Promise<Grey | null> {
    return this.grey(this.timeline?.pictures.get(view)?.fruit);
  }

  private grey(picture: Picture | undefined): Promise<Grey | null> {
    // Small ones, and all are needed to find a fruit in them: many more are kept.
    return picture ? kept(this.greys, picture, decodeGrey, 40 * kKept) : Promise.resolve(null);
  }
}

function kept<V>(
  cache: Map<Picture, Promise<V>>,
  picture: Picture,
  make: (picture: Picture) => Promise<V>,
  limit: number,
): Promise<V> {
  let made = cache.get(picture);
  if (made) cache.delete(picture);
  else made = make(picture);
  cache.set(picture, made);
  if (cache.size > limit) cache.delete(cache.keys().next().value as Picture);
  return made;
}

async function decode(picture: Picture): Promise<ImageBitmap | null> {
  try {
    // Only what a browser takes for a picture, whatever the message calls it.
    const mime = picture.mime === "image/png" ? "image/png" : "image/jpeg";
    return await createImageBitmap(new Blob([picture.data as BlobPart], { type: mime }));
  } catch {
    return null;
  }
}

async function decodeGrey(picture: Picture): Promise<Grey | null> {
  const image = await decode(picture);
  if (!image) return null;
  const { width, height } = image;
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext("2d", { willReadFrequently: true });
  if (!context) return null;
  context.drawImage(image, 0, 0);
  image.close();
  const rgba = context.getImageData(0, 0, width, height).data;
  const pixels = new Uint8Array(width * height);
  for (let i = 0; i < pixels.length; ++i) pixels[i] = rgba[4 * i];
  return { width, height, pixels };
}
