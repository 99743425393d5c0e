import { el } from "./dom.ts";

/** Panels that share one place, one shown at a time. */
export class Tabs {
  readonly element: HTMLElement;
  private readonly buttons: HTMLButtonElement[];
  private shown = 0;

  constructor(
    private readonly pages: { name: string; element: HTMLElement }[],
    private readonly changed: () => void,
  ) {
    this.buttons = pages.map(({ name, element }, i) => {
      element.id ||= `page-${name.toLowerCase()}`;
      element.setAttribute("role", "tabpanel");
      element.setAttribute("aria-label", name);
      return el(
        "button",
        { role: "tab", "aria-controls": element.id, on: { click: () => this.show(i), keydown: (e: KeyboardEvent) => this.keyed(e) } },
        name,
      );
    });
    const list = el("div", { class: "tabs", role: "tablist", label: "Panels" }, ...this.buttons);
    this.element = el("section", { class: "card tabbed", label: "Figures and lists" }, list, ...pages.map((p) => p.element));
    this.show(0);
  }

  show(which: number): void {
    this.shown = which;
    this.pages.forEach(({ element }, i) => (element.hidden = i !== which));
    this.buttons.forEach((button, i) => {
      button.setAttribute("aria-selected", String(i === which));
      button.tabIndex = i === which ? 0 : -1;
    });
    this.changed();
  }

  private keyed(event: KeyboardEvent): void {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!by) return;
    event.preventDefault();
    event.stopPropagation();
    this.show((this.shown + by + this.pages.length) % this.pages.length);
    this.buttons[this.shown].focus();
  }
}
