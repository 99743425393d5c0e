/** Drawings on a 24 × 24 grid. */
const kPaths = {
  play: "M8 5.5v13l10.5-6.5z",
  pause: "M7.5 5.5h3.2v13H7.5zM13.3 5.5h3.2v13h-3.2z",
  next: "M7 6l8 6-8 6zM15.6 6h2v12h-2z",
  previous: "M17 6l-8 6 8 6zM6.4 6h2v12h-2z",
  nextSegment: "M4.5 6l7 6-7 6zM11.5 6l7 6-7 6zM18.6 6h1.9v12h-1.9z",
  previousSegment: "M19.5 6l-7 6 7 6zM12.5 6l-7 6 7 6zM3.5 6h1.9v12H3.5z",
  stop: "M6.5 6.5h11v11h-11z",
  layers: "M12 3.5l9 5-9 5-9-5zM4.8 12L12 16l7.2-4 1.8 1-9 5-9-5z",
  theme: "M12 4a8 8 0 108 8 6.2 6.2 0 01-8-8z",
  back: "M14.8 5.2L8 12l6.8 6.8 1.4-1.4L10.8 12l5.4-5.4z",
  close: "M6.2 4.8L4.8 6.2 10.6 12l-5.8 5.8 1.4 1.4L12 13.4l5.8 5.8 1.4-1.4L13.4 12l5.8-5.8-1.4-1.4L12 10.6z",
  row: "M3 18h18v1.6H3zM5 16V9l3-3 3 3v7zM13 16V9l3-3 3 3v7z",
  robot: "M5 20v-3h3.2v-4.5l5-5.7A2.5 2.5 0 1116.9 9l-5.3 5v3H15v3z",
  eye: "M12 6C7 6 3.6 9.6 2 12c1.6 2.4 5 6 10 6s8.4-3.6 10-6c-1.6-2.4-5-6-10-6zm0 10a4 4 0 110-8 4 4 0 010 8zm0-2a2 2 0 100-4 2 2 0 000 4z",
};

export type IconName = keyof typeof kPaths;

export function icon(name: IconName): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", kPaths[name]);
  path.setAttribute("fill-rule", "evenodd");
  svg.append(path);
  return svg;
}
