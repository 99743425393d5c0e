import type { Timeline } from "./data/timeline.ts";

export const kSpeeds = [0.5, 1, 2, 4, 8, 16, 32, 64];

/** Where the page is in the run, and how it goes on from there. */
export class Playback {
  t = 0;
  playing = false;
  speed = 1;
  /** Stays with the newest, of a run that still goes on. */
  follow = false;
  /** Mission seconds a second, as messages come in. */
  private pace = 1;
  private newestAt = { wall: 0, t: 0 };

  constructor(private readonly changed: () => void) {}

  /** The stream begins anew, of this run or another. */
  restart(): void {
    this.t = 0;
    this.playing = false;
    this.pace = 1;
    this.newestAt = { wall: 0, t: 0 };
    this.changed();
  }

  /** Something new came in. */
  arrived(timeline: Timeline): void {
    const wall = performance.now() / 1000;
    const { newest } = timeline;
    if (newest > this.newestAt.t) {
      const gap = wall - this.newestAt.wall;
      if (this.newestAt.wall > 0 && gap > 0.02) {
        const pace = (newest - this.newestAt.t) / gap;
        this.pace += 0.3 * (Math.min(200, pace) - this.pace);
      }
      this.newestAt = { wall, t: newest };
    }
  }

  play(timeline: Timeline): void {
    if (this.t >= timeline.duration - 1e-3) this.t = 0;
    this.playing = true;
    this.changed();
  }

  pause(): void {
    this.playing = false;
    this.follow = false;
    this.changed();
  }

  toggle(timeline: Timeline): void {
    if (this.playing || this.follow) this.pause();
    else this.play(timeline);
  }

  /** Goes there and stays. */
  seek(t: number, timeline: Timeline): void {
    this.t = Math.min(Math.max(0, t), timeline.duration);
    this.follow = false;
    this.changed();
  }

  setFollow(timeline: Timeline): void {
    this.follow = true;
    this.playing = false;
    this.t = timeline.newest;
    this.changed();
  }

  changeSpeed(steps: number): void {
    const i = kSpeeds.indexOf(this.speed);
    this.speed = kSpeeds[Math.min(Math.max(0, i + steps), kSpeeds.length - 1)];
    this.changed();
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.changed();
  }

  stepView(by: 1 | -1, timeline: Timeline): void {
    this.stepTo(by, timeline.viewTimes, timeline);
  }

  stepSegment(by: 1 | -1, timeline: Timeline): void {
    this.stepTo(by, timeline.segments.map((s) => s.t), timeline);
  }

  /** Moves on by so many seconds of the wall clock; true: there is more to come. */
  advance(seconds: number, timeline: Timeline): boolean {
    if (this.follow) return this.chase(seconds, timeline);
    if (!this.playing) return false;
    this.t += seconds * this.speed;
    if (this.t >= timeline.duration) {
      this.t = timeline.duration;
      this.playing = false;
      this.changed();
    }
    return this.playing;
  }

  private stepTo(by: 1 | -1, times: number[], timeline: Timeline): void {
    const to = by > 0 ? times.find((t) => t > this.t + 1e-6) : times.findLast((t) => t < this.t - 1e-6);
    this.playing = false;
    this.seek(to ?? (by > 0 ? timeline.duration : 0), timeline);
  }

  /** Runs after the newest, at the pace it has; the motion under way is known to its end. */
  private chase(seconds: number, timeline: Timeline): boolean {
    const horizon = timeline.duration;
    const behind = timeline.newest - this.t;
    if (behind > 30) this.t = timeline.newest;
    const pace = Math.max(0.2, this.pace) + Math.max(0, behind) * 1.5;
    this.t = Math.min(horizon, this.t + seconds * pace);
    return this.t < horizon;
  }
}
