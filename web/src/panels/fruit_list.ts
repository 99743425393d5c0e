import type { Fruit } from "../data/messages.ts";
import { fruitCss } from "../fruit_color.ts";
import type { Actions, Moment } from "../moment.ts";
import { percent } from "../ui/format.ts";
import { el, fill } from "../ui/dom.ts";
import { Rows } from "../ui/rows.ts";
import { same } from "../ui/same.ts";

export function swatch(fruit: Fruit): HTMLElement {
  const patch = el("i", { class: "swatch" });
  patch.style.background = fruitCss(fruit);
  return patch;
}

/** The fruits known now. */
export class FruitList {
  readonly element: HTMLElement;
  private readonly rows: Rows<Fruit>;
  private readonly none = el("p", { class: "none" }, "No fruit yet.");
  private shownAs: unknown[] = [];

  constructor(actions: Actions) {
    this.rows = new Rows<Fruit>(
      "Fruits",
      28,
      (row, fruit) => this.draw(row, fruit),
      (fruit) => actions.selectFruit(fruit.id),
    );
    const head = ["Fruit", "Volume", "Sure", "Seen", "Views", "Ripeness"].map((name) => el("span", {}, name));
    this.element = el(
      "div",
      { class: "list fruits" },
      el("div", { class: "row head" }, ...head),
      this.none,
      this.rows.element,
    );
  }

  update({ timeline, step }: Moment): void {
    if (this.element.hidden) return;
    const as = [timeline, timeline.fruits.lastChange(step)];
    const fruits = [...timeline.fruits.entriesAt(step)].map(([, fruit]) => fruit);
    fruits.sort((a, b) => a.id - b.id);
    this.none.hidden = fruits.length > 0;
    this.rows.set(fruits, -1, !same(as, this.shownAs));
    this.shownAs = as;
  }

  private draw(row: HTMLElement, fruit: Fruit): void {
    fill(
      row,
      el("span", {}, swatch(fruit), String(fruit.id)),
      el("span", {}, `${fruit.volume.toFixed(0)} cm³`),
      el("span", {}, percent(fruit.confidence)),
      el("span", {}, percent(fruit.seenShare)),
      el("span", {}, String(fruit.views)),
      el("span", {}, fruit.ripeness),
    );
  }
}
