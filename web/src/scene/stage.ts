import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

/** Something that wants a say before each frame; true: it needs another one. */
export type BeforeFrame = (now: number) => boolean;

/** Below this many frames a second, moving pictures are drawn coarser. */
const kGoodFrame_ms = 60;

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
  private readonly before: BeforeFrame[] = [];
  private asked = false;
  private scale = 1;
  private shownScale = 0;
  private settle = 0;
  private lastFrame = 0;
  private fly: { from: View3; to: View3; begin: number } | null = null;

  /** Throws where there is no WebGL. */
  constructor(private readonly holder: HTMLElement) {
    THREE.ColorManagement.enabled = true;
    const canvas = document.createElement("canvas");
    const context = canvas.getContext("webgl2", { antialias: true, powerPreference: "high-performance" });
    if (!context) throw new Error("no WebGL 2");
    this.slow = isSoftware(context);
    this.renderer = new THREE.WebGLRenderer({ canvas, context });
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

  /** Something changed: draw soon. */
  ask(): void {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame((now) => this.draw(now));
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
    let more = this.advanceFlight(now);
    if (this.controls.update()) more = true;
    for (const call of this.before) if (call(now)) more = true;
    const gap = now - this.lastFrame;
    this.lastFrame = now;
    if (gap < 1000) {
      // Frames in a row: the time between two is what one took.
      this.frame_ms += 0.15 * (gap - this.frame_ms);
      if (this.frame_ms > kGoodFrame_ms && this.scale > 0.5) this.scale = Math.max(0.5, this.scale - 0.1);
      else if (this.frame_ms < 0.4 * kGoodFrame_ms && this.scale < 1) this.scale += 0.05;
    }
    this.applyScale(Math.min(1, this.scale));
    this.render();
    clearTimeout(this.settle);
    if (more) this.ask();
    else if (this.scale < 1) this.settle = window.setTimeout(() => this.drawFinely(), 250);
  }

  private drawFinely(): void {
    if (this.asked) return;
    this.applyScale(1);
    this.render();
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

function isSoftware(context: WebGL2RenderingContext): boolean {
  const info = context.getExtension("WEBGL_debug_renderer_info");
  const name = info ? String(context.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
  return /swiftshader|llvmpipe|software|softpipe/i.test(name);
}
