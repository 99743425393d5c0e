import type { Configuration } from "./kinematics.ts";
import type { Motion, Segment, Trolley, View } from "./messages.ts";
import { upperBound } from "./search.ts";

/** A motion of the arm, as far as it went. */
export interface ArmMotion {
  motion: Motion;
  end: number;
}

type ArmEntry = ArmMotion | { q: number[] };

interface TrolleyEntry {
  from: [number, number];
  to: [number, number];
  begin: number;
  duration: number;
}

/** Where the robot is at any time: the messages that tell of it, in order. */
export class Tracks {
  readonly motions: ArmMotion[] = [];
  private readonly armTimes: number[] = [];
  private readonly arm: ArmEntry[] = [];
  private readonly trolleyTimes: number[] = [];
  private readonly trolley: TrolleyEntry[] = [];

  addMotion(motion: Motion): void {
    const entry = { motion, end: motion.t + motion.duration };
    this.motions.push(entry);
    this.armTimes.push(motion.t);
    this.arm.push(entry);
  }

  /** The last motion ended then, perhaps on its way. */
  endMotion(t: number): void {
    const last = this.motions.at(-1);
    if (last) last.end = Math.min(last.end, Math.max(t, last.motion.t));
  }

  addView(view: View): void {
    this.armTimes.push(view.t);
    this.arm.push({ q: view.q });
    this.stand(view.t, view.travel, view.lift);
  }

  addSegment(segment: Segment): void {
    // A segment may be announced while the trolley still drives to it.
    const last = this.trolley.at(-1);
    if (last && last.begin + last.duration > segment.t) return;
    this.stand(segment.t, segment.travel, segment.lift);
  }

  addTrolley(drive: Trolley): void {
    const { travel, lift } = this.trolleyAt(drive.t);
    const from: [number, number] =
      this.trolley.length === 0 ? [drive.travel, drive.lift] : [travel, lift];
    this.trolleyTimes.push(drive.t);
    this.trolley.push({
      from,
      to: [drive.travel, drive.lift],
      begin: drive.t,
      duration: drive.duration,
    });
  }

  at(t: number): Configuration {
    return { q: this.armAt(t), ...this.trolleyAt(t) };
  }

  /** The motion under way at t. */
  motionAt(t: number): ArmMotion | null {
    const entry = this.arm[upperBound(this.armTimes, t) - 1];
    return entry && "motion" in entry && t < entry.end ? entry : null;
  }

  private stand(t: number, travel: number, lift: number): void {
    this.trolleyTimes.push(t);
    this.trolley.push({ from: [travel, lift], to: [travel, lift], begin: t, duration: 0 });
  }

  private armAt(t: number): ArrayLike<number> {
    // Before the first message the robot stands where it begins.
    const entry = this.arm[Math.max(0, upperBound(this.armTimes, t) - 1)];
    if (!entry) return [];
    return "q" in entry ? entry.q : sample(entry.motion, Math.min(t, entry.end) - entry.motion.t);
  }

  private trolleyAt(t: number): { travel: number; lift: number } {
    const entry = this.trolley[Math.max(0, upperBound(this.trolleyTimes, t) - 1)];
    if (!entry) return { travel: 0, lift: 0 };
    const share = entry.duration > 0 ? Math.min(1, Math.max(0, (t - entry.begin) / entry.duration)) : 1;
    const eased = share * share * (3 - 2 * share);
    const mix = (i: 0 | 1) => entry.from[i] + (entry.to[i] - entry.from[i]) * eased;
    return { travel: mix(0), lift: mix(1) };
  }
}

/** Joint positions so many seconds into a motion. */
export function sample(motion: Motion, t: number): Float64Array {
  const q = new Float64Array(motion.joints);
  if (motion.points === 0) return q;
  const x = Math.min(Math.max(t * motion.rate, 0), motion.points - 1);
  const i = Math.min(Math.floor(x), Math.max(0, motion.points - 2));
  const next = Math.min(i + 1, motion.points - 1);
  const w = x - i;
  for (let j = 0; j < motion.joints; ++j)
    q[j] =
      (1 - w) * motion.positions[i * motion.joints + j] + w * motion.positions[next * motion.joints + j];
  return q;
}
