import { transformBack } from "../data/kinematics.ts";
import type { Camera, Fruit, View } from "../data/messages.ts";
import type { Timeline } from "../data/timeline.ts";
import { project } from "../scene/frustum.ts";
import type { Grey, PictureStore } from "./picture_store.ts";

/** A fruit in a picture; pixels of the camera. */
export interface Sighting {
  view: View;
  u: number;
  v: number;
  radius: number;
  depth: number;
}

/** How far depth and shape may be apart for a fruit pixel to be this fruit's. */
const kDepthSlack_m = 0.03;

/** Where a fruit would be in a view's picture; null: not in it. */
export function inFrustum(camera: Camera, view: View, fruit: Fruit): Sighting | null {
  const at = project(camera, transformBack(view.T_world_camera, fruit.centre));
  if (!at) return null;
  const radius = (camera.fx * Math.max(...fruit.semiAxes)) / at.depth;
  const { u, v, depth } = at;
  if (u < 0 || v < 0 || u >= camera.width || v >= camera.height) return null;
  return { view, u, v, radius, depth };
}

/** The views up to t in whose picture the fruit was seen: fruit pixels there, as far away as it is. */
export async function sightings(
  timeline: Timeline,
  store: Pick<PictureStore, "fruit" | "depth">,
  fruit: Fruit,
  t: number,
): Promise<Sighting[]> {
  const found: Sighting[] = [];
  for (const view of timeline.views) {
    if (view.t > t) break;
    const camera = timeline.cameraOf(view);
    const sighting = camera && inFrustum(camera, view, fruit);
    if (!sighting) continue;
    const [mask, depth] = await Promise.all([store.fruit(view.view), store.depth(view.view)]);
    const meta = timeline.pictures.get(view.view)?.depth;
    const range = meta && depth ? { depth, min: meta.min, max: meta.max } : null;
    if (mask && isSeen(camera, sighting, mask, range, Math.max(...fruit.semiAxes))) found.push(sighting);
  }
  return found;
}

function isSeen(
  camera: Camera,
  { u, v, radius, depth }: Sighting,
  mask: Grey,
  range: { depth: Grey; min: number; max: number } | null,
  size: number,
): boolean {
  const scale = mask.width / camera.width;
  const [mu, mv, mr] = [u * scale, v * scale, Math.max(1, radius * scale)];
  for (let y = Math.max(0, Math.floor(mv - mr)); y <= Math.min(mask.height - 1, mv + mr); ++y)
    for (let x = Math.max(0, Math.floor(mu - mr)); x <= Math.min(mask.width - 1, mu + mr); ++x) {
      if (mask.pixels[y * mask.width + x] === 0) continue;
      if (!range) return true;
      const seen = depthAt(range, x / mask.width, y / mask.height);
      if (seen === null || Math.abs(seen - depth) < size + kDepthSlack_m) return true;
    }
  return false;
}

/** Metres at a place of the picture, 0 … 1; null: no return. */
function depthAt({ depth, min, max }: { depth: Grey; min: number; max: number }, x: number, y: number): number | null {
  const i = Math.floor(y * depth.height) * depth.width + Math.floor(x * depth.width);
  const value = depth.pixels[i] ?? 0;
  return value === 0 ? null : min + ((value - 1) / 254) * (max - min);
}
