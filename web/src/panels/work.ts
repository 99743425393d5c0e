import { upperBound } from "../data/search.ts";
import type { Moment } from "../moment.ts";
import { seconds } from "../ui/format.ts";
import { el, fill, setText } from "../ui/dom.ts";
import { same } from "../ui/same.ts";

/** How many kinds of computation are named. */
const kNamed = 7;

/** Where the mission's time goes, and the computer's. */
export class WorkPanel {
  readonly element: HTMLElement;
  private readonly bar = el("div", { class: "stack", role: "img" });
  private readonly legend = el("p", { class: "legend" });
  private readonly bars = el("div", { class: "bars" });
  private readonly note = el("p", { class: "hint" }, "Computation by kind comes after each segment.");
  private shownAs: unknown[] = [];

  constructor() {
    this.element = el(
      "div",
      { class: "work" },
      el("h2", {}, "Where the time goes"),
      this.bar,
      this.legend,
      this.bars,
      this.note,
    );
  }

  update({ timeline, t, step }: Moment): void {
    const count = upperBound(timeline.viewTimes, t);
    const work = timeline.workAt(step);
    const as = [timeline, count, work[0]];
    if (same(as, this.shownAs) || this.element.closest("[hidden]")) return;
    this.shownAs = as;
    let [moving, planning] = [0, 0];
    for (const view of timeline.views.slice(0, count)) {
      moving += view.motion;
      planning += view.planning;
    }
    const last = timeline.views[count - 1]?.t ?? 0;
    this.drawShares([
      ["moving", "Moving", moving],
      ["planning", "Planning, standing still", planning],
      ["other", "Driving, looking", Math.max(0, last - moving - planning)],
    ]);
    const named = [...work].sort((a, b) => b.seconds - a.seconds).slice(0, kNamed);
    const most = named[0]?.seconds || 1;
    this.note.hidden = named.length > 0;
    fill(this.bars, ...named.map((w) => barRow(w.name.replaceAll("_", " "), w.seconds, w.seconds / most)));
  }

  private drawShares(shares: [string, string, number][]): void {
    const sum = shares.reduce((all, [, , s]) => all + s, 0) || 1;
    const parts = shares.map(([id, , s]) => {
      const part = el("span", { class: `part ${id}` });
      part.style.width = `${(100 * s) / sum}%`;
      return part;
    });
    fill(this.bar, ...parts);
    this.bar.setAttribute("aria-label", shares.map(([, name, s]) => `${name}: ${seconds(s)}`).join(", "));
    fill(
      this.legend,
      ...shares.map(([id, name, s]) => el("span", { class: `key ${id}` }, name, " ", el("b", {}, seconds(s)))),
    );
  }
}

function barRow(name: string, value: number, share: number): HTMLElement {
  const bar = el("span", { class: "bar" });
  bar.style.width = `${100 * share}%`;
  const label = el("span", { class: "label" });
  setText(label, name);
  return el("div", { class: "bar-row" }, label, el("span", { class: "track" }, bar), el("b", {}, seconds(value)));
}
