import { cameraPose } from "./kinematics.ts";
import type { Timeline } from "./timeline.ts";
import { upperBound } from "./search.ts";

/** How finely the camera's way is drawn. */
const kStep_s = 0.08;

/** The camera's way through all motions of the arm, piece by piece. */
export class Trail {
  /** Two points a piece. */
  readonly points: number[] = [];
  /** When each piece was driven. */
  readonly times: number[] = [];
  private done: { pieces: number; end: number }[] = [];

  /** Takes in what is new; true: there was something. */
  extend(timeline: Timeline): boolean {
    const { robot, tracks } = timeline;
    if (!robot) return false;
    const motions = tracks.motions;
    // The last one may have ended before it was to.
    let first = this.done.length;
    while (first > 0 && this.done[first - 1].end !== motions[first - 1]?.end) --first;
    if (first === motions.length && first === this.done.length) return false;
    this.cut(first);
    for (const { motion, end } of motions.slice(first)) {
      const begin = this.times.length;
      const position = (t: number) => {
        const T = cameraPose(robot, tracks.at(t));
        return [T[3], T[7], T[11]];
      };
      let from = position(motion.t);
      for (let t = motion.t; t < end - 1e-9; ) {
        t = Math.min(t + kStep_s, end);
        const to = position(t - 1e-9);
        this.points.push(...from, ...to);
        this.times.push(t);
        from = to;
      }
      this.done.push({ pieces: this.times.length - begin, end });
    }
    return true;
  }

  /** How many pieces were driven by then. */
  countAt(t: number): number {
    return upperBound(this.times, t);
  }

  private cut(motions: number): void {
    let pieces = 0;
    for (const { pieces: n } of this.done.splice(motions)) pieces += n;
    this.times.length -= pieces;
    this.points.length -= 6 * pieces;
  }
}
