import type { App } from "../app.ts";
import type { Moment } from "../moment.ts";
import { el } from "../ui/dom.ts";
import { icon } from "../ui/icons.ts";
import { Tabs } from "../ui/tabs.ts";
import { CameraPanel } from "./camera_view.ts";
import { Controls } from "./controls.ts";
import { Detail } from "./detail.ts";
import { HelpDialog, PictureDialog } from "./dialogs.ts";
import { FruitList } from "./fruit_list.ts";
import { Header, type RunStatus } from "./header.ts";
import { LayerPanel } from "./layer_panel.ts";
import { LogPanel } from "./log.ts";
import { Notice } from "./notice.ts";
import { Plots } from "./plots.ts";
import { Transport } from "./transport.ts";
import { ViewList } from "./view_list.ts";
import { WorkPanel } from "./work.ts";

/** All of the page but the 3D picture, and where each part is. */
export class Panels {
  readonly sceneHolder: HTMLElement;
  readonly camera: CameraPanel;
  readonly help = new HelpDialog();
  readonly pictures: PictureDialog;
  private readonly header: Header;
  private readonly notice = new Notice();
  private readonly transport: Transport;
  private readonly controls: Controls;
  private readonly layerPanel: LayerPanel;
  private readonly detail: Detail;
  private readonly tabs: Tabs;
  private readonly pages: { update(moment: Moment): void }[];

  constructor(
    root: HTMLElement,
    private readonly app: App,
  ) {
    this.header = new Header({ theme: () => app.theme.toggle(), help: () => this.help.toggle() });
    this.camera = new CameraPanel(app.store, app);
    this.pictures = new PictureDialog(app.store);
    this.detail = new Detail(app.store, app);
    this.controls = new Controls(() => app.wire());
    this.transport = new Transport(
      app.playback,
      app.theme,
      {
        toggle: () => app.toggle(),
        view: (by) => app.stepView(by),
        segment: (by) => app.stepSegment(by),
        seek: (t) => app.seek(t),
        live: () => app.goLive(),
      },
      this.controls.element,
    );
    const plots = new Plots(app, app.theme);
    const work = new WorkPanel();
    const views = new ViewList(app);
    const fruits = new FruitList(app);
    const log = new LogPanel(app);
    this.pages = [plots, work, views, fruits, log];
    this.tabs = new Tabs(
      [
        { name: "Progress", element: el("div", { class: "progress", tabindex: 0 }, plots.element, work.element) },
        { name: "Views", element: views.element },
        { name: "Fruits", element: fruits.element },
        { name: "Log", element: log.element },
      ],
      () => app.wake(),
    );
    this.layerPanel = new LayerPanel(
      app.layers,
      () => app.timeline.hello?.simulated ?? true,
      () => app.timeline.looks.length > 0,
    );
    const look = (where: "robot" | "row" | "camera", name: string, key: string, picture: "robot" | "row" | "eye") =>
      el("button", { class: "round", label: name, title: `${name} (${key})`, on: { click: () => app.look(where) } }, icon(picture));
    this.sceneHolder = el(
      "main",
      { class: "scene", label: "The row in 3D" },
      this.layerPanel.element,
      el(
        "div",
        { class: "looks", role: "group", label: "Look at" },
        look("robot", "Where the robot is", "R", "robot"),
        look("row", "The whole row", "W", "row"),
        look("camera", "Over the camera’s shoulder", "C", "eye"),
      ),
      this.notice.element,
    );
    const side = el("aside", { class: "side", label: "What the robot sees and found" }, this.camera.element, this.tabs.element, this.detail.element);
    root.append(this.header.element, this.sceneHolder, side, this.transport.element, this.help.element, this.pictures.element);
  }

  say(status: RunStatus, sentence: string, level: "info" | "warning" = "info"): void {
    this.header.setStatus(status);
    this.notice.say(sentence, level);
  }

  sayNoScene(): void {
    this.sceneHolder.append(
      el("p", { class: "no-scene" }, "This browser shows no 3D pictures (WebGL 2 is off or missing). Everything else works."),
    );
  }

  update(moment: Moment): void {
    const { selection, live } = this.app;
    this.header.update(moment);
    this.camera.update(moment, selection);
    this.transport.update(moment, live);
    this.controls.update(moment, this.app.connected);
    this.layerPanel.update();
    this.tabs.element.hidden = selection !== null;
    for (const page of this.pages) page.update(moment);
    this.detail.update(moment, selection);
  }
}
