import { transform } from "../data/kinematics.ts";
import type { Fruit, FruitPoints } from "../data/messages.ts";
import { fruitCss } from "../fruit_color.ts";
import { fruitPose } from "../scene/fruit_shapes.ts";
import { surface } from "../scene/superellipsoid.ts";

const kNamespace = "http://www.w3.org/2000/svg";

function svg(tag: string, attributes: Record<string, string | number>): SVGElement {
  const element = document.createElementNS(kNamespace, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  return element;
}

/** Convex hull of points in the plane (monotone chain). */
export function hull(points: [number, number][]): [number, number][] {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (list: [number, number][]) => {
    const chain: [number, number][] = [];
    for (const p of list) {
      while (chain.length > 1 && !turnsLeft(chain[chain.length - 2], chain[chain.length - 1], p)) chain.pop();
      chain.push(p);
    }
    return chain.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

function turnsLeft(a: [number, number], b: [number, number], c: [number, number]): boolean {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0;
}

/** Points drawn in one outline at most. */
const kDots = 150;

/** One dot a point, as a path: a circle each would be slow. */
function dots(points: FruitPoints, fruit: Fruit, right: number, up: number, reach: number): SVGElement {
  const count = points.points.length / 3;
  const some = Math.min(count, kDots);
  let path = "";
  for (let i = 0; i < some; ++i) {
    const at = 3 * Math.floor((i * count) / some);
    const [x, y] = [right, up].map((axis) => (48 * (points.points[at + axis] - fruit.centre[axis])) / reach);
    path += `M${x.toFixed(1)} ${(-y).toFixed(1)}h0`;
  }
  return svg("path", { d: path, class: "points" });
}

/**
 * The fruit's shape as it stands in the world, and the points it was fitted to, from the front (x z),
 * the side (y z) and above (x y).
 */
export function outlines(fruit: Fruit, points: FruitPoints | null): HTMLElement {
  const shape = surface(fruit).points;
  const T = fruitPose(fruit);
  const world: number[][] = [];
  for (let i = 0; i < shape.length; i += 3) {
    const p = transform(T, shape.subarray(i, i + 3));
    world.push(p.map((x, k) => x - fruit.centre[k]));
  }
  const reach = Math.max(0.02, 1.15 * Math.max(...fruit.semiAxes));
  const holder = document.createElement("div");
  holder.className = "outlines";
  for (const [name, right, up] of [["front", 0, 2], ["side", 1, 2], ["above", 0, 1]] as const) {
    const drawing = svg("svg", { viewBox: "-50 -50 100 100", role: "img", "aria-label": `Shape, ${name}` });
    const flat = world.map((p): [number, number] => [(48 * p[right]) / reach, (-48 * p[up]) / reach]);
    const corners = hull(flat).map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`);
    drawing.append(
      svg("line", { x1: -48, x2: 48, y1: 0, y2: 0, class: "cross" }),
      svg("line", { y1: -48, y2: 48, x1: 0, x2: 0, class: "cross" }),
      svg("polygon", { points: corners.join(" "), fill: fruitCss(fruit), "fill-opacity": 0.25 + 0.6 * fruit.confidence, class: "shape" }),
      ...(points ? [dots(points, fruit, right, up, reach)] : []),
      svg("line", { x1: -48, x2: -48 + (48 * 0.02) / reach, y1: 47, y2: 47, class: "rule" }),
    );
    const figure = document.createElement("figure");
    const caption = document.createElement("figcaption");
    caption.textContent = name;
    figure.append(drawing, caption);
    holder.append(figure);
  }
  return holder;
}
