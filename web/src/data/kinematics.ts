import type { Pose } from "./fields.ts";
import type { Link, Robot } from "./messages.ts";

/** Where all joints are. */
export interface Configuration {
  q: ArrayLike<number>;
  travel: number;
  lift: number;
}

export function identity(): Pose {
  return Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0);
}

/** a · b */
export function compose(a: Pose, b: Pose): Pose {
  const out = new Float64Array(12);
  for (let r = 0; r < 12; r += 4) {
    for (let c = 0; c < 4; ++c)
      out[r + c] = a[r] * b[c] + a[r + 1] * b[4 + c] + a[r + 2] * b[8 + c] + (c === 3 ? a[r + 3] : 0);
  }
  return out;
}

/** T · p */
export function transform(T: Pose, p: ArrayLike<number>): [number, number, number] {
  const row = (r: number) => T[r] * p[0] + T[r + 1] * p[1] + T[r + 2] * p[2] + T[r + 3];
  return [row(0), row(4), row(8)];
}

/** T⁻¹ · p */
export function transformBack(T: Pose, p: ArrayLike<number>): [number, number, number] {
  const d = [p[0] - T[3], p[1] - T[7], p[2] - T[11]];
  const column = (c: number) => T[c] * d[0] + T[4 + c] * d[1] + T[8 + c] * d[2];
  return [column(0), column(1), column(2)];
}

/** A turn about an axis of any length but 0 (Rodrigues). */
export function rotation(axis: ArrayLike<number>, angle: number): Pose {
  const length = Math.hypot(axis[0], axis[1], axis[2]) || 1;
  const [x, y, z] = [axis[0] / length, axis[1] / length, axis[2] / length];
  const [s, c] = [Math.sin(angle), Math.cos(angle)];
  const d = 1 - c;
  return Float64Array.of(
    c + x * x * d, x * y * d - z * s, x * z * d + y * s, 0,
    y * x * d + z * s, c + y * y * d, y * z * d - x * s, 0,
    z * x * d - y * s, z * y * d + x * s, c + z * z * d, 0,
  ); // prettier-ignore
}

/** Rz(yaw) · Ry(pitch) · Rx(roll), as in URDF and fruits.csv. */
export function fromRollPitchYaw([roll, pitch, yaw]: ArrayLike<number> & Iterable<number>): Pose {
  return compose(
    compose(rotation([0, 0, 1], yaw), rotation([0, 1, 0], pitch)),
    rotation([1, 0, 0], roll),
  );
}

function jointMotion(link: Link, position: number): Pose {
  if (link.type === "revolute") return rotation(link.axis, position);
  const pose = identity();
  for (let i = 0; i < 3; ++i) pose[4 * i + 3] = link.axis[i] * position;
  return pose;
}

function jointPosition(link: Link, at: Configuration): number {
  const source = { arm: at.q[link.index] ?? 0, travel: at.travel, lift: at.lift, still: 0 };
  return link.multiplier * source[link.source] + link.offset;
}

/** T_world_link of every link. */
export function linkPoses(robot: Robot, at: Configuration): Pose[] {
  const poses: Pose[] = [];
  for (const link of robot.links) poses.push(linkPose(robot, link, at, poses));
  return poses;
}

function linkPose(robot: Robot, link: Link, at: Configuration, poses: Pose[]): Pose {
  const parent = link.parent < 0 ? robot.T_world_root : poses[link.parent];
  const T_world_joint = compose(parent, link.origin);
  if (link.type === "fixed" || link.source === "still") return T_world_joint;
  return compose(T_world_joint, jointMotion(link, jointPosition(link, at)));
}

/** T_world_camera; only the links between root and camera are looked at. */
export function cameraPose(robot: Robot, at: Configuration): Pose {
  const chain: number[] = [];
  for (let i = robot.cameraLink; i >= 0; i = robot.links[i].parent) chain.push(i);
  const poses: Pose[] = [];
  for (const i of chain.reverse()) poses[i] = linkPose(robot, robot.links[i], at, poses);
  return poses[robot.cameraLink];
}
