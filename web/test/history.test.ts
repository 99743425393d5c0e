import assert from "node:assert/strict";
import test from "node:test";
import { History } from "../src/data/history.ts";
import { random } from "./made/frames.ts";

test("any step is as it was, held against a plain map", () => {
  const next = random(5);
  const history = new History<number>();
  const now = new Map<number, number>();
  const then: Map<number, number>[] = [];
  for (let step = 0; step < 300; ++step) {
    for (let i = 0; i < 4; ++i) {
      const key = Math.floor(20 * next());
      const value = next() < 0.3 ? undefined : next();
      history.set(step, key, value);
      if (value === undefined) now.delete(key);
      else now.set(key, value);
    }
    if (next() < 0.03) {
      history.clear(step);
      now.clear();
    }
    then.push(new Map(now));
  }
  for (let step = 0; step < 300; ++step) {
    assert.deepEqual(new Map([...history.entriesAt(step)].sort()), new Map([...then[step]].sort()));
    for (let key = 0; key < 20; ++key) assert.equal(history.at(key, step), then[step].get(key));
  }
});

test("changes between two steps lead from one to the other, both ways", () => {
  const next = random(6);
  const history = new History<number>();
  for (let step = 0; step < 200; ++step) history.set(step, Math.floor(50 * next()), next());
  for (let i = 0; i < 200; ++i) {
    const [from, to] = [Math.floor(201 * next()) - 1, Math.floor(201 * next()) - 1];
    const shown = new Map(history.entriesAt(from));
    for (const key of history.changedBetween(from, to)) {
      const value = history.at(key, to);
      if (value === undefined) shown.delete(key);
      else shown.set(key, value);
    }
    assert.deepEqual(new Map([...shown].sort()), new Map([...history.entriesAt(to)].sort()));
  }
});

test("before the first step there is nothing", () => {
  const history = new History<number>();
  history.set(3, 1, 10);
  assert.equal(history.at(1, 2), undefined);
  assert.equal(history.lastChange(2), -1);
  assert.equal(history.lastChange(9), 3);
});
