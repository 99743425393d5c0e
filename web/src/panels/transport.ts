import type { Moment } from "../moment.ts";
import { kSpeeds, type Playback } from "../playback.ts";
import type { Theme } from "../theme.ts";
import { clock } from "../ui/format.ts";
import { el, fill, setText } from "../ui/dom.ts";
import { icon, type IconName } from "../ui/icons.ts";
import { Scrub } from "./scrub.ts";

/** Play, step, speed, and the line of time. */
export class Transport {
  readonly element: HTMLElement;
  private readonly playButton: HTMLButtonElement;
  private readonly liveButton: HTMLButtonElement;
  private readonly speed = el("select", { label: "Speed", title: "Speed (+ −)" });
  private readonly time = el("span", { class: "clock" });
  private readonly scrub: Scrub;
  private shown = "";

  constructor(
    private readonly playback: Playback,
    theme: Theme,
    calls: { toggle(): void; view(by: 1 | -1): void; segment(by: 1 | -1): void; seek(t: number): void; live(): void },
    controls: HTMLElement,
  ) {
    this.scrub = new Scrub(theme, calls.seek);
    const button = (name: IconName, label: string, key: string, click: () => void, more = "") =>
      el("button", { class: `round ${more}`, label, title: `${label} (${key})`, on: { click } }, icon(name));
    this.playButton = button("play", "Play", "Space", calls.toggle, "main");
    this.liveButton = el("button", { class: "live", title: "Stay with the newest (L)", on: { click: calls.live } }, "Live");
    for (const speed of kSpeeds) this.speed.append(el("option", { value: speed }, `${speed}×`));
    this.speed.addEventListener("change", () => playback.setSpeed(Number(this.speed.value)));
    this.element = el(
      "footer",
      { class: "transport" },
      el(
        "div",
        { class: "buttons" },
        button("previousSegment", "Segment before", "PgUp", () => calls.segment(-1)),
        button("previous", "View before", "←", () => calls.view(-1)),
        this.playButton,
        button("next", "Next view", "→", () => calls.view(1)),
        button("nextSegment", "Next segment", "PgDn", () => calls.segment(1)),
      ),
      this.speed,
      this.time,
      this.scrub.element,
      this.liveButton,
      controls,
    );
  }

  update(moment: Moment, live: boolean): void {
    const { playing, follow, speed } = this.playback;
    const as = `${playing || follow} ${follow} ${speed} ${live}`;
    if (as !== this.shown) {
      this.shown = as;
      const running = playing || follow;
      fill(this.playButton, icon(running ? "pause" : "play"));
      this.playButton.setAttribute("aria-label", running ? "Hold" : "Play");
      this.speed.value = String(speed);
      this.liveButton.hidden = !live;
      this.liveButton.setAttribute("aria-pressed", String(follow));
    }
    setText(this.time, `${clock(moment.t)} / ${clock(moment.timeline.duration)}`);
    this.scrub.update(moment);
  }
}
