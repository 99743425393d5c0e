import type { Vec3 } from "../../src/data/messages.ts";
import { compose, fromRollPitchYaw, identity } from "../../src/data/kinematics.ts";

/** A pose of translation and roll, pitch, yaw as messages have it. */
export function pose(xyz: Vec3, rpy: Vec3 = [0, 0, 0]): number[] {
  const move = identity();
  for (let i = 0; i < 3; ++i) move[4 * i + 3] = xyz[i];
  return [...compose(move, fromRollPitchYaw(rpy))];
}

const kHalf = Math.PI / 2;
const cylinder = (radius: number, length: number, xyz: Vec3, rpy?: Vec3) => ({ kind: "cylinder", radius, length, pose: pose(xyz, rpy) });
const box = (size: Vec3, xyz: Vec3) => ({ kind: "box", size, pose: pose(xyz) });

/** An arm of six joints with a UR5e's lengths, on a trolley with a lift. */
export function robotHead(): Record<string, unknown> {
  const arm = (index: number) => ({ type: "revolute", axis: [0, 0, 1], source: "arm", index, multiplier: 1, offset: 0 });
  const links = [
    { name: "rails", parent: -1, type: "fixed", origin: pose([0, 0, 0]), source: "still", shapes: [] },
    { name: "trolley", parent: 0, type: "prismatic", origin: pose([0, 0, 0]), axis: [1, 0, 0], source: "travel", multiplier: 1, offset: 0, shapes: [box([1.63, 0.78, 0.5], [0.745, 0, 0.17]), box([0.31, 0.78, 1.28], [1.715, 0, 0.56])] },
    { name: "lift", parent: 1, type: "prismatic", origin: pose([0.026, 0, 0.469]), axis: [0, 0, 1], source: "lift", multiplier: 1, offset: 0, shapes: [box([1.445, 0.42, 0.147], [0.7225, 0, -0.0225])] },
    { name: "base", parent: 2, type: "fixed", origin: pose([0.1, -0.11, 0.1]), source: "still", shapes: [cylinder(0.075, 0.09, [0, 0, 0.045])] },
    { name: "shoulder", parent: 3, ...arm(0), origin: pose([0, 0, 0], [0, 0, Math.PI]), shapes: [cylinder(0.06, 0.1375, [0, 0, 0.154])] },
    { name: "upper arm", parent: 4, ...arm(1), origin: pose([0, 0, 0.1625], [kHalf, 0, 0]), shapes: [cylinder(0.06, 0.13, [0, 0, 0.135]), cylinder(0.055, 0.425, [-0.2125, 0, 0.138], [0, kHalf, 0])] },
    { name: "forearm", parent: 5, ...arm(2), origin: pose([-0.425, 0, 0]), shapes: [cylinder(0.05, 0.12, [0, 0, 0.01]), cylinder(0.045, 0.3922, [-0.1961, 0, 0.007], [0, kHalf, 0])] },
    { name: "wrist 1", parent: 6, ...arm(3), origin: pose([-0.3922, 0, 0]), shapes: [cylinder(0.042, 0.114, [0, 0, 0.123])] },
    { name: "wrist 2", parent: 7, ...arm(4), origin: pose([0, 0, 0.1333], [kHalf, 0, 0]), shapes: [cylinder(0.042, 0.09, [0, 0, 0.1])] },
    { name: "wrist 3", parent: 8, ...arm(5), origin: pose([0, 0, 0.0997], [-kHalf, 0, 0]), shapes: [cylinder(0.04, 0.0466, [0, 0, 0.0763])] },
    { name: "flange", parent: 9, type: "fixed", origin: pose([0, 0, 0.0996]), source: "still", shapes: [] },
    { name: "camera", parent: 10, type: "fixed", origin: pose([0, 0, 0.02], [0, 0, Math.PI]), source: "still", shapes: [box([0.09, 0.025, 0.025], [0, 0, -0.0125])] },
  ]; // prettier-ignore
  return {
    type: "robot",
    links,
    T_world_root: pose([0, -2, 0.12], [0, 0, kHalf]),
    camera_link: 11,
    camera: { width: 640, height: 480, fx: 380, fy: 380, cx: 320, cy: 240 },
    vertices: 0,
  };
}
