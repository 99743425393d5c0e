import type { View } from "../data/messages.ts";
import type { Actions, Moment } from "../moment.ts";
import { brief, kindName, shortClock } from "../ui/format.ts";
import { el, fill } from "../ui/dom.ts";
import { Rows } from "../ui/rows.ts";

/** All views: what each was after, what was promised and what came of it. */
export class ViewList {
  readonly element: HTMLElement;
  private readonly rows: Rows<View>;
  private now = 0;

  constructor(actions: Actions) {
    this.rows = new Rows<View>(
      "Views",
      28,
      (row, view) => this.draw(row, view),
      (view) => actions.selectView(view.view),
    );
    const head = ["View", "For", "Time", "Promised", "Seen", "Fruits"].map((name) => el("span", {}, name));
    this.element = el("div", { class: "list views" }, el("div", { class: "row head" }, ...head), this.rows.element);
  }

  update({ timeline, t, view }: Moment): void {
    if (this.element.hidden) return;
    const current = view ? timeline.views.indexOf(view) : -1;
    this.now = t;
    this.rows.set(timeline.views, current, true);
  }

  private draw(row: HTMLElement, view: View): void {
    row.classList.toggle("future", view.t > this.now);
    row.title = "voxels that were unknown before";
    fill(
      row,
      el("span", {}, String(view.view)),
      el("span", { class: `kind ${view.kind}` }, kindName(view.kind)),
      el("span", {}, shortClock(view.t)),
      el("span", {}, brief(view.predicted)),
      el("span", {}, brief(view.realised)),
      el("span", {}, String(view.fruits)),
    );
  }
}
