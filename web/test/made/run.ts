import type { Configuration } from "../../src/data/kinematics.ts";
import { cameraPose, transformBack } from "../../src/data/kinematics.ts";
import type { Robot, Vec3 } from "../../src/data/messages.ts";
import { readFrame } from "../../src/data/protocol.ts";
import { blockIndex, blockKey } from "../../src/data/block_history.ts";
import { inside, pictureFrames } from "./pictures.ts";
import { frame, random } from "./frames.ts";
import { makePlants, type MadeFruit, type MadePlants } from "./plants.ts";
import { robotHead } from "./robot.ts";

export interface MadeOptions {
  segments: number;
  views: number; // in each segment
  pictures: boolean;
  /** Leaves out the end, as of a killed run. */
  killed: boolean;
  /** Voxels every leaf has, roughly: larger maps. */
  leafVoxels: number;
  plants: number; // in each of two rows
}

const kDefaults: MadeOptions = {
  segments: 4, views: 12, pictures: true, killed: false, leafVoxels: 60, plants: 6,
}; // prettier-ignore

const kResolution_m = 0.01;
const kHome = [0, -0.785, 1.571, -0.785, 0, 0];
const kKinds = ["roi", "occupied", "border"];

/** A run nobody drove, message by message, to develop and test the page with. */
export function makeRun(some: Partial<MadeOptions> = {}): Uint8Array[] {
  const options = { ...kDefaults, ...some };
  return new Maker(options).make();
}

class Maker {
  private readonly next = random(7);
  private readonly frames: Uint8Array[] = [];
  private readonly robot: Robot;
  private readonly plants: MadePlants;
  private readonly occupied = new Map<number, Uint8Array>();
  private readonly seen = new Map<number, number>();
  private t = 0;
  private at: Configuration = { q: kHome, travel: 0, lift: 0.3 };
  private view = 0;
  private node = 0;

  constructor(private readonly options: MadeOptions) {
    this.plants = makePlants(this.next, options.plants);
    const robot = frame(robotHead());
    this.robot = readFrame(robot) as Robot;
    this.frames.push(
      frame({
        type: "hello", protocol: 1, simulated: true, mission: "made_up",
        planner: "vmp", seed: 7, canopeer: "0.0.0", segments: options.segments, segment_time_s: 60, resolution_m: kResolution_m,
      }), // prettier-ignore
      robot,
      this.truth(),
    );
  }

  make(): Uint8Array[] {
    for (let s = 0; s < this.options.segments; ++s) this.segment(s);
    if (!this.options.killed) this.frames.push(frame({ type: "end", t_s: this.t, interrupted: false }));
    return this.frames;
  }

  private around(size: number): number {
    return size * (2 * this.next() - 1);
  }

  private truth(): Uint8Array {
    const { vertices, triangles, leafTriangles, fruits } = this.plants;
    return frame(
      {
        type: "truth",
        vertices: vertices.length / 3,
        parts: [
          { what: "leaf", color: [62, 124, 50], triangle: 0, triangles: leafTriangles },
          { what: "fruit", color: [205, 40, 20], triangle: leafTriangles, triangles: triangles.length / 3 - leafTriangles },
        ],
        fruits: fruits.map((f) => ({ ...f, counted: f.id % 7 !== 3 })),
      },
      vertices,
      triangles,
    );
  }

  private segment(s: number): void {
    const side = s % 2;
    const travel = 0.8 * Math.floor(s / 2);
    const turn = side === 0 ? 0 : Math.PI;
    const home: Configuration = { q: [...kHome.slice(0, 4), turn, 0], travel, lift: 0.3 };
    if (s > 0) this.motion(s - 1, this.at, home.q as number[], "home");
    if (s > 0) this.frames.push(frame({ type: "trolley", t_s: this.t, duration_s: 2, travel, lift: 0.3 }));
    this.t += s > 0 ? 2 : 0;
    const y = -1.9 + travel;
    const x = side === 0 ? [-1.2, -0.45] : [0.45, 1.2];
    this.frames.push(
      frame({
        type: "segment", segment: s, name: `stop ${Math.floor(s / 2)}, side ${side + 1}`, t_s: this.t,
        region: [x[0], y, 0.3, x[1], y + 1.6, 1.5], workspace: [-0.45, y, 0.7, 0.45, y + 1.9, 1.86], travel, lift: 0.3,
      }), // prettier-ignore
      frame({ type: "log", t_s: this.t, level: "info", text: `looking at <b>side ${side + 1}</b> & its "fruits"` }),
    );
    this.at = home;
    this.look(s, home, "home", null);
    for (let v = 1; v < this.options.views; ++v) {
      const q = [0, 1, 2, 3, 4, 5].map((j) => (home.q[j] ?? 0) + this.around([0.7, 0.35, 0.4, 0.5, 0.5, 0.2][j]));
      const planning = 0.1 + 0.2 * this.next();
      this.t += planning;
      this.plan(s, v === 1, this.at);
      const moving = this.motion(s, this.at, q, "view");
      this.at = { q, travel, lift: 0.3 };
      this.look(s, this.at, kKinds[Math.floor(3 * this.next())], Math.round(200 + 6000 * this.next()), planning, moving);
    }
    this.frames.push(
      frame({
        type: "work",
        work: ["fuse_point", "view_ik", "field_block", "state_check", "view_cast", "detect_frame"].map((name, i) => ({
          name, count: 1000 * (i + 1), seconds: ((s + 1) * 3) / (i + 1),
        })), // prettier-ignore
      }),
    );
  }

  private motion(segment: number, from: Configuration, to: number[], kind: string): number {
    const duration = 1 + this.next();
    const points = Math.ceil(duration * 20) + 1;
    const positions = new Float32Array(6 * points);
    for (let i = 0; i < points; ++i) {
      const x = i / (points - 1);
      for (let j = 0; j < 6; ++j)
        positions[6 * i + j] = from.q[j] + (to[j] - from.q[j]) * x * x * (3 - 2 * x);
    }
    const rate = (points - 1) / duration;
    this.frames.push(
      frame({ type: "motion", kind, segment, t_s: this.t, duration_s: duration, rate_hz: rate, joints: 6, points }, positions),
    );
    for (let t = 0.2; t < duration; t += 0.2) {
      const i = Math.min(points - 1, Math.round(t * rate));
      const q = [...positions.subarray(6 * i, 6 * i + 6)];
      this.lookOnTheWay(segment, this.t + t, kind, cameraPose(this.robot, { ...from, q }));
    }
    this.t += duration;
    const touched = this.next() < 0.08;
    this.frames.push(
      frame({ type: "motion_end", t_s: this.t, ended: "arrived", why: "", collision: false, plant_contact: touched }),
    );
    return duration;
  }

  private lookOnTheWay(segment: number, t_s: number, during: string, T: ArrayLike<number>): void {
    this.frames.push(
      frame({
        type: "look", segment, t_s, during, at: [T[3], T[7], T[11]], direction: [T[2], T[6], T[10]],
        blur_px: 0.5, realised: 120, fruits: this.seen.size,
      }), // prettier-ignore
    );
  }

  private plan(segment: number, fresh: boolean, at: Configuration): void {
    const T = cameraPose(this.robot, at);
    const first = fresh ? (this.node = 0) : this.node;
    const count = fresh ? 120 : 15;
    const octets: ArrayBufferView[] = [];
    for (let i = 0; i < count; ++i) {
      const where = [T[3] + this.around(0.3), T[7] + this.around(0.7), Math.max(0.5, T[11] + this.around(0.5))];
      octets.push(Int32Array.of(this.node++));
      octets.push(Float32Array.of(...where, T[2] + this.around(0.2), T[6] + this.around(0.3), T[10] + this.around(0.2)));
      octets.push(Uint8Array.of(1 + Math.floor(3 * this.next())));
    }
    const edges: number[] = [];
    for (let i = first; i < this.node; ++i)
      for (let k = 0; k < 3 && i > 0; ++k) edges.push(i, Math.floor(i * this.next()));
    octets.push(Int32Array.from(edges));
    const path = [1, 2, 3].map(() => Math.floor(this.node * this.next()));
    this.frames.push(
      frame(
        {
          type: "plan", t_s: this.t, segment, fresh, views: count, edges: edges.length / 2, gone_edges: 0,
          path, at: 0, visited: [first, path[0]],
        }, // prettier-ignore
        ...octets,
      ),
    );
  }

  private look(segment: number, at: Configuration, kind: string, predicted: number | null, planning = 0, moving = 0): void {
    this.t += 0.1;
    const T = cameraPose(this.robot, at);
    const sees = (p: ArrayLike<number>) => inside(this.robot.camera, transformBack(T, p), 1.3);
    const { changed, realised } = this.fuse(sees);
    const fruits = this.plants.fruits.filter((f) => sees(f.centre));
    for (const f of fruits) this.seen.set(f.id, (this.seen.get(f.id) ?? 0) + 1);
    const view = this.view++;
    this.frames.push(
      frame({
        type: "view", view, segment, t_s: this.t, q: [...(at.q as number[])], travel: at.travel, lift: at.lift,
        T_world_camera: [...T], kind, predicted, realised, points: 90000, roi_voxels: 40 * this.seen.size,
        planning_s: planning, motion_s: moving, nodes: this.node, edges: 3 * this.node, fruits: this.seen.size,
      }), // prettier-ignore
    );
    if (this.options.pictures) this.frames.push(...pictureFrames(view, this.robot.camera, T, this.plants));
    this.frames.push(this.mapFrame(view, changed), this.targetsFrame(view, changed), this.fruitsFrame(view, fruits));
  }

  /** Voxels of leaves and fruits in sight, no matter what is before them. */
  private fuse(sees: (p: Vec3) => boolean): { changed: Set<number>; realised: number } {
    const changed = new Set<number>();
    let realised = 0;
    const mark = (p: Vec3, set: 0 | 1) => {
      const index = p.map((x) => Math.floor(x / kResolution_m));
      const key = blockKey(...(index.map((i) => i >> 3) as Vec3));
      const block = this.occupied.get(key) ?? new Uint8Array(128);
      this.occupied.set(key, block);
      const octet = (index[1] & 7) + 8 * (index[2] & 7);
      for (const at of set ? [octet, 64 + octet] : [octet]) {
        if (block[at] & (1 << (index[0] & 7))) continue;
        block[at] |= 1 << (index[0] & 7);
        changed.add(key);
        ++realised;
      }
    };
    for (const { centre, u, v } of this.plants.leaves) {
      if (!sees(centre)) continue;
      for (let i = 0; i < this.options.leafVoxels; ++i) {
        const a = this.around(1);
        const b = this.around(1 - Math.abs(a));
        mark(centre.map((c, k) => c + a * u[k] + b * v[k]) as Vec3, 0);
      }
    }
    for (const { centre, radius } of this.plants.fruits.filter((f) => sees(f.centre)))
      for (let i = 0; i < 120; ++i) {
        const d = [this.around(1), this.around(1), this.around(1)];
        const length = Math.hypot(...d) || 1;
        mark(centre.map((c, k) => c + (radius * d[k]) / length) as Vec3, 1);
      }
    return { changed, realised };
  }

  private mapFrame(view: number, changed: Set<number>): Uint8Array {
    const octets = [...changed].flatMap((key) => [Int32Array.from(blockIndex(key)), this.occupied.get(key)?.slice() ?? new Uint8Array(128)]);
    return frame({ type: "map", view, t_s: this.t, blocks: changed.size }, ...octets);
  }

  private targetsFrame(view: number, changed: Set<number>): Uint8Array {
    const octets: ArrayBufferView[] = [];
    let blocks = 0;
    for (const key of changed) {
      if (blocks > 400) break;
      const [x, y, z] = blockIndex(key);
      const targets = new Uint8Array(192);
      for (let i = 0; i < 6; ++i) targets[64 * (blocks % 3) + Math.floor(64 * this.next())] |= 1 << Math.floor(8 * this.next());
      octets.push(Int32Array.of(x, y, z + 1), targets);
      ++blocks;
    }
    return frame({ type: "targets", view, blocks }, ...octets);
  }

  private fruitsFrame(view: number, fruits: MadeFruit[]): Uint8Array {
    const changed = fruits.map((f) => {
      const views = this.seen.get(f.id) ?? 1;
      const share = 1 - 1 / (1 + 0.6 * views);
      const grow = 0.75 + 0.25 * share;
      return {
        id: f.id, centre: f.centre.map((c) => c + 0.01 * this.around(1 - share)),
        semi_axes: [f.radius * grow, f.radius * grow * 0.95, f.radius * 1.15 * grow], e1: 0.9, e2: 0.95,
        rpy: [0.2, 0.1, f.id], volume_cm3: (4 / 3) * Math.PI * (100 * f.radius * grow) ** 3, confidence: 0.4 + 0.6 * share,
        ripeness: ["ripe", "turning", "green"][f.id % 3], color: [[200, 40, 25], [225, 125, 40], [110, 140, 50]][f.id % 3],
        points: 60 * views, views, seen_share: 0.8 * share, first_s: 0, last_s: this.t,
      }; // prettier-ignore
    });
    return frame({ type: "fruits", view, t_s: this.t, changed, gone: [] });
  }
}
