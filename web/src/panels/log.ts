import type { Event } from "../data/timeline.ts";
import { upperBound } from "../data/search.ts";
import type { Actions, Moment } from "../moment.ts";
import { clock } from "../ui/format.ts";
import { el, fill } from "../ui/dom.ts";
import { Rows } from "../ui/rows.ts";

const kLevels = { info: "", notice: "Note", fault: "Fault", segment: "" };

/** What happened, in words. */
export class LogPanel {
  readonly element: HTMLElement;
  private readonly rows: Rows<Event>;
  private readonly none = el("p", { class: "none" }, "Nothing yet.");
  private now = 0;

  constructor(actions: Actions) {
    this.rows = new Rows<Event>(
      "Log",
      26,
      (row, event) => this.draw(row, event),
      (event) => actions.seek(event.t),
    );
    this.element = el("div", { class: "list log" }, this.none, this.rows.element);
  }

  update({ timeline, t }: Moment): void {
    if (this.element.hidden) return;
    this.now = t;
    this.none.hidden = timeline.events.length > 0;
    this.rows.set(timeline.events, upperBound(timeline.eventTimes, t) - 1, true);
  }

  private draw(row: HTMLElement, event: Event): void {
    row.classList.toggle("future", event.t > this.now);
    row.dataset.level = event.level;
    row.title = event.text;
    const word = kLevels[event.level];
    fill(
      row,
      el("span", { class: "time" }, clock(event.t)),
      word ? el("b", {}, word) : null,
      el("span", { class: "text" }, event.text),
    );
  }
}
