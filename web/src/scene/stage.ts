import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

/** Something that wants a say before each frame; true: it needs another one. */
export type BeforeFrame = (now: number) => boolean;

/** Where frames take longer than this, moving pictures are drawn coarser. */
const kGoodFrame_ms = 60;

/** Never coarser than this share of the pixels a side. */
const kCoarsest = 0.5;

/** So long an empty picture waits for robot and plants: drawing it would keep them waiting. */
const kEmpty_ms = 2000;

/** Pixels of the largest cells of the map that are drawn for voxels. */
const kLargestCell = 3;

/**
 * Canvas, camera and lights. Draws only when something changed; on slow machines it draws coarser
 * while things move, and finely once they stand still.
 */
export class Stage {
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(42, 1, 0.05, 400);
  readonly renderer: THREE.WebGLRenderer;
  readonly controls: OrbitControls;
  /** A software renderer: fewer triangles, please. */
  readonly slow: boolean;
  /** Milliseconds a frame took, smoothed. */
  frame_ms = 16;
  frames = 0;
  /** Nothing moves: the frame that is drawn may take its time. */
  fine = false;
  /** Whoever looks has time: every frame is a fine one. */
  patient = false;
  private readonly before: BeforeFrame[] = [];
  private asked = false;
  private emptyUntil = performance.now() + kEmpty_ms;
  private scale = 1;
  private coarseness = 0;
  private shownScale = 0;
  private settle = 0;
  private lastFrame = 0;
  private inRow = false;
  private fly: { from: View3; to: View3; begin: number } | null = null;

  /** Throws where there is no WebGL. */
  constructor(private readonly holder: HTMLElement) {
    THREE.ColorManagement.enabled = true;
    const plain = openContext(false);
    this.slow = isSoftware(plain);
    if (this.slow) [this.coarseness, this.scale] = [kLargestCell, kCoarsest];
    else plain.getExtension("WEBGL_lose_context")?.loseContext();
    const context = this.slow ? plain : openContext(true);
    const canvas = context.canvas as HTMLCanvasElement;
    this.renderer = new THREE.WebGLRenderer({ canvas, context });
    this.renderer.debug.checkShaderErrors = false; // the check waits for every shader
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    holder.prepend(canvas);

    this.camera.up.set(0, 0, 1);
    this.camera.position.set(4, -4, 3);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = !this.slow;
    this.controls.dampingFactor = 0.12;
    this.controls.maxPolarAngle = 0.52 * Math.PI;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.ask());
    this.controls.addEventListener("start", () => (this.fly = null));

    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x99a39c, 1.9));
    const sun = new THREE.DirectionalLight(0xffffff, 1.7);
    sun.position.set(-2, -3, 6);
    this.scene.add(sun);

    new ResizeObserver(() => this.resize()).observe(holder);
    this.resize();
  }

  get canvas(): HTMLCanvasElement {
    return this.renderer.domElement;
  }

  /** Called before each frame. */
  beforeFrame(call: BeforeFrame): void {
    this.before.push(call);
  }

  /** Voxels smaller than so many pixels may be drawn as larger cells. */
  get cellPixels(): number {
    return this.fine ? 0.8 : 0.8 + this.coarseness;
  }

  /** This frame should be quick rather than fine. */
  get coarse(): boolean {
    return !this.fine && this.coarseness > 0;
  }

  /** Something changed: draw soon. */
  ask(): void {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame((now) => this.draw(now));
  }

  /** There is something to see now. */
  furnish(): void {
    this.emptyUntil = 0;
    this.ask();
  }

  setBackground(color: string): void {
    this.scene.background = new THREE.Color(color);
    this.ask();
  }

  /** Moves the camera there, gently. */
  flyTo(position: THREE.Vector3, target: THREE.Vector3): void {
    const to = { position, target };
    if (matchMedia("(prefers-reduced-motion: reduce)").matches || this.slow) {
      this.put(to);
    } else {
      const from = { position: this.camera.position.clone(), target: this.controls.target.clone() };
      this.fly = { from, to, begin: performance.now() };
    }
    this.ask();
  }

  /** Pixels of the canvas' box → a point of the world → and back. */
  toScreen(point: THREE.Vector3): { x: number; y: number; depth: number } {
    const p = point.clone().project(this.camera);
    const { clientWidth: w, clientHeight: h } = this.holder;
    return { x: ((p.x + 1) / 2) * w, y: ((1 - p.y) / 2) * h, depth: p.z };
  }

  /** Pixels a metre has at this distance. */
  pixelsPerMetre(distance: number): number {
    const h = this.holder.clientHeight;
    return h / (2 * Math.tan((this.camera.fov * Math.PI) / 360) * Math.max(distance, 0.05));
  }

  private put({ position, target }: View3): void {
    this.camera.position.copy(position);
    this.controls.target.copy(target);
    this.controls.update();
  }

  private resize(): void {
    const { clientWidth: w, clientHeight: h } = this.holder;
    if (w === 0 || h === 0) return;
    this.camera.aspect = w / h;
    this.camera.updateProjectionMatrix();
    this.shownScale = 0;
    this.ask();
  }

  private applyScale(scale: number): void {
    if (scale === this.shownScale) return;
    this.shownScale = scale;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2) * scale);
    this.renderer.setSize(this.holder.clientWidth, this.holder.clientHeight, true);
  }

  private draw(now: number): void {
    this.asked = false;
    if (now < this.emptyUntil) return void setTimeout(() => this.ask(), 50);
    this.fine = this.patient;
    let more = this.advanceFlight(now);
    if (this.controls.update()) more = true;
    for (const call of this.before) if (call(now)) more = true;
    this.adapt(now);
    this.applyScale(this.fine ? 1 : this.scale);
    this.render();
    this.inRow = more;
    clearTimeout(this.settle);
    if (more) this.ask();
    else if (!this.fine && (this.scale < 1 || this.coarseness > 0)) this.settle = window.setTimeout(() => this.drawFinely(), 250);
  }

  /** Frames in a row: the time between two is what one took. */
  private adapt(now: number): void {
    const gap = now - this.lastFrame;
    this.lastFrame = now;
    if (gap > 250 && !this.inRow) return;
    this.frame_ms += 0.2 * (Math.min(gap, 2000) - this.frame_ms);
    const step = this.frame_ms > kGoodFrame_ms ? 1 : this.frame_ms < 0.4 * kGoodFrame_ms ? -0.5 : 0;
    this.scale = Math.min(1, Math.max(kCoarsest, this.scale - 0.1 * step));
    this.coarseness = Math.min(kLargestCell, Math.max(0, this.coarseness + 0.5 * step));
  }

  private drawFinely(): void {
    if (!this.asked) this.drawNow();
  }

  /** Draws at once, as finely as it can. */
  drawNow(): void {
    this.fine = true;
    this.applyScale(1);
    for (const call of this.before) call(performance.now());
    this.render();
    this.fine = this.patient;
    this.lastFrame = 0;
  }

  private render(): void {
    ++this.frames;
    this.renderer.render(this.scene, this.camera);
  }

  private advanceFlight(now: number): boolean {
    if (!this.fly) return false;
    const { from, to, begin } = this.fly;
    const share = Math.min(1, Math.max(0, (now - begin) / 500));
    const eased = share * share * (3 - 2 * share);
    this.camera.position.lerpVectors(from.position, to.position, eased);
    this.controls.target.lerpVectors(from.target, to.target, eased);
    if (share >= 1) this.fly = null;
    return this.fly !== null;
  }
}

interface View3 {
  position: THREE.Vector3;
  target: THREE.Vector3;
}

function openContext(antialias: boolean): WebGL2RenderingContext {
  const context = document.createElement("canvas").getContext("webgl2", {
    alpha: false,
    stencil: false,
    antialias,
    powerPreference: "high-performance",
  });
  if (!context) throw new Error("no WebGL 2");
  return context;
}

/** Whether the processor draws, not a graphics card. */
function isSoftware(context: WebGL2RenderingContext): boolean {
  const info = context.getExtension("WEBGL_debug_renderer_info");
  const name = info ? String(context.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
  return /swiftshader|llvmpipe|software|softpipe/i.test(name);
}
