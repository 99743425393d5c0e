import { upperBound } from "./search.ts";

/**
 * Values by key, at every step of a run: what was there after any step is found at once, so any
 * moment can be shown. Steps are added in order. A version is a row of four lists; each knows the one
 * of its key before it.
 */
export class History<V> {
  private readonly steps: number[] = [];
  private readonly keys: number[] = [];
  private readonly values: (V | undefined)[] = [];
  private readonly before: number[] = []; // −1: none
  private readonly newest = new Map<number, number>();

  /** From this step on; `undefined`: it is gone. */
  set(step: number, key: number, value: V | undefined): void {
    const last = this.newest.get(key) ?? -1;
    if (last >= 0 && this.steps[last] === step) {
      this.values[last] = value;
      return;
    }
    this.newest.set(key, this.steps.push(step) - 1);
    this.keys.push(key);
    this.values.push(value);
    this.before.push(last);
  }

  /** All that is there is gone from this step on. */
  clear(step: number): void {
    for (const [key, version] of this.newest)
      if (this.values[version] !== undefined) this.set(step, key, undefined);
  }

  /** After this step. */
  at(key: number, step: number): V | undefined {
    return this.values[this.versionAt(this.newest.get(key) ?? -1, step)];
  }

  /** The newest. */
  last(key: number): V | undefined {
    return this.values[this.newest.get(key) ?? -1];
  }

  /** The first there was. */
  first(key: number): V | undefined {
    let version = this.newest.get(key) ?? -1;
    while (version >= 0 && this.before[version] >= 0) version = this.before[version];
    return this.values[version];
  }

  /** All that is there after this step. */
  *entriesAt(step: number): Generator<[number, V]> {
    for (const [key, newest] of this.newest) {
      const value = this.values[this.versionAt(newest, step)];
      if (value !== undefined) yield [key, value];
    }
  }

  /** The step of the last change up to this one; −1: there was none. */
  lastChange(step: number): number {
    return this.steps[upperBound(this.steps, step) - 1] ?? -1;
  }

  /** Keys that may differ between two steps, whichever is later; some come more than once. */
  *changedBetween(a: number, b: number): Generator<number> {
    const from = upperBound(this.steps, Math.min(a, b));
    const to = upperBound(this.steps, Math.max(a, b));
    if (to - from < this.newest.size) {
      for (let i = from; i < to; ++i) yield this.keys[i];
    } else {
      yield* this.newest.keys();
    }
  }

  /** From a version back to the one that was there after a step; −1: none. */
  private versionAt(version: number, step: number): number {
    while (version >= 0 && this.steps[version] > step) version = this.before[version];
    return version;
  }
}
