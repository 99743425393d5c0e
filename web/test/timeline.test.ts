import assert from "node:assert/strict";
import test from "node:test";
import type { Message, View } from "../src/data/messages.ts";
import { readFrame } from "../src/data/protocol.ts";
import { blockIndex, blockKey } from "../src/data/block_history.ts";
import { edgeEnds, edgeKey, Timeline } from "../src/data/timeline.ts";
import { Trail } from "../src/data/trail.ts";
import { cameraPose } from "../src/data/kinematics.ts";
import { frame } from "./made/frames.ts";
import { makeRun } from "./made/run.ts";

const messages = makeRun({ segments: 3, views: 6, plants: 2, leafVoxels: 20 }).map((f) => readFrame(f) as Message);

function timelineOf(count = messages.length): Timeline {
  const timeline = new Timeline();
  for (const message of messages.slice(0, count)) timeline.append(message);
  return timeline;
}

const read = (head: Record<string, unknown>, ...octets: ArrayBufferView[]) => readFrame(frame(head, ...octets)) as Message;

test("block and edge keys come back", () => {
  for (const [x, y, z] of [[0, 0, 0], [-1, 5, -65536], [65535, -3, 12]])
    assert.deepEqual(blockIndex(blockKey(x, y, z)), [x, y, z]);
  assert.deepEqual(edgeEnds(edgeKey(7, 3)), [3, 7]);
  assert.equal(edgeKey(7, 3), edgeKey(3, 7));
});

test("at any message, a long run looks like one that ended there", () => {
  const all = timelineOf();
  for (let count = 1; count <= messages.length; count += 5) {
    const step = count - 1;
    const short = timelineOf(count);
    for (const layer of ["map", "targets", "fruits", "nodes", "edges", "visited"] as const) {
      const now = new Map<number, unknown>([...short[layer].entriesAt(step)]);
      const again = new Map<number, unknown>([...all[layer].entriesAt(step)]);
      assert.deepEqual(again, now);
    }
    assert.deepEqual(all.planAt(step)?.path, short.planAt(step)?.path);
    assert.deepEqual(all.workAt(step), short.workAt(step));
  }
});

test("at the time of a view, all that came with it has come", () => {
  const timeline = timelineOf();
  for (const view of timeline.views) {
    const step = timeline.stepAt(view.t);
    assert.equal(timeline.viewAt(view.t), view);
    const next = messages[step + 1];
    assert.ok(next === undefined || !("view" in next) || next.view !== view.view);
  }
  assert.equal(timeline.viewAt(-1), null);
});

test("the robot stands at every view where the view says", () => {
  const timeline = timelineOf();
  const { robot, tracks } = timeline;
  assert.ok(robot);
  for (const view of timeline.views) {
    const T = cameraPose(robot, tracks.at(view.t));
    for (let i = 0; i < 12; ++i) assert.ok(Math.abs(T[i] - view.T_world_camera[i]) < 1e-5);
  }
});

test("between two views it does not jump", () => {
  const timeline = timelineOf();
  const { robot, tracks } = timeline;
  assert.ok(robot);
  let before = cameraPose(robot, tracks.at(0));
  for (let t = 0; t < timeline.duration; t += 0.02) {
    const T = cameraPose(robot, tracks.at(t));
    assert.ok(Math.hypot(T[3] - before[3], T[7] - before[7], T[11] - before[11]) < 0.12, `at ${t}`);
    before = T;
  }
});

test("a motion that ends early stops the arm there", () => {
  const timeline = timelineOf(3);
  const head = { type: "motion", kind: "view", segment: 0, t_s: 1, duration_s: 2, rate_hz: 1, joints: 1, points: 3 };
  timeline.append(read(head, Float32Array.of(0, 1, 2)));
  assert.equal(timeline.tracks.at(2.5).q[0], 1.5);
  timeline.append(read({ type: "motion_end", t_s: 2, ended: "stopped", why: "by hand" }));
  assert.equal(timeline.tracks.at(2.5).q[0], 1);
  assert.match(timeline.events.at(-1)?.text ?? "", /stopped.*by hand/);
});

test("a fresh plan forgets the graph before it", () => {
  const timeline = new Timeline();
  const plan = (fresh: boolean, id: number) =>
    read(
      { type: "plan", t_s: id, fresh, views: 1, edges: 1, gone_edges: 0, path: [], at: id, visited: [id] },
      Int32Array.of(id), new Float32Array(6), Uint8Array.of(1), Int32Array.of(id, id + 1),
    ); // prettier-ignore
  timeline.append(plan(true, 1));
  timeline.append(plan(false, 2));
  timeline.append(plan(true, 3));
  const ids = (step: number) => [...timeline.nodes.entriesAt(step)].map(([id]) => id);
  assert.deepEqual(ids(1), [1, 2]);
  assert.deepEqual(ids(2), [3]);
  assert.deepEqual([...timeline.visited.entriesAt(2)], [[3, true]]);
});

test("views of the graph go, come again and change what they are after, at every step", () => {
  const timeline = new Timeline();
  const plan = (views: [number, number][], gone: number[], visited: number[] = []) =>
    read(
      { type: "plan", t_s: timeline.newest + 1, views: views.length, gone_views: gone.length, visited },
      ...views.flatMap(([id, kind]) => [Int32Array.of(id), new Float32Array(6), Uint8Array.of(kind)]), Int32Array.from(gone),
    ); // prettier-ignore
  const steps: [[number, number][], number[], number[]][] = [
    [[[1, 1], [2, 1], [3, 2]], [], [2]],
    [[[1, 3]], [2], []],
    [[[2, 2]], [3, 1], []],
    [[[2, 1]], [99], [2]],
    [[[5, 1]], [2, 5], []],
  ]; // prettier-ignore
  for (const [views, gone, visited] of steps) timeline.append(plan(views, gone, visited));
  const kinds = (step: number) => Object.fromEntries([...timeline.nodes.entriesAt(step)].map(([id, node]) => [id, node.kind]));
  const seen = (step: number) => [...timeline.visited.entriesAt(step)].map(([id]) => id);
  const wanted = [{ 1: "roi", 2: "roi", 3: "occupied" }, { 1: "border", 3: "occupied" }, { 2: "occupied" }, { 2: "roi" }, { 5: "roi" }];
  for (const step of [4, 0, 2, 1, 3, 0, 4, -1]) {
    assert.deepEqual(kinds(step), wanted[step] ?? {});
    assert.deepEqual(seen(step), step === 0 || step === 3 ? [2] : []);
  }
  assert.equal(timeline.planAt(4)?.goneNodes.length, 0);
});

test("a view's camera holds from then on", () => {
  const timeline = timelineOf(3);
  const first = messages.find((m) => m.type === "view") as View;
  const camera = { width: 100, height: 50, fx: 60, fy: 60, cx: 50, cy: 25 };
  const other = { ...camera, fx: 70 };
  [null, camera, null, other].forEach((c, i) => timeline.append({ ...first, view: i, t: i, camera: c }));
  const used = timeline.views.map((v) => timeline.cameraOf(v));
  assert.deepEqual(used, [timeline.robot?.camera, camera, camera, other]);
  assert.equal(used[1], used[2]);
  assert.equal(timeline.cameraOf(timeline.viewAt(0.5)), timeline.robot?.camera);
  assert.equal(timeline.cameraOf(timeline.viewAt(2.5)), camera);
  assert.equal(timeline.cameraOf(timeline.viewAt(-1)), timeline.robot?.camera);
  assert.equal(new Timeline().cameraOf(null), null);
});

test("a view's later fruits join its earlier ones", () => {
  const timeline = new Timeline();
  const fruits = (view: number, t: number, ids: number[], gone: number[] = []) =>
    timeline.append(read({ type: "fruits", view, t_s: t, changed: ids.map((id) => ({ id, centre: [0, 0, t], semi_axes: [1, 1, 1] })), gone }));
  fruits(-1, 0, [9]);
  fruits(4, 1, [1, 2]);
  fruits(4, 5, [2, 3], [1]);
  assert.deepEqual(timeline.fruitsOfView.get(4)?.map((f) => [f.id, f.centre[2]]), [[1, 1], [2, 5], [3, 5]]);
  const ids = (step: number) => [...timeline.fruits.entriesAt(step)].map(([id]) => id);
  assert.deepEqual([0, 1, 2].map(ids), [[9], [9, 1, 2], [9, 2, 3]]);
});

test("a run is complete with its end, with all that was announced, or when the server is through", () => {
  const announced = (frames: number, live: boolean) => {
    const timeline = timelineOf(5);
    timeline.append({ type: "reader", live, controls: false, frames });
    timeline.taken = 5;
    return timeline;
  };
  assert.ok(announced(5, false).complete);
  assert.ok(!announced(5, true).complete);
  const torn = announced(10, false);
  assert.ok(!torn.complete);
  torn.closed = true;
  assert.ok(torn.complete);
  assert.equal(torn.arrived, 0.5);
  const live = announced(5, true);
  live.append({ type: "end", t: 9, interrupted: false });
  assert.ok(live.complete);
});

test("time does not run backwards", () => {
  const timeline = new Timeline();
  timeline.append(read({ type: "log", t_s: 5, text: "late" }));
  timeline.append(read({ type: "log", t_s: 3, text: "early" }));
  assert.equal(timeline.newest, 5);
  assert.equal(timeline.stepAt(5), 1);
  assert.equal(timeline.stepAt(4.9), -1);
});

test("blocks that become empty are gone", () => {
  const timeline = new Timeline();
  const map = (fill: number) =>
    read({ type: "map", view: 0, t_s: 0, blocks: 1 }, Int32Array.of(1, 2, 3), new Uint8Array(128).fill(fill));
  timeline.append(map(1));
  timeline.append(map(0));
  const version = timeline.map.at(blockKey(1, 2, 3), 0);
  assert.deepEqual(timeline.map.octets(version ?? -1), new Uint8Array(128).fill(1));
  assert.equal(timeline.map.at(blockKey(1, 2, 3), 1), undefined);
});

test("the camera's way grows with the run and is cut where a motion was", () => {
  const timeline = timelineOf();
  const trail = new Trail();
  assert.ok(trail.extend(timeline));
  assert.ok(!trail.extend(timeline));
  assert.equal(trail.points.length, 6 * trail.times.length);
  assert.equal(trail.countAt(timeline.duration), trail.times.length);
  const before = trail.times.length;
  const head = { type: "motion", kind: "view", segment: 2, t_s: timeline.newest, duration_s: 1, rate_hz: 1, joints: 6, points: 2 };
  timeline.append(read(head, new Float32Array(12)));
  trail.extend(timeline);
  const whole = trail.times.length;
  timeline.append(read({ type: "motion_end", t_s: timeline.newest + 0.5, ended: "aborted" }));
  trail.extend(timeline);
  assert.ok(before < trail.times.length && trail.times.length < whole);
});

test("frames on the way are counted and do not pass for views", () => {
  const timeline = timelineOf();
  const { looks, views } = timeline;
  assert.ok(looks.length > views.length && views.length === 18);
  assert.equal(timeline.looksBy(-1), 0);
  assert.equal(timeline.looksBy(looks[3].t), 4);
  assert.equal(timeline.looksBy(timeline.duration), looks.length);
  assert.equal(timeline.viewAt(looks[0].t), views[0]);
  const course = timeline.fruitCourse();
  assert.equal(course.length, looks.length + views.length);
  for (let i = 1; i < course.length; ++i) assert.ok(course[i - 1].t <= course[i].t);
});

test("a fruit may be found on the way", () => {
  const timeline = timelineOf();
  const t = timeline.newest + 1;
  const fruit = { id: 900, centre: [0, 0, 1], semi_axes: [0.03, 0.03, 0.03] };
  timeline.append(read({ type: "look", segment: 2, t_s: t, during: "home", at: [0, 0, 1], direction: [1, 0, 0], fruits: 1 }));
  timeline.append(read({ type: "fruits", view: 17, t_s: t, changed: [fruit], gone: [] }));
  assert.match(timeline.events.at(-1)?.text ?? "", /Fruit 900 found on the way from view 17/);
  assert.ok(!timeline.fruitsOfView.get(17)?.some((f) => f.id === 900));
});

test("a fruit's points are the last told by then, else the first", () => {
  const timeline = new Timeline();
  const tell = (t: number, x: number) =>
    timeline.append(read({ type: "surface", t_s: t, fruits: [{ id: 1, origin: [x, 0, 0], points: 1 }] }, Int16Array.of(0, 0, 0)));
  timeline.append(read({ type: "log", t_s: 0, text: "begins" }));
  tell(5, 1);
  tell(9, 2);
  assert.equal(timeline.surfaceOf(1, 0)?.points[0], 1);
  assert.equal(timeline.surfaceOf(1, timeline.stepAt(6))?.points[0], 1);
  assert.equal(timeline.surfaceOf(1, timeline.stepAt(9))?.points[0], 2);
  assert.equal(timeline.surfaceOf(2, 2), null);
});

test("a late page knows whether the mission holds, and its pace", () => {
  const timeline = new Timeline();
  assert.equal(timeline.holds, false);
  timeline.append(read({ type: "log", t_s: 1, level: "notice", text: "pause, said page", word: "pause" }));
  assert.equal(timeline.holds, true);
  timeline.append(read({ type: "log", t_s: 1, level: "info", text: "something else" }));
  assert.equal(timeline.holds, true);
  timeline.append(read({ type: "log", t_s: 1, level: "notice", text: "go on", word: "go_on" }));
  assert.equal(timeline.holds, false);
  timeline.append(read({ type: "pace", factor: 5 }));
  assert.equal(timeline.pace, 5);
});
