import assert from "node:assert/strict";
import test from "node:test";
import { FrameError } from "../src/data/fields.ts";
import type { Fruits, MapChange, Motion, Plan, Robot, Surface, Truth, View } from "../src/data/messages.ts";
import { readFrame, splitFrames } from "../src/data/protocol.ts";
import { file, frame, random } from "./made/frames.ts";
import { robotHead } from "./made/robot.ts";
import { makeRun } from "./made/run.ts";

const text = (s: string) => new TextEncoder().encode(s);

function refuses(bytes: Uint8Array, why: RegExp): void {
  assert.throws(() => readFrame(bytes), (error) => error instanceof FrameError && why.test(error.message));
}

test("a hello tells of the run", () => {
  const hello = readFrame(frame({ type: "hello", protocol: 1, simulated: true, mission: "m", planner: "vmp", seed: 3, segments: 8, resolution_m: 0.02 }));
  assert.ok(hello?.type === "hello");
  assert.equal(hello.mission, "m");
  assert.equal(hello.seed, "3");
  assert.equal(hello.resolution, 0.02);
});

test("an unknown type is skipped", () => {
  assert.equal(readFrame(frame({ type: "weather" }, Uint8Array.of(1, 2, 3))), null);
  assert.equal(readFrame(frame({ type: "constructor" })), null);
});

test("blocks of the map come with their octets", () => {
  const block = new Uint8Array(128).fill(7);
  const map = readFrame(frame({ type: "map", view: 1, t_s: 2, blocks: 1 }, Int32Array.of(-1, 2, -3), block)) as MapChange;
  assert.deepEqual([...map.blocks.index], [-1, 2, -3]);
  assert.deepEqual(map.blocks.octets, block);
});

test("a plan's views, edges and gone edges are told apart", () => {
  const head = { type: "plan", t_s: 1, segment: 0, fresh: true, views: 1, edges: 1, gone_edges: 1, path: [4], at: 2, visited: [2] };
  const octets = [Int32Array.of(4), Float32Array.of(1, 2, 3, 0, 0, 1), Uint8Array.of(2), Int32Array.of(4, 2), Int32Array.of(1, 2)];
  const plan = readFrame(frame(head, ...octets)) as Plan;
  assert.deepEqual(plan.nodes, [{ id: 4, position: [1, 2, 3], direction: [0, 0, 1], kind: "occupied" }]);
  assert.deepEqual([...plan.edges], [4, 2]);
  assert.deepEqual([...plan.goneEdges], [1, 2]);
  assert.deepEqual([...plan.goneNodes], []);
  const more = readFrame(frame({ ...head, gone_views: 2 }, ...octets, Int32Array.of(1, 7))) as Plan;
  assert.deepEqual([...more.goneEdges], [1, 2]);
  assert.deepEqual([...more.goneNodes], [1, 7]);
  refuses(frame({ ...head, gone_views: 3 }, ...octets, Int32Array.of(1, 7)), /too few/);
});

test("a view may say what its camera is", () => {
  const head = { type: "view", view: 0, segment: 0, t_s: 0, q: [], T_world_camera: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0] };
  const camera = { width: 1280, height: 720, fx: 900, fy: 901, cx: 640, cy: 360 };
  assert.deepEqual((readFrame(frame({ ...head, camera })) as View).camera, camera);
  assert.equal((readFrame(frame(head)) as View).camera, null);
  refuses(frame({ ...head, camera: { ...camera, fy: 0 } }), /focal length/);
  refuses(frame({ ...head, camera: { ...camera, width: -1 } }), /width/);
});

test("a frame on the way says from where and how blurred", () => {
  const head = { type: "look", segment: 1, t_s: 2.5, during: "trolley", at: [1, 2, 3], direction: [0, 1, 0], blur_px: 0.42, realised: 77, fruits: 3 };
  assert.deepEqual(readFrame(frame(head)), {
    type: "look", segment: 1, t: 2.5, during: "trolley", at: [1, 2, 3], direction: [0, 1, 0], blur: 0.42, realised: 77, fruits: 3,
  }); // prettier-ignore
  refuses(frame({ ...head, at: [1, 2] }), /look.at/);
});

test("fruits may be of no view", () => {
  assert.equal((readFrame(frame({ type: "fruits", view: -1, t_s: 0 })) as Fruits).view, -1);
  refuses(frame({ type: "fruits", view: 0.5, t_s: 0 }), /whole/);
});

test("meshes of the robot are cut out of the octets", () => {
  const head = robotHead() as { links: { shapes: unknown[] }[]; vertices: number };
  head.vertices = 4;
  const pose = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];
  head.links[0].shapes = [{ kind: "mesh", pose, vertex: 1, vertices: 3, triangle: 0, triangles: 1 }];
  const vertices = Float32Array.from({ length: 12 }, (_, i) => i);
  const robot = readFrame(frame(head, vertices, Uint32Array.of(0, 1, 2))) as Robot;
  const mesh = robot.links[0].shapes[0];
  assert.ok(mesh.kind === "mesh");
  assert.deepEqual([...mesh.vertices], [3, 4, 5, 6, 7, 8, 9, 10, 11]);
  refuses(frame(head, vertices, Uint32Array.of(0, 1, 3)), /corner beyond/);
});

test("a motion's points are read row by row", () => {
  const head = { type: "motion", kind: "view", segment: 0, t_s: 1, duration_s: 1, rate_hz: 1, joints: 2, points: 2 };
  const motion = readFrame(frame(head, Float32Array.of(1, 2, 3, 4))) as Motion;
  assert.deepEqual([...motion.positions], [1, 2, 3, 4]);
  refuses(frame({ ...head, rate_hz: 0 }, Float32Array.of(1, 2, 3, 4)), /rate_hz/);
});

test("malformed frames are refused, each with a reason", () => {
  refuses(text("no line end"), /line end/);
  refuses(text("{broken\n"), /no JSON/);
  refuses(text("[]\n"), /no object/);
  refuses(text("{}\n"), /type/);
  refuses(text('{"type":"end","t_s":1,"bytes":4}\nab'), /2 octets where 4/);
  refuses(text('{"type":"end","t_s":1}\nextra'), /5 octets where 0/);
  refuses(text('{"type":"end","t_s":null}\n'), /t_s/);
  refuses(frame({ type: "end", t_s: 1 }, Uint8Array.of(1)), /too many/);
  refuses(frame({ type: "map", view: 0, t_s: 0, blocks: 2 }, new Uint8Array(140)), /too few/);
  refuses(frame({ type: "map", view: 0, t_s: 0, blocks: 1e15 }), /too few/);
  refuses(frame({ type: "map", view: 0, t_s: 0, blocks: -1 }), /negative/);
  refuses(frame({ type: "plan", t_s: 0, views: 1e9 }), /too few/);
  refuses(frame({ type: "motion", t_s: 0, duration_s: 1, rate_hz: 1, joints: 1e9, points: 1e9 }), /too few/);
  refuses(frame({ type: "view", view: 0, segment: 0, t_s: 0, q: [], T_world_camera: [1, 2] }), /12/);
  refuses(frame({ type: "truth", vertices: 1 }, new Float32Array(3), Uint32Array.of(0, 0, 1)), /corner beyond/);
});

test("a link before its parent is refused", () => {
  const head = robotHead() as { links: { parent: number }[] };
  head.links[1].parent = 1;
  refuses(frame(head as Record<string, unknown>), /parent/);
});

test("a frame cut or changed anywhere is read or refused, and nothing else", () => {
  const next = random(11);
  const frames = makeRun({ segments: 1, views: 2, plants: 1 }).filter((f) => f.length < 20000);
  for (let i = 0; i < 800; ++i) {
    const bytes = Uint8Array.from(frames[Math.floor(next() * frames.length)]);
    if (next() < 0.3) bytes.fill(Math.floor(256 * next()), Math.floor(next() * bytes.length));
    else for (let k = 0; k < 3; ++k) bytes[Math.floor(next() * Math.min(bytes.length, 300))] = Math.floor(256 * next());
    const cut = next() < 0.5 ? bytes : bytes.subarray(0, Math.floor(next() * bytes.length));
    try {
      readFrame(cut);
    } catch (error) {
      assert.ok(error instanceof FrameError, String(error));
    }
  }
});

test("a file is cut into frames, a torn end left out", () => {
  const frames = makeRun({ segments: 1, views: 2, plants: 1 });
  const bytes = file(frames);
  assert.equal([...splitFrames(bytes)].length, frames.length);
  assert.equal([...splitFrames(bytes.subarray(0, bytes.length - 1))].length, frames.length - 1);
  for (const f of splitFrames(bytes)) assert.ok(readFrame(f));
});

test("parts of the truth are within its triangles", () => {
  const truth = makeRun({ segments: 0, plants: 2 }).map(readFrame).find((m) => m?.type === "truth") as Truth;
  for (const part of truth.parts) assert.ok(3 * (part.first + part.triangles) <= truth.triangles.length);
  assert.equal(truth.fruits.length, 16);
});

test("points of a surface lie around the fruit's origin", () => {
  const head = { type: "surface", t_s: 2, fruits: [{ id: 4, origin: [1, 2, 3], points: 2 }] };
  const surface = readFrame(frame(head, Int16Array.of(0, 10, -10, 10000, 0, 0))) as Surface;
  assert.equal(surface.fruits[0].id, 4);
  const near = (a: number, b: number) => assert.ok(Math.abs(a - b) < 1e-5, `${a} ${b}`);
  [1, 2.001, 2.999, 2, 2, 3].forEach((x, i) => near(surface.fruits[0].points[i], x));
  refuses(frame(head, Int16Array.of(0, 10, -10)), /too few/);
});
