import * as THREE from "three";
import type { GraphNode } from "../data/messages.ts";
import { edgeEnds, type Timeline } from "../data/timeline.ts";
import { kindColor, type Palette } from "../theme.ts";

/** How far the tick that shows a view's direction reaches. */
const kTick_m = 0.045;

/** The graph of views: nodes by what they look for, rings once visited, and the motions between. */
export class GraphLines {
  readonly group = new THREE.Group();
  nodes: GraphNode[] = [];
  private readonly edges = new THREE.LineSegments(
    new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({ transparent: true, opacity: 0.13, depthWrite: false }),
  );
  private readonly ticks = new THREE.LineSegments(
    new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({ vertexColors: true }),
  );
  private readonly dots: THREE.Points;
  private readonly dotMaterial: THREE.ShaderMaterial;
  private palette: Palette | null = null;
  private shownAs = "";
  private last: (() => void) | null = null;

  constructor() {
    this.dotMaterial = new THREE.ShaderMaterial({
      uniforms: { pixels: { value: 500 }, ratio: { value: 1 } },
      vertexShader: /* glsl */ `
attribute vec3 tint;
attribute float visited;
uniform float pixels, ratio;
varying vec3 vTint;
varying float vVisited;
void main() {
  vTint = tint;
  vVisited = visited;
  vec4 eye = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * eye;
  gl_PointSize = clamp(0.016 * pixels / -eye.z, 3.0 * ratio, 13.0 * ratio);
}`,
      fragmentShader: /* glsl */ `
varying vec3 vTint;
varying float vVisited;
void main() {
  float r = length(gl_PointCoord - 0.5);
  if (r > 0.5 || (vVisited > 0.5 && r < 0.28)) discard;
  gl_FragColor = vec4(vTint, 1.0);
  #include <colorspace_fragment>
}`,
    });
    this.dots = new THREE.Points(new THREE.BufferGeometry(), this.dotMaterial);
    for (const part of [this.edges, this.ticks, this.dots]) part.frustumCulled = false;
    this.group.add(this.edges, this.ticks, this.dots);
  }

  show(timeline: Timeline, step: number): void {
    const as = [timeline.nodes, timeline.edges, timeline.visited].map((h) => h.lastChange(step)).join();
    if (as === this.shownAs) return;
    this.shownAs = as;
    this.last = () => this.make(timeline, step);
    this.last();
  }

  paint(palette: Palette): void {
    this.palette = palette;
    this.edges.material.color.set(palette.ink);
    this.last?.();
  }

  /** Pixels a metre has at distance one, and those of the canvas per pixel of the page. */
  setPixels(pixels: number, ratio: number): void {
    this.dotMaterial.uniforms.pixels.value = pixels;
    this.dotMaterial.uniforms.ratio.value = ratio;
  }

  reset(): void {
    this.shownAs = "";
    this.nodes = [];
    this.last = null;
    for (const part of [this.edges, this.ticks, this.dots]) fill(part, {});
  }

  private make(timeline: Timeline, step: number): void {
    const palette = this.palette;
    if (!palette) return;
    const byId = new Map(timeline.nodes.entriesAt(step));
    this.nodes = [...byId.values()];
    const dots: number[] = [];
    const tints: number[] = [];
    const visited: number[] = [];
    const ticks: number[] = [];
    const tickTints: number[] = [];
    for (const node of this.nodes) {
      const tint = new THREE.Color(kindColor(palette, node.kind)).toArray() as number[];
      dots.push(...node.position);
      tints.push(...tint);
      visited.push(timeline.visited.at(node.id, step) ? 1 : 0);
      ticks.push(...node.position, ...node.position.map((x, i) => x + kTick_m * node.direction[i]));
      tickTints.push(...tint, ...tint);
    }
    const lines: number[] = [];
    for (const [key] of timeline.edges.entriesAt(step)) {
      const [a, b] = edgeEnds(key).map((id) => byId.get(id));
      if (a && b) lines.push(...a.position, ...b.position);
    }
    fill(this.dots, { position: [dots, 3], tint: [tints, 3], visited: [visited, 1] });
    fill(this.ticks, { position: [ticks, 3], color: [tickTints, 3] });
    fill(this.edges, { position: [lines, 3] });
  }
}

function fill(
  object: THREE.Points | THREE.LineSegments,
  attributes: Record<string, [number[], number]>,
): void {
  object.geometry.dispose();
  object.geometry = new THREE.BufferGeometry();
  for (const [name, [values, each]] of Object.entries(attributes))
    object.geometry.setAttribute(name, new THREE.Float32BufferAttribute(values, each));
}
