import { el, setText } from "../ui/dom.ts";

/** One clear sentence, where something is not as it should be. */
export class Notice {
  readonly element = el("p", { class: "notice", role: "status", hidden: true });

  say(text: string, level: "info" | "warning" = "info"): void {
    this.element.hidden = text === "";
    this.element.dataset.level = level;
    setText(this.element, text);
  }
}
