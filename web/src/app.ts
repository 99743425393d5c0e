import { Connection, type ConnectionState, socketUrl } from "./connection.ts";
import type { Message } from "./data/messages.ts";
import { kProtocol } from "./data/protocol.ts";
import { Timeline } from "./data/timeline.ts";
import { listenToKeys } from "./keyboard.ts";
import { kLayers, Layers } from "./layers.ts";
import { type Actions, type Moment, momentAt, type Selection } from "./moment.ts";
import { Panels } from "./panels/panels.ts";
import { PictureStore } from "./pictures/picture_store.ts";
import { formatPlace, parsePlace, type Place, timeOfPlace } from "./place.ts";
import { Playback } from "./playback.ts";
import { openScene, type Scene } from "./scene/scene.ts";
import { Theme } from "./theme.ts";

/** Milliseconds between two updates of the panels while the run plays. */
const kPanelPause_ms = 100;

/** The same while what is there already comes in. */
const kLoadingPause_ms = 400;

/** The page: takes the messages, keeps the moment that is shown, and tells scene and panels. */
export class App implements Actions {
  readonly theme = new Theme();
  readonly layers = new Layers();
  readonly store = new PictureStore();
  readonly playback = new Playback(() => this.wake());
  timeline = new Timeline();
  selection: Selection = null;
  private readonly scene: Scene | null;
  private readonly panels: Panels;
  private connection: Connection;
  private connectionState: ConnectionState = { is: "connecting" };
  /** Nothing has come yet, over any connection. */
  private first = true;
  /** Where the link wants to go, until that has come. */
  private goal: Place | null = parsePlace(location.hash);
  private awake = false;
  private lastTick = 0;
  private panelsAt = 0;
  private shownStep = -1;
  private shownChanges = -1;
  private shownT = -1;

  constructor(root: HTMLElement) {
    // First: the run is on its way while the picture is made ready.
    this.connection = new Connection(socketUrl(location), {
      begins: () => this.begin(),
      frame: (message) => this.take(message),
      damaged: (why) => this.takeDamaged(why),
      ends: () => this.takeClose(),
      complete: () => this.timeline.complete,
      state: (state) => {
        this.connectionState = state;
        this.sayState();
        this.wake();
      },
    });
    this.panels = new Panels(root, this);
    this.scene = openScene(this.panels.sceneHolder, this);
    if (!this.scene) this.panels.sayNoScene();
    this.panels.camera.pair.onColor = (image, view) => this.scene?.setPicture(image, this.timeline.view(view));
    listenToKeys(this.keys());
    addEventListener("hashchange", () => {
      this.goal = parsePlace(location.hash);
      this.reachGoal();
    });
  }

  moment(): Moment {
    return momentAt(this.timeline, this.playback.t);
  }

  /** What a live page may send. */
  wire(): Connection {
    return this.connection;
  }

  get connected(): boolean {
    return this.connectionState.is === "open";
  }

  get live(): boolean {
    return this.timeline.reader.live && !this.timeline.complete;
  }

  seek(t: number): void {
    this.goal = null;
    this.playback.seek(t, this.timeline);
    this.writePlace();
  }

  selectView(number: number): void {
    this.goal = null;
    this.selection = { is: "view", view: number };
    const view = this.timeline.view(number);
    if (view && !this.playback.follow) this.playback.seek(view.t, this.timeline);
    this.scene?.choose(this.selection, view);
    this.writePlace();
    this.wake();
  }

  selectFruit(id: number): void {
    this.selection = { is: "fruit", id };
    this.scene?.choose(this.selection, null);
    this.wake();
  }

  clearSelection(): void {
    this.selection = null;
    this.scene?.choose(null, null);
    this.wake();
  }

  lookAtSelection(): void {
    if (this.selection?.is === "fruit") {
      const fruit = this.timeline.fruits.at(this.selection.id, this.moment().step);
      if (fruit) this.scene?.lookAt(fruit.centre);
    } else if (this.selection?.is === "view") {
      const T = this.timeline.view(this.selection.view)?.T_world_camera;
      if (T) this.scene?.lookAt([T[3], T[7], T[11]]);
    }
  }

  enlarge(view: number): void {
    this.panels.pictures.show(this.timeline, view);
  }

  stepView(by: 1 | -1): void {
    this.goal = null;
    this.playback.stepView(by, this.timeline);
    const view = this.timeline.viewAt(this.playback.t);
    if (this.selection?.is === "view" && view) this.selectView(view.view);
    this.writePlace();
  }

  stepSegment(by: 1 | -1): void {
    this.goal = null;
    this.playback.stepSegment(by, this.timeline);
    this.writePlace();
  }

  toggle(): void {
    this.goal = null;
    this.playback.toggle(this.timeline);
    // What the camera sees goes on with the run.
    if (this.playback.playing && this.selection?.is === "view") this.clearSelection();
    if (!this.playback.playing) this.writePlace();
  }

  goLive(): void {
    this.goal = null;
    this.playback.setFollow(this.timeline);
  }

  look(where: "robot" | "row" | "camera"): void {
    this.scene?.look(where, this.playback.t);
    this.wake();
  }

  /** Something changed: show it soon. */
  wake(): void {
    if (this.awake) return;
    this.awake = true;
    this.lastTick = performance.now();
    requestAnimationFrame((now) => this.tick(now));
  }

  /** A stream begins: the first one, or after a break that of the same run or another. */
  private begin(): void {
    // Back to where it was, as soon as that has come again.
    if (!this.first && !this.playback.follow && !this.hasGoal()) this.goal = { t: this.playback.t };
    this.timeline = new Timeline();
    this.store.begin(this.timeline);
    this.playback.restart();
    this.panels.pictures.close();
    this.scene?.load(this.timeline);
    this.shownChanges = this.shownStep = -1;
  }

  private take(message: Message | null): void {
    if (message?.type !== "reader" && message?.type !== "pace") ++this.timeline.taken;
    if (message) this.timeline.append(message);
    if (message?.type === "hello") {
      this.scene?.load(this.timeline);
      if (this.live && this.first && !this.hasGoal()) this.playback.follow = true;
      this.first = false;
    }
    if (message?.type === "view" && this.selection?.is === "view" && this.selection.view === message.view)
      this.scene?.choose(this.selection, this.timeline.view(message.view));
    this.afterFrame();
  }

  private afterFrame(): void {
    const { complete, duration, taken } = this.timeline;
    if (complete && this.playback.follow) this.playback.seek(duration, this.timeline);
    if (complete || taken % 50 === 1) this.sayState();
    this.playback.arrived(this.timeline);
    this.reachGoal();
    this.wake();
  }

  private takeDamaged(why: string): void {
    console.warn(why);
    ++this.timeline.taken;
    this.timeline.append({ type: "log", t: this.timeline.newest, level: "notice", text: `A message could not be read: ${why}`, word: "" });
    this.afterFrame();
  }

  private takeClose(): void {
    this.timeline.closed = true;
    this.afterFrame();
  }

  private hasGoal(): boolean {
    return this.goal?.t !== undefined || this.goal?.view !== undefined;
  }

  /** Goes where the link says, once that is there. */
  private reachGoal(): void {
    const goal = this.goal;
    if (!goal) return;
    const t = timeOfPlace(goal, this.timeline);
    if (t === null) return;
    this.goal = null;
    this.playback.seek(t, this.timeline);
    if (goal.view !== undefined) this.selectView(goal.view);
    if (goal.fruit !== undefined) this.selectFruit(goal.fruit);
  }

  private writePlace(): void {
    const { t } = this.playback;
    const view = this.timeline.viewAt(t);
    const at = view && Math.abs(view.t - t) < 1e-6 ? { view: view.view } : { t };
    const fruit = this.selection?.is === "fruit" ? this.selection.id : undefined;
    history.replaceState(null, "", formatPlace({ ...at, fruit }));
  }

  private tick(now: number): void {
    this.awake = false;
    const more = this.playback.advance(Math.min(0.5, Math.max(0, now - this.lastTick) / 1000), this.timeline);
    this.lastTick = now;
    const { t } = this.playback;
    const moment = this.moment();
    const { changes } = this.timeline;
    // While a run comes in, what is later than this moment changes nothing in its picture.
    const changed = this.loading ? moment.step !== this.shownStep : changes !== this.shownChanges;
    if (t !== this.shownT || changed) {
      this.scene?.show(moment);
      this.shownT = t;
      this.shownStep = moment.step;
      this.shownChanges = changes;
    }
    if (now - this.panelsAt >= (this.loading ? kLoadingPause_ms : more ? kPanelPause_ms : 0)) {
      this.panels.update(moment);
      this.panelsAt = now;
    }
    if (more && !this.awake) {
      this.awake = true;
      requestAnimationFrame((next) => this.tick(next));
    }
  }

  /** What was there before this page is still coming. */
  private get loading(): boolean {
    return this.timeline.arrived < 1 && !this.timeline.complete;
  }

  private sayState(): void {
    const { is } = this.connectionState;
    const { hello, reader, end, arrived } = this.timeline;
    if (this.connectionState.is === "mismatch") {
      const { theirs } = this.connectionState;
      this.panels.say("lost", `This page reads protocol ${kProtocol}, the program speaks ${theirs}. Reload the page; if that does not help, it comes from another version.`, "warning");
    } else if (end) {
      this.panels.say(end.interrupted ? "stopped early" : reader.live ? "done" : "replay", "");
    } else if (this.timeline.closed && arrived < 1) {
      this.panels.say("cut off", `This replay is damaged: only the first ${Math.floor(100 * arrived)} % can be read.`, "warning");
    } else if (this.timeline.complete) {
      this.panels.say("cut off", "This run was cut off: its replay has no end.");
    } else if (this.connectionState.is === "lost") {
      this.panels.say("lost", `No connection to Canopeer. Is it still running? Next try in ${this.connectionState.again_s} s.`, "warning");
    } else if (is === "connecting" || !hello) {
      this.panels.say("connecting", "Connecting …");
    } else {
      this.panels.say(reader.live ? "live" : "replay", arrived < 1 ? `Loading: ${Math.floor(100 * arrived)} %` : "");
    }
  }

  private keys(): Record<string, () => void> {
    const keys: Record<string, () => void> = {
      " ": () => this.toggle(),
      ArrowLeft: () => this.stepView(-1),
      ArrowRight: () => this.stepView(1),
      PageUp: () => this.stepSegment(-1),
      PageDown: () => this.stepSegment(1),
      Home: () => this.seek(0),
      End: () => this.seek(this.timeline.duration),
      "+": () => this.playback.changeSpeed(1),
      "=": () => this.playback.changeSpeed(1),
      "-": () => this.playback.changeSpeed(-1),
      l: () => this.live && this.goLive(),
      r: () => this.look("robot"),
      w: () => this.look("row"),
      c: () => this.look("camera"),
      f: () => this.lookAtSelection(),
      d: () => this.panels.camera.toggleOverlay(),
      t: () => this.theme.toggle(),
      "?": () => this.panels.help.toggle(),
      Escape: () => this.clearSelection(),
    };
    kLayers.slice(0, 10).forEach((layer, i) => (keys[String((i + 1) % 10)] = () => this.layers.toggle(layer.id)));
    return keys;
  }
}
