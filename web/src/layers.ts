/** What can be shown and hidden; digits switch the first ten. */
export const kLayers = [
  { id: "robot", name: "Robot", on: true },
  { id: "camera", name: "Camera", on: true },
  { id: "occupied", name: "Map: occupied", on: true },
  { id: "roi", name: "Map: fruit", on: true },
  { id: "frontiers", name: "Frontiers", on: false },
  { id: "graph", name: "View graph", on: false },
  { id: "planned", name: "Way planned", on: true },
  { id: "driven", name: "Way driven", on: true },
  { id: "fruits", name: "Fruits found", on: true },
  { id: "plants", name: "True plants", on: true },
  { id: "trueFruits", name: "True fruits", on: false },
  { id: "around", name: "True surroundings", on: false },
  { id: "views", name: "Views taken", on: true },
  { id: "onTheWay", name: "Frames on the way", on: true },
  { id: "boxes", name: "Search boxes", on: false },
] as const;

export type LayerId = (typeof kLayers)[number]["id"];

export type FrontierKind = "roi" | "occupied" | "border";

/** Which layers are on; tells when one is switched. */
export class Layers {
  private readonly on = new Map<LayerId, boolean>(kLayers.map((l) => [l.id, l.on]));
  private readonly kinds = new Map<FrontierKind, boolean>([
    ["roi", true],
    ["occupied", true],
    ["border", true],
  ]);
  private readonly listeners: (() => void)[] = [];

  isOn(id: LayerId): boolean {
    return this.on.get(id) ?? false;
  }

  isKindOn(kind: FrontierKind): boolean {
    return this.kinds.get(kind) ?? false;
  }

  toggle(id: LayerId): void {
    this.on.set(id, !this.isOn(id));
    this.tell();
  }

  toggleKind(kind: FrontierKind): void {
    this.kinds.set(kind, !this.isKindOn(kind));
    this.tell();
  }

  /** Those that are on. */
  get shown(): LayerId[] {
    return kLayers.map((l) => l.id).filter((id) => this.isOn(id));
  }

  /** These, and no others. */
  show(ids: LayerId[]): void {
    for (const { id } of kLayers) this.on.set(id, ids.includes(id));
    this.tell();
  }

  listen(listener: () => void): void {
    this.listeners.push(listener);
    listener();
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }
}
