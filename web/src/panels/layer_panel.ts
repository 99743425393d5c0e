import { type FrontierKind, kLayers, type Layers } from "../layers.ts";
import { el } from "../ui/dom.ts";
import { icon } from "../ui/icons.ts";

const kFrontierKinds: [FrontierKind, string][] = [
  ["roi", "fruit"],
  ["occupied", "occupied"],
  ["border", "border"],
];

const kTruth = new Set<string>(["plants", "trueFruits", "around"]);

/** Switches for what the 3D picture shows. */
export class LayerPanel {
  readonly element: HTMLElement;
  private readonly truthRows: HTMLElement[];
  private readonly lookRows: HTMLElement[];
  private readonly list = el("div", { class: "layer-list", id: "layers" });

  constructor(
    layers: Layers,
    private readonly simulated: () => boolean,
    private readonly looksOnTheWay: () => boolean,
  ) {
    const switches = kLayers.map((layer, i) => {
      const input = el("input", { type: "checkbox" });
      input.addEventListener("change", () => layers.toggle(layer.id));
      const key = i < 10 ? el("kbd", {}, String((i + 1) % 10)) : null;
      const row = el("label", { class: `check layer ${layer.id}` }, input, el("i", { class: "sample" }), layer.name, key);
      return { layer, input, row };
    });
    const kinds = kFrontierKinds.map(([kind, name]) => {
      const button = el("button", { class: `chip kind ${kind}`, on: { click: () => layers.toggleKind(kind) } }, name);
      return { kind, button };
    });
    const kindRow = el("div", { class: "kinds", role: "group", label: "Kinds of frontiers" }, ...kinds.map((k) => k.button));
    for (const { layer, row } of switches) {
      this.list.append(row);
      if (layer.id === "frontiers") this.list.append(kindRow);
    }
    const toggle = el("button", { class: "plain", "aria-controls": "layers", on: { click: () => this.toggle(toggle) } }, icon("layers"), "Layers");
    this.element = el("div", { class: "layers" }, toggle, this.list);
    this.list.hidden = matchMedia("(max-width: 760px)").matches;
    toggle.setAttribute("aria-expanded", String(!this.list.hidden));
    layers.listen(() => {
      for (const { layer, input } of switches) input.checked = layers.isOn(layer.id);
      for (const { kind, button } of kinds) button.setAttribute("aria-pressed", String(layers.isKindOn(kind)));
      kindRow.hidden = !layers.isOn("frontiers");
    });
    this.truthRows = switches.filter((s) => kTruth.has(s.layer.id)).map((s) => s.row);
    this.lookRows = switches.filter((s) => s.layer.id === "onTheWay").map((s) => s.row);
  }

  /** The truth is known in simulation only; most missions take no frames on the way. */
  update(): void {
    for (const row of this.lookRows) row.hidden = !this.looksOnTheWay();
    for (const row of this.truthRows) row.hidden = !this.simulated();
  }

  private toggle(button: HTMLElement): void {
    this.list.hidden = !this.list.hidden;
    button.setAttribute("aria-expanded", String(!this.list.hidden));
  }
}
