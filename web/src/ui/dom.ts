type Child = Node | string | null;

interface Attributes {
  class?: string;
  title?: string;
  label?: string; // for those who hear the page
  on?: Partial<Record<keyof HTMLElementEventMap, (event: never) => void>>;
  [attribute: string]: unknown;
}

/** An element. Texts become text nodes: nothing from a message is ever read as HTML. */
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    if (name === "on") {
      for (const [event, call] of Object.entries(value as object)) element.addEventListener(event, call);
    } else if (name === "label") {
      element.setAttribute("aria-label", String(value));
    } else {
      element.setAttribute(name, value === true ? "" : String(value));
    }
  }
  element.append(...children.filter((c) => c !== null));
  return element;
}

/** Sets a text only where it differs. */
export function setText(node: Node, text: string): void {
  if (node.textContent !== text) node.textContent = text;
}

/** Replaces all children. */
export function fill(parent: Element, ...children: Child[]): void {
  parent.replaceChildren(...children.filter((c) => c !== null));
}

/** A canvas as large as its box, in device pixels; returns its context, scaled to CSS pixels. */
export function fitCanvas(canvas: HTMLCanvasElement): CanvasRenderingContext2D | null {
  const ratio = Math.min(devicePixelRatio, 2);
  const { clientWidth: w, clientHeight: h } = canvas;
  if (w === 0 || h === 0) return null;
  if (canvas.width !== Math.round(w * ratio)) canvas.width = Math.round(w * ratio);
  if (canvas.height !== Math.round(h * ratio)) canvas.height = Math.round(h * ratio);
  const context = canvas.getContext("2d");
  context?.setTransform(ratio, 0, 0, ratio, 0, 0);
  context?.clearRect(0, 0, w, h);
  return context;
}
