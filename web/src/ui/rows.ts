import { el } from "./dom.ts";

/** A long list of rows of one height; only those in sight are elements. */
export class Rows<T> {
  readonly element: HTMLElement;
  private readonly space = el("div", { class: "space" });
  private rows: readonly T[] = [];
  private drawn = "";
  private stick = -1;

  constructor(
    label: string,
    private readonly height: number,
    /** Fills a row; called again for the same element with another entry. */
    private readonly draw: (row: HTMLElement, entry: T, index: number) => void,
    private readonly clicked: (entry: T) => void,
  ) {
    this.element = el("div", { class: "rows", role: "group", tabindex: 0, label }, this.space);
    this.element.addEventListener("scroll", () => this.refresh(false), { passive: true });
    new ResizeObserver(() => this.refresh(true)).observe(this.element);
  }

  /** Shows these; keeps entry `current` in sight when that changes. */
  set(rows: readonly T[], current: number, force = false): void {
    this.rows = rows;
    this.space.style.height = `${rows.length * this.height}px`;
    if (current !== this.stick) {
      this.stick = current;
      this.reveal(current);
    }
    this.refresh(force);
  }

  private reveal(index: number): void {
    if (index < 0) return;
    const { scrollTop, clientHeight } = this.element;
    const top = index * this.height;
    if (top < scrollTop) this.element.scrollTop = top;
    else if (top + this.height > scrollTop + clientHeight)
      this.element.scrollTop = top + this.height - clientHeight;
  }

  private refresh(force: boolean): void {
    const first = Math.max(0, Math.floor(this.element.scrollTop / this.height) - 2);
    const wanted = Math.ceil(this.element.clientHeight / this.height) + 4;
    const count = Math.min(wanted, this.rows.length - first);
    const drawn = `${first} ${count} ${this.rows.length} ${this.stick}`;
    if (!force && drawn === this.drawn) return;
    this.drawn = drawn;
    while (this.space.childElementCount > Math.max(0, count)) this.space.lastElementChild?.remove();
    for (let i = 0; i < count; ++i) {
      const row = (this.space.children[i] ?? this.space.appendChild(this.make())) as HTMLElement;
      const index = first + i;
      row.style.top = `${index * this.height}px`;
      row.dataset.index = String(index);
      row.classList.toggle("current", index === this.stick);
      this.draw(row, this.rows[index], index);
    }
  }

  private make(): HTMLElement {
    const row = el("button", { class: "row" });
    row.style.height = `${this.height}px`;
    row.addEventListener("click", () => {
      const entry = this.rows[Number(row.dataset.index)];
      if (entry !== undefined) this.clicked(entry);
    });
    return row;
  }
}
