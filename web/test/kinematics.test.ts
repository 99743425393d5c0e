import assert from "node:assert/strict";
import test from "node:test";
import {
  cameraPose,
  compose,
  fromRollPitchYaw,
  identity,
  linkPoses,
  rotation,
  transform,
  transformBack,
} from "../src/data/kinematics.ts";
import type { Robot } from "../src/data/messages.ts";
import { readFrame } from "../src/data/protocol.ts";
import { frame, random } from "./made/frames.ts";
import { pose, robotHead } from "./made/robot.ts";

const robot = readFrame(frame(robotHead())) as Robot;

function near(a: ArrayLike<number>, b: ArrayLike<number>, tolerance: number): void {
  assert.equal(a.length, b.length);
  for (let i = 0; i < a.length; ++i) assert.ok(Math.abs(a[i] - b[i]) < tolerance, `${i}: ${a[i]} and ${b[i]}`);
}

test("a turn about z moves x to y", () => {
  near(transform(rotation([0, 0, 2], Math.PI / 2), [1, 0, 0]), [0, 1, 0], 1e-12);
});

test("roll, pitch and yaw turn in this order about fixed axes", () => {
  near(transform(fromRollPitchYaw([Math.PI / 2, 0, Math.PI / 2]), [0, 1, 0]), [0, 0, 1], 1e-12);
  near(transform(fromRollPitchYaw([0, Math.PI / 2, 0]), [1, 0, 0]), [0, 0, -1], 1e-12);
});

test("transformBack undoes transform", () => {
  const T = compose(rotation([1, 2, 3], 0.7), Float64Array.from(pose([1, 2, 3], [0.1, 0.2, 0.3])));
  near(transformBack(T, transform(T, [0.3, -2, 5])), [0.3, -2, 5], 1e-12);
  near(compose(identity(), T), T, 1e-15);
});

test("the camera of the home state is where the mission's record has it", () => {
  // View 0 of the smoke mission: a UR5e on its trolley, 1 m along the rails.
  const q = [0, -0.7853981633974483, 1.5707963267948966, -0.7853981633974483, 0, 0];
  const T = cameraPose(robot, { q, travel: 1, lift: 0 });
  near(T, [0, 0, -1, -0.1429, 1, 0, 0, -0.296152, 0, -1, 0, 0.774993], 2e-4);
});

test("and so is the camera of another view", () => {
  const q = [-0.14364163630887195, -0.5704472267190788, 1.2106197331383186, -0.5996681205807866, -0.2966198686731429, -0.03873736565427333];
  const T = cameraPose(robot, { q, travel: 1, lift: 0 });
  const recorded = [-0.152156, -0.011698, -0.988287, -0.044473, 0.988357, -0.001801, -0.152145, -0.211787, 0, -0.99993, 0.011836, 0.748527];
  near(T, recorded, 2e-4);
});

test("the camera's chain gives what all links give", () => {
  const next = random(2);
  for (let i = 0; i < 100; ++i) {
    const at = { q: Array.from({ length: 6 }, () => 6 * next() - 3), travel: next(), lift: next() };
    near(cameraPose(robot, at), linkPoses(robot, at)[robot.cameraLink], 1e-15);
  }
});

test("multiplier and offset make a joint follow another", () => {
  const head = robotHead() as { links: Record<string, unknown>[] };
  Object.assign(head.links[2], { multiplier: -2, offset: 0.5 });
  const other = readFrame(frame(head as Record<string, unknown>)) as Robot;
  const at = (r: Robot, lift: number) => cameraPose(r, { q: [0, 0, 0, 0, 0, 0], travel: 0, lift });
  near(at(other, 0.1), at(robot, 0.3), 1e-12);
});
