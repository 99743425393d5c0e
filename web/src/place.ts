import type { Timeline } from "./data/timeline.ts";

/** A place in a run, as links name it: `#view=12` or `#t=33.5`; `fruit=3` may come with either. */
export interface Place {
  view?: number;
  t?: number;
  fruit?: number;
}

export function parsePlace(hash: string): Place {
  const members = new URLSearchParams(hash.replace(/^#/, ""));
  const place: Place = {};
  for (const name of ["view", "t", "fruit"] as const) {
    const text = members.get(name);
    const value = text === null || text.trim() === "" ? NaN : Number(text);
    if (!Number.isFinite(value) || value < 0) continue;
    if (name === "t" || Number.isInteger(value)) place[name] = value;
  }
  return place;
}

export function formatPlace(place: Place): string {
  const members: string[] = [];
  if (place.view !== undefined) members.push(`view=${place.view}`);
  else if (place.t !== undefined) members.push(`t=${Number(place.t.toFixed(2))}`);
  if (place.fruit !== undefined) members.push(`fruit=${place.fruit}`);
  return `#${members.join("&")}`;
}

/** When a place is, once so much of the run has come; null: not yet, or there is no such view. */
export function timeOfPlace({ view, t }: Place, timeline: Timeline): number | null {
  if (view !== undefined) return timeline.view(view)?.t ?? null;
  if (t === undefined) return null;
  // Times in links are rounded: that of the end may lie after it.
  return timeline.newest >= t || timeline.complete ? Math.min(t, timeline.duration) : null;
}
