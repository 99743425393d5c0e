import assert from "node:assert/strict";
import test from "node:test";
import * as THREE from "three";
import { isEnd } from "../src/connection.ts";
import type { Camera, Fruit, Message, Picture } from "../src/data/messages.ts";
import { readFrame } from "../src/data/protocol.ts";
import { Timeline } from "../src/data/timeline.ts";
import { picturesDrawn } from "../src/panels/camera_view.ts";
import { sightings } from "../src/pictures/sightings.ts";
import { timeOfPlace } from "../src/place.ts";
import { Playback } from "../src/playback.ts";
import { Frustum } from "../src/scene/frustum.ts";
import { RobotModel } from "../src/scene/robot_model.ts";
import { TrueFruits } from "../src/scene/true_fruits.ts";
import { TruthModel } from "../src/scene/truth_model.ts";
import { markedLooks, markedViews, ViewMarks } from "../src/scene/view_marks.ts";
import type { Palette } from "../src/theme.ts";
import { same } from "../src/ui/same.ts";
import { makeRun } from "./made/run.ts";

const messages = makeRun({ segments: 1, views: 4, plants: 2 }).map((f) => readFrame(f) as Message);

function timelineOf(some: Message[] = messages): Timeline {
  const timeline = new Timeline();
  for (const message of some) timeline.append(message);
  return timeline;
}

test("a place is reached when it has come, or nothing more comes", () => {
  const timeline = timelineOf([{ type: "reader", live: true, controls: false, frames: 9 }, ...messages.slice(0, -1)]);
  const { newest } = timeline;
  assert.equal(timeOfPlace({ t: newest }, timeline), newest);
  assert.equal(timeOfPlace({ t: newest + 0.004 }, timeline), null);
  assert.equal(timeOfPlace({ view: 2 }, timeline), timeline.view(2)?.t);
  assert.equal(timeOfPlace({ view: 99 }, timeline), null);
  assert.equal(timeOfPlace({ fruit: 1 }, timeline), null);
  timeline.closed = true;
  assert.equal(timeOfPlace({ t: newest + 0.004 }, timeline), timeline.duration);
  assert.equal(timeOfPlace({ t: 1e6 }, timeline), timeline.duration);
  assert.equal(timeOfPlace({ t: 0.5 }, timeline), 0.5);
  assert.equal(timeOfPlace({ view: 99 }, timeline), null);
});

test("the end of a run is reached by its rounded time", () => {
  const timeline = timelineOf([...messages.slice(0, -1), { type: "end", t: 33.456, interrupted: false }]);
  assert.equal(timeOfPlace({ t: 33.46 }, timeline), 33.456);
});

test("a server that is through is told from one that broke", () => {
  assert.ok(isEnd({ wasClean: true, code: 1000 }));
  assert.ok(isEnd({ wasClean: true, code: 1005 }));
  assert.ok(!isEnd({ wasClean: false, code: 1006 }));
  assert.ok(!isEnd({ wasClean: true, code: 1001 }));
});

test("playback begins anew with another run", () => {
  const playback = new Playback(() => {});
  const timeline = timelineOf();
  playback.arrived(timeline);
  playback.seek(timeline.duration, timeline);
  playback.play(timeline);
  playback.restart();
  assert.deepEqual([playback.t, playback.playing], [0, false]);
  playback.setFollow(timeline);
  playback.restart();
  assert.deepEqual([playback.t, playback.follow], [0, true]);
});

test("pictures of another run are drawn anew, though the view has the same number", () => {
  const [one, other] = [timelineOf(), timelineOf()];
  const drawn = picturesDrawn(one, 1, true);
  assert.ok(one.pictures.get(1)?.color);
  assert.ok(same(drawn, picturesDrawn(one, 1, true)));
  assert.ok(!same(drawn, picturesDrawn(other, 1, true)));
  assert.ok(!same(drawn, picturesDrawn(one, 1, false)));
  assert.ok(!same(drawn, picturesDrawn(one, 2, true)));
  one.append({ ...(one.pictures.get(1)?.color as Picture) });
  assert.ok(!same(drawn, picturesDrawn(one, 1, true)));
});

test("nothing of robot and truth is left when they are cleared, and they come again", () => {
  const { robot, truth } = timelineOf();
  assert.ok(robot && truth);
  const parts = { robot: new RobotModel(), truth: new TruthModel(), fruits: new TrueFruits() };
  const count = () => [parts.robot.group, parts.truth.plants, parts.truth.around, parts.fruits.group].map((g) => g.children.length);
  const detail = { pixels: 500, cellPixels: 1, coarse: false, budget_ms: Infinity };
  const set = () => {
    parts.robot.set(robot);
    parts.truth.set(truth);
    parts.truth.update(new THREE.PerspectiveCamera(), detail);
    parts.fruits.set(truth);
    parts.robot.move({ q: [0, 0, 0, 0, 0, 0], travel: 0, lift: 0 });
  };
  set();
  const whole = count();
  const [robotParts, plants, around, fruits] = whole;
  assert.ok(robotParts > 0 && plants > 0 && around === 0 && fruits > 0);
  for (const part of Object.values(parts)) part.clear();
  assert.deepEqual(count(), [0, 0, 0, 0]);
  assert.ok(parts.fruits.box().isEmpty());
  parts.robot.move({ q: [], travel: 0, lift: 0 });
  set();
  assert.deepEqual(count(), whole);
});

const kWide: Camera = { width: 100, height: 100, fx: 50, fy: 50, cx: 50, cy: 50 };
const kNarrow: Camera = { ...kWide, fx: 200, fy: 200 };

test("the frustum is that of the camera it was given last", () => {
  const frustum = new Frustum(1);
  const lines = frustum.group.children[0] as THREE.LineSegments;
  const width = () => {
    lines.geometry.computeBoundingBox();
    return lines.geometry.boundingBox?.getSize(new THREE.Vector3()).x ?? 0;
  };
  frustum.set(kWide);
  assert.ok(Math.abs(width() - 2) < 1e-6);
  frustum.set(kNarrow);
  assert.ok(Math.abs(width() - 0.5) < 1e-6);
  frustum.clear();
  assert.ok(!lines.visible);
  frustum.set(kNarrow);
  assert.ok(lines.visible);
});

test("a fruit is sought in each picture with that view's camera", async () => {
  const timeline = timelineOf(messages.slice(0, 3));
  const view = messages.find((m) => m.type === "view");
  assert.ok(view?.type === "view");
  const T_world_camera = Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0);
  // With the narrow camera the fruit is beside the picture.
  for (const [number, camera] of [[0, kWide], [1, null], [2, kNarrow], [3, null], [4, kWide]] as const)
    timeline.append({ ...view, view: number, t: number, T_world_camera, camera });
  const fruit = { centre: [0.3, 0, 1], semiAxes: [0.04, 0.04, 0.04] } as Fruit;
  const mask = { width: 50, height: 50, pixels: new Uint8Array(2500).fill(255) };
  const store = { fruit: async () => mask, depth: async () => null };
  const found = await sightings(timeline, store, fruit, 9);
  assert.deepEqual(found.map((s) => s.view.view), [0, 1, 4]);
  assert.ok(found.every((s) => Math.abs(s.u - 65) < 1e-9 && Math.abs(s.radius - 2) < 1e-9));
});

test("marks show what was taken by then, views and frames on the way apart", () => {
  const timeline = timelineOf();
  const palette = new Proxy({}, { get: () => "#204060" }) as Palette;
  for (const [marked, times] of [[markedViews, timeline.viewTimes], [markedLooks, timeline.lookTimes]] as const) {
    const marks = new ViewMarks(marked);
    marks.paint(palette);
    marks.show(timeline, times[1]);
    const mesh = marks.group.children[0] as THREE.InstancedMesh;
    assert.equal(mesh.count, 2);
    marks.show(timeline, timeline.duration);
    assert.equal((marks.group.children[0] as THREE.InstancedMesh).count, times.length);
  }
  const at = new THREE.Matrix4();
  const looks = markedLooks(timeline);
  at.copy(looks.matrix(0));
  const forward = new THREE.Vector3(0, 0, 1).transformDirection(at);
  assert.ok(forward.distanceTo(new THREE.Vector3(...timeline.looks[0].direction)) < 1e-4);
  assert.ok(new THREE.Vector3().setFromMatrixPosition(at).distanceTo(new THREE.Vector3(...timeline.looks[0].at)) < 1e-9);
});
