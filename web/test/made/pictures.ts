import type { Pose } from "../../src/data/fields.ts";
import { transformBack } from "../../src/data/kinematics.ts";
import type { Camera } from "../../src/data/messages.ts";
import { frame, png } from "./frames.ts";
import type { MadePlants } from "./plants.ts";

/** Whether a point of the optical frame is in the picture and not farther than so much. */
export function inside(camera: Camera, [x, y, z]: number[], farthest: number): boolean {
  if (z < 0.1 || z > farthest) return false;
  const u = (camera.fx * x) / z + camera.cx;
  const v = (camera.fy * y) / z + camera.cy;
  return u >= 0 && v >= 0 && u < camera.width && v < camera.height;
}

const kNear_m = 0.1;
const kFar_m = 2;

/** Discs for leaves and fruits, in depth order. */
export function pictureFrames(view: number, camera: Camera, T: Pose, plants: MadePlants): Uint8Array[] {
  const [w, h] = [160, 120];
  const scale = w / camera.width;
  const rgb = new Uint8Array(3 * w * h);
  const depth = new Uint8Array(w * h);
  const fruit = new Uint8Array(w * h);
  for (let i = 0; i < w * h; ++i) rgb.set([188, 192, 196].map((c) => c - Math.floor(i / w / 3)), 3 * i);
  const discs = [
    ...plants.leaves.map((l, i) => ({ p: l.centre, radius: 0.05, color: [50 + (i % 5) * 8, 110 + (i % 7) * 8, 45], isFruit: false })),
    ...plants.fruits.map((f) => ({ p: f.centre, radius: f.radius, color: [200, 50, 30], isFruit: true })),
  ]
    .map((d) => ({ ...d, c: transformBack(T, d.p) }))
    .filter((d) => inside(camera, d.c, kFar_m))
    .sort((a, b) => b.c[2] - a.c[2]);
  for (const { c, radius, color, isFruit } of discs) {
    const [u, v] = [((camera.fx * c[0]) / c[2] + camera.cx) * scale, ((camera.fy * c[1]) / c[2] + camera.cy) * scale];
    const r = (camera.fx * radius * scale) / c[2];
    for (let y = Math.max(0, Math.ceil(v - r)); y <= Math.min(h - 1, v + r); ++y)
      for (let x = Math.max(0, Math.ceil(u - r)); x <= Math.min(w - 1, u + r); ++x) {
        if (Math.hypot(x - u, y - v) > r) continue;
        rgb.set(color, 3 * (y * w + x));
        depth[y * w + x] = 1 + Math.round((254 * (c[2] - kNear_m)) / (kFar_m - kNear_m));
        fruit[y * w + x] = isFruit ? 255 : 0;
      }
  }
  const head = { type: "picture", view, width: w, height: h, mime: "image/png" };
  return [
    frame({ ...head, what: "color" }, png(w, h, 3, rgb)),
    frame({ ...head, what: "depth", min_m: kNear_m, max_m: kFar_m }, png(w, h, 1, depth)),
    frame({ ...head, what: "fruit" }, png(w, h, 1, fruit)),
  ];
}
