import type { Connection } from "../connection.ts";
import type { Moment } from "../moment.ts";
import { el, setText } from "../ui/dom.ts";

/** Factors of simulated time; 0: as fast as it goes. */
const kPaces = [1, 2, 5, 10, 0];

/** Tells a live mission what to do. Shown only to those who may. */
export class Controls {
  readonly element: HTMLElement;
  private readonly pace = el("select", { label: "Pace of simulated time", title: "Pace of simulated time" });
  private readonly dialog: HTMLDialogElement;
  private readonly state = el("span", { class: "label" }, "Mission");
  private readonly holdButton: HTMLElement;
  private other: HTMLElement | null = null;

  constructor(connection: () => Connection) {
    const word = (name: string, title: string, call: () => void, more = "") =>
      el("button", { class: `plain ${more}`, title, on: { click: call } }, name);
    for (const pace of kPaces) this.pace.append(el("option", { value: pace }, pace === 0 ? "at once" : `${pace}× time`));
    this.pace.value = "0";
    this.pace.addEventListener("change", () => connection().setSpeed(Number(this.pace.value)));
    const close = () => this.dialog.close();
    this.dialog = el(
      "dialog",
      { class: "ask", label: "Stop the mission?" },
      el("p", {}, "Stop the mission? The robot ends its motion, and the run ends here."),
      el(
        "div",
        { class: "buttons" },
        word("Keep it running", "Nothing happens", close),
        word("Stop the mission", "End the run", () => (connection().steer("stop"), close()), "danger"),
      ),
    );
    this.holdButton = word("Pause", "The mission holds after its motion", () => connection().steer("pause"));
    this.element = el(
      "div",
      { class: "controls", role: "group", label: "Mission", hidden: true },
      this.state,
      this.holdButton,
      word("Go on", "The mission goes on", () => connection().steer("go_on")),
      word("Next segment", "Leaves this segment", () => connection().steer("next_segment")),
      word("Stop", "Ends the run", () => this.dialog.showModal(), "danger"),
      this.pace,
      this.dialog,
    );
  }

  /** Somebody else may have set one that is not in the list. */
  private showPace(factor: number): void {
    if (Number(this.pace.value) === factor) return;
    this.other?.remove();
    this.other = kPaces.includes(factor) ? null : el("option", { value: factor }, `${factor}× time`);
    if (this.other) this.pace.append(this.other);
    this.pace.value = String(factor);
  }

  update({ timeline }: Moment, open: boolean): void {
    const { hello, reader, end, holds, pace } = timeline;
    this.element.hidden = !(open && reader.controls && reader.live && !end);
    this.pace.hidden = !hello?.simulated;
    if (document.activeElement !== this.pace) this.showPace(pace);
    this.holdButton.setAttribute("aria-pressed", String(holds));
    setText(this.state, holds ? "Mission holds" : "Mission");
  }
}
