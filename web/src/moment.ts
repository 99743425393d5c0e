import type { Segment, View } from "./data/messages.ts";
import type { Timeline } from "./data/timeline.ts";

/** What the panels show: a run at a time. */
export interface Moment {
  timeline: Timeline;
  t: number;
  /** All messages up to this one have come. */
  step: number;
  view: View | null;
  segment: Segment | null;
}

/** What somebody picked out. */
export type Selection = { is: "view"; view: number } | { is: "fruit"; id: number } | null;

/** What panels may ask the page to do. */
export interface Actions {
  seek(t: number): void;
  selectView(view: number): void;
  selectFruit(id: number): void;
  clearSelection(): void;
  /** Looks at what was picked, from nearby. */
  lookAtSelection(): void;
  /** Shows a picture large. */
  enlarge(view: number): void;
}

export function momentAt(timeline: Timeline, t: number): Moment {
  return {
    timeline,
    t,
    step: timeline.stepAt(t),
    view: timeline.viewAt(t),
    segment: timeline.segmentAt(t),
  };
}
