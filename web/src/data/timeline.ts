import { BlockHistory } from "./block_history.ts";
import { History } from "./history.ts";
import { Tracks } from "./tracks.ts";
import { upperBound } from "./search.ts";
import type {
  Camera,
  End,
  Fruit,
  FruitPoints,
  Fruits,
  GraphNode,
  Hello,
  Log,
  Look,
  Message,
  Picture,
  Plan,
  Reader,
  Robot,
  Segment,
  Truth,
  View,
  WorkEntry,
} from "./messages.ts";

/** A thing that was said or happened, for the log. */
export interface Event {
  t: number;
  level: "info" | "notice" | "fault" | "segment";
  text: string;
}

export interface Pictures {
  color?: Picture;
  depth?: Picture;
  fruit?: Picture;
}

interface Stepped<T> {
  step: number;
  value: T;
}

const kIds = 2 ** 26;

/** An edge as one number, the same both ways. */
export function edgeKey(a: number, b: number): number {
  return a < b ? a * kIds + b : b * kIds + a;
}

export function edgeEnds(key: number): [number, number] {
  return [Math.floor(key / kIds), key % kIds];
}

/**
 * A run as far as it is known. Messages are appended in order; each is a step, and each step has a
 * time. What the run was like after any step can be asked at once.
 */
export class Timeline {
  reader: Reader = { type: "reader", live: false, controls: false, frames: 0 };
  hello: Hello | null = null;
  robot: Robot | null = null;
  truth: Truth | null = null;
  end: End | null = null;
  readonly segments: Segment[] = [];
  readonly views: View[] = [];
  readonly viewTimes: number[] = [];
  /** Frames on the way. */
  readonly looks: Look[] = [];
  readonly lookTimes: number[] = [];
  readonly pictures = new Map<number, Pictures>();
  readonly events: Event[] = [];
  readonly eventTimes: number[] = [];
  readonly tracks = new Tracks();
  readonly map = new BlockHistory();
  readonly targets = new BlockHistory();
  readonly fruits = new History<Fruit>();
  /** Points of their surfaces, as of the ends of segments. */
  readonly surfaces = new History<FruitPoints>();
  /** The mission holds: somebody told it to. */
  holds = false;
  /** How fast simulated time goes; 0: as fast as it can. */
  pace = 0;
  /** Fruits that each view found or changed. */
  readonly fruitsOfView = new Map<number, Fruit[]>();
  readonly nodes = new History<GraphNode>();
  readonly edges = new History<true>();
  readonly visited = new History<true>();
  /** Frames that came, those that could not be read too. */
  taken = 0;
  /** The server said that nothing more comes, whatever was announced. */
  closed = false;
  /** Grows with everything that is appended. */
  changes = 0;
  private readonly times: number[] = [];
  private readonly plans: Stepped<Plan>[] = [];
  private readonly works: Stepped<WorkEntry[]>[] = [];

  /** The time of the newest message. */
  get newest(): number {
    return this.times.at(-1) ?? 0;
  }

  /** The share of what is there already that has come, 0 … 1. */
  get arrived(): number {
    return this.reader.frames > 0 ? Math.min(1, this.taken / this.reader.frames) : 1;
  }

  /** Nothing more is to come. */
  get complete(): boolean {
    const all = this.hello !== null && !this.reader.live && this.arrived === 1;
    return this.end !== null || this.closed || all;
  }

  /** How far the run can be played. */
  get duration(): number {
    const motion = this.tracks.motions.at(-1);
    return this.end ? Math.max(this.end.t, this.newest) : Math.max(this.newest, motion?.end ?? 0);
  }

  /** The last step up to a time; −1: none yet. What happens at that very time has happened. */
  stepAt(t: number): number {
    return upperBound(this.times, t) - 1;
  }

  /** The newest view at a time. */
  viewAt(t: number): View | null {
    return this.views[upperBound(this.viewTimes, t) - 1] ?? null;
  }

  /** How many frames on the way there were by then. */
  looksBy(t: number): number {
    return upperBound(this.lookTimes, t);
  }

  /** How many fruits were known after each frame, at a view or on the way, by time. */
  fruitCourse(): { t: number; fruits: number }[] {
    return [...this.views, ...this.looks].map(({ t, fruits }) => ({ t, fruits })).sort((a, b) => a.t - b.t);
  }

  /** Points of a fruit's surface: the last ones told by then, else the first that come later. */
  surfaceOf(fruit: number, step: number): FruitPoints | null {
    return this.surfaces.at(fruit, step) ?? this.surfaces.first(fruit) ?? null;
  }

  view(number: number): View | null {
    const guess = this.views[number];
    if (guess?.view === number) return guess;
    return this.views.find((v) => v.view === number) ?? null;
  }

  /** What a view was taken with. */
  cameraOf(view: View | null): Camera | null {
    return view?.camera ?? this.robot?.camera ?? null;
  }

  segmentAt(t: number): Segment | null {
    return this.segments.findLast((s) => s.t <= t) ?? null;
  }

  planAt(step: number): Plan | null {
    return lastUpTo(this.plans, step);
  }

  workAt(step: number): WorkEntry[] {
    return lastUpTo(this.works, step) ?? [];
  }

  append(message: Message): void {
    if (message.type === "reader") {
      this.reader = message;
      return;
    }
    if (message.type === "pace") {
      this.pace = message.factor;
      ++this.changes;
      return;
    }
    const said = "t" in message ? message.t : this.newest;
    // Time does not run backwards, whatever a message says.
    const t = Math.max(this.newest, said);
    const step = this.times.push(t) - 1;
    ++this.changes;
    switch (message.type) {
      case "hello":
        this.hello = message;
        break;
      case "robot":
        this.robot = message;
        break;
      case "truth":
        this.truth = message;
        break;
      case "segment":
        this.segments.push(message);
        this.tracks.addSegment(message);
        this.tell(t, "segment", `Segment ${message.segment + 1}: ${message.name}`);
        break;
      case "trolley":
        this.tracks.addTrolley(message);
        this.tell(t, "info", `The trolley drives to ${message.travel.toFixed(2)} m, the lift to ${message.lift.toFixed(2)} m.`);
        break;
      case "view":
        this.addView(t, message);
        break;
      case "look":
        this.looks.push(message);
        this.lookTimes.push(t);
        break;
      case "picture":
        this.addPicture(message);
        break;
      case "map":
        this.map.add(step, message.blocks);
        break;
      case "targets":
        this.targets.add(step, message.blocks);
        break;
      case "plan":
        this.addPlan(step, message);
        break;
      case "motion":
        this.tracks.addMotion(message);
        break;
      case "motion_end":
        this.tracks.endMotion(message.t);
        if (message.ended !== "arrived")
          this.tell(t, "fault", `A motion ended early (${message.ended}): ${message.why}`);
        if (message.collision) this.tell(t, "fault", "A motion hit something.");
        if (message.plantContact) this.tell(t, "notice", "A motion touched a plant.");
        break;
      case "fruits":
        this.addFruits(step, t, message);
        break;
      case "surface":
        for (const fruit of message.fruits) this.surfaces.set(step, fruit.id, fruit);
        break;
      case "log":
        if (message.word !== "") this.holds = message.word === "pause" || message.word === "wait_for_person";
        this.tell(t, level(message), message.text);
        break;
      case "work":
        this.works.push({ step, value: message.work });
        break;
      case "end":
        this.end = message;
        this.tell(t, "info", message.interrupted ? "The run was interrupted." : "The run is done.");
        break;
      case "lost":
        this.tell(t, "notice", `${message.frames} messages were left out: the connection is slow.`);
        break;
    }
  }

  private tell(t: number, level: Event["level"], text: string): void {
    this.events.push({ t, level, text });
    this.eventTimes.push(t);
  }

  private addView(t: number, message: View): void {
    const camera = message.camera ?? this.views.at(-1)?.camera ?? null;
    this.views.push(camera === message.camera ? message : { ...message, camera });
    this.viewTimes.push(t);
    this.tracks.addView(message);
  }

  /**
   * A view may have more than one message: frames on the way after it change fruits, and the mission
   * ends with what all frames make of a fruit.
   */
  private addFruits(step: number, t: number, { view, changed, gone }: Fruits): void {
    const onTheWay = (this.lookTimes.at(-1) ?? -1) > (this.viewTimes.at(-1) ?? -1);
    const found = onTheWay ? `found on the way from view ${view}` : `found in view ${view}`;
    for (const fruit of changed) {
      if (!this.fruits.last(fruit.id)) this.tell(t, "info", `Fruit ${fruit.id} ${found}.`);
      this.fruits.set(step, fruit.id, fruit);
    }
    for (const id of gone) {
      this.tell(t, "info", `Fruit ${id} is none, or part of another.`);
      this.fruits.set(step, id, undefined);
    }
    if (onTheWay) return;
    const again = new Set(changed.map((f) => f.id));
    const others = (this.fruitsOfView.get(view) ?? []).filter((f) => !again.has(f.id));
    this.fruitsOfView.set(view, [...others, ...changed]);
  }

  private addPicture(picture: Picture): void {
    let of = this.pictures.get(picture.view);
    if (!of) this.pictures.set(picture.view, (of = {}));
    if (picture.what === "color" || picture.what === "depth" || picture.what === "fruit")
      of[picture.what] = picture;
  }

  private addPlan(step: number, plan: Plan): void {
    if (plan.fresh) for (const all of [this.nodes, this.edges, this.visited]) all.clear(step);
    for (const id of plan.goneNodes)
      for (const of of [this.nodes, this.visited]) of.set(step, id, undefined);
    for (const node of plan.nodes) this.nodes.set(step, node.id, node);
    forPairs(plan.goneEdges, (a, b) => this.edges.set(step, edgeKey(a, b), undefined));
    forPairs(plan.edges, (a, b) => this.edges.set(step, edgeKey(a, b), true));
    for (const id of plan.visited)
      if (this.visited.last(id) !== true) this.visited.set(step, id, true);
    // What the histories hold need not be kept twice.
    const none = new Int32Array(0);
    this.plans.push({ step, value: { ...plan, nodes: [], edges: none, goneEdges: none, goneNodes: none } });
  }
}

function level(log: Log): Event["level"] {
  return log.level === "notice" || log.level === "fault" ? log.level : "info";
}

function lastUpTo<T>(list: Stepped<T>[], step: number): T | null {
  return list.findLast((entry) => entry.step <= step)?.value ?? null;
}

function forPairs(pairs: Int32Array, apply: (a: number, b: number) => void): void {
  for (let i = 0; i + 1 < pairs.length; i += 2) apply(pairs[i], pairs[i + 1]);
}
