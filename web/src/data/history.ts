import { upperBound } from "./search.ts";

interface Versions<V> {
  steps: number[];
  values: (V | undefined)[];
}

/**
 * Values by key, at every step of a run: what was there after step n is found in logarithmic time,
 * so any moment can be shown at once. Steps are added in order.
 */
export class History<V> {
  private readonly versions = new Map<number, Versions<V>>();
  private readonly changeSteps: number[] = [];
  private readonly changeKeys: number[] = [];

  /** From this step on; `undefined`: it is gone. */
  set(step: number, key: number, value: V | undefined): void {
    let versions = this.versions.get(key);
    if (!versions) this.versions.set(key, (versions = { steps: [], values: [] }));
    const { steps, values } = versions;
    if (steps.length > 0 && steps[steps.length - 1] === step) {
      values[values.length - 1] = value;
      return;
    }
    steps.push(step);
    values.push(value);
    this.changeSteps.push(step);
    this.changeKeys.push(key);
  }

  /** All that is there is gone from this step on. */
  clear(step: number): void {
    for (const [key, { values }] of this.versions)
      if (values[values.length - 1] !== undefined) this.set(step, key, undefined);
  }

  /** After this step. */
  at(key: number, step: number): V | undefined {
    const versions = this.versions.get(key);
    if (!versions) return undefined;
    const i = upperBound(versions.steps, step);
    return i === 0 ? undefined : versions.values[i - 1];
  }

  /** The newest. */
  last(key: number): V | undefined {
    return this.versions.get(key)?.values.at(-1);
  }

  /** All that is there after this step. */
  *entriesAt(step: number): Generator<[number, V]> {
    for (const [key, { steps, values }] of this.versions) {
      const i = upperBound(steps, step);
      const value = i === 0 ? undefined : values[i - 1];
      if (value !== undefined) yield [key, value];
    }
  }

  /** The step of the last change up to this one; −1: there was none. */
  lastChange(step: number): number {
    const i = upperBound(this.changeSteps, step);
    return i === 0 ? -1 : this.changeSteps[i - 1];
  }

  /** Keys that may differ between two steps, whichever is later; some come more than once. */
  *changedBetween(a: number, b: number): Generator<number> {
    const from = upperBound(this.changeSteps, Math.min(a, b));
    const to = upperBound(this.changeSteps, Math.max(a, b));
    if (to - from < this.versions.size) {
      for (let i = from; i < to; ++i) yield this.changeKeys[i];
    } else {
      yield* this.versions.keys();
    }
  }
}
