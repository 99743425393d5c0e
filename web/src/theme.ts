import type { Kind } from "./data/messages.ts";

/** Light or dark; "auto" follows the system. */
export type ThemeChoice = "auto" | "light" | "dark";

/** Colours that canvas and WebGL need; the style sheet has the same ones. Chosen after Okabe and Ito. */
export interface Palette {
  background: string;
  ground: string;
  grid: string;
  ink: string;
  muted: string;
  rule: string;
  card: string;
  robot: string;
  robotDark: string;
  voxel: string;
  floorVoxel: string;
  roi: string;
  occupied: string;
  border: string;
  none: string;
  driven: string;
  planned: string;
  accent: string;
}

const kLight: Palette = {
  background: "#f1f3f1",
  ground: "#e7eae7",
  grid: "#d3d9d4",
  ink: "#1d2420",
  muted: "#5d6862",
  rule: "#dfe3df",
  card: "#ffffff",
  robot: "#eceff2",
  robotDark: "#a3afba",
  voxel: "#7ba283",
  floorVoxel: "#d2d5cf",
  roi: "#b0307a",
  occupied: "#0068a8",
  border: "#c77700",
  none: "#6f7a74",
  driven: "#0a8a62",
  planned: "#6b5bb5",
  accent: "#0068a8",
};

const kDark: Palette = {
  background: "#101412",
  ground: "#171c19",
  grid: "#2a322d",
  ink: "#e6ebe7",
  muted: "#9aa69f",
  rule: "#343b37",
  card: "#1c211e",
  robot: "#c3cad1",
  robotDark: "#67727d",
  voxel: "#739b7c",
  floorVoxel: "#3a443e",
  roi: "#ee85bd",
  occupied: "#5ab4ec",
  border: "#f0ae3c",
  none: "#98a39c",
  driven: "#3cc79b",
  planned: "#a99cf0",
  accent: "#5ab4ec",
};

const kKey = "canopeer-theme";

/** Knows whether the page is light or dark, and tells when that changes. */
export class Theme {
  choice: ThemeChoice = readChoice();
  private readonly system = matchMedia("(prefers-color-scheme: dark)");
  private readonly listeners: ((palette: Palette) => void)[] = [];

  constructor() {
    this.system.addEventListener("change", () => this.apply());
    this.apply();
  }

  get dark(): boolean {
    return this.choice === "auto" ? this.system.matches : this.choice === "dark";
  }

  get palette(): Palette {
    return this.dark ? kDark : kLight;
  }

  /** Calls now, and at every change. */
  use(listener: (palette: Palette) => void): void {
    this.listeners.push(listener);
    listener(this.palette);
  }

  toggle(): void {
    this.choice = this.dark ? "light" : "dark";
    try {
      localStorage.setItem(kKey, this.choice);
    } catch {
      // A browser may forbid it; the choice then lasts until the page is closed.
    }
    this.apply();
  }

  private apply(): void {
    document.documentElement.dataset.theme = this.dark ? "dark" : "light";
    for (const listener of this.listeners) listener(this.palette);
  }
}

function readChoice(): ThemeChoice {
  try {
    const said = localStorage.getItem(kKey);
    return said === "light" || said === "dark" ? said : "auto";
  } catch {
    return "auto";
  }
}

/** The colour of what a view, node or target is after. */
export function kindColor(palette: Palette, kind: Kind | string): string {
  if (kind === "roi" || kind === "occupied" || kind === "border") return palette[kind];
  return palette.none;
}
