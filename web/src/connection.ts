import { FrameError } from "./data/fields.ts";
import type { Message } from "./data/messages.ts";
import { kProtocol, readFrame } from "./data/protocol.ts";

export type ConnectionState =
  | { is: "connecting" }
  | { is: "open" }
  | { is: "done" } // closed, and nothing more is to come
  | { is: "lost"; again_s: number }
  | { is: "mismatch"; theirs: number };

export interface ConnectionEvents {
  /** A stream begins, from its first message. */
  begins(): void;
  /** A frame came; null: of a type this page does not know. */
  frame(message: Message | null): void;
  state(state: ConnectionState): void;
  /** A frame that could not be read. */
  damaged(why: string): void;
  /** The server closed the stream: it has no more than what came. */
  ends(): void;
  /** Whether nothing more is to be expected. */
  complete(): boolean;
}

/** The WebSocket that brings a run; reconnects when it is lost. */
export class Connection {
  private socket: WebSocket | null = null;
  private attempts = 0;
  private finished = false;

  constructor(
    private readonly url: string,
    private readonly events: ConnectionEvents,
  ) {
    this.open();
  }

  /** Tells the mission what to do. */
  steer(word: "pause" | "go_on" | "next_segment" | "stop"): void {
    this.send({ type: "steer", word });
  }

  /** Mission seconds a second; 0: as fast as it goes. */
  setSpeed(factor: number): void {
    this.send({ type: "speed", factor });
  }

  private send(message: object): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  private open(): void {
    queueMicrotask(() => this.events.state({ is: "connecting" })); // whoever makes the connection is made first
    const socket = new WebSocket(this.url);
    this.socket = socket;
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.events.begins();
      this.events.state({ is: "open" });
    };
    socket.onmessage = ({ data }) => {
      if (data instanceof ArrayBuffer && !this.finished) this.take(new Uint8Array(data));
    };
    socket.onclose = (event) => {
      if (this.finished) return;
      if (isEnd(event)) this.events.ends();
      this.retry();
    };
  }

  private take(frame: Uint8Array): void {
    try {
      const message = readFrame(frame);
      this.attempts = 0;
      if (message?.type === "hello" && message.protocol !== kProtocol) {
        this.finished = true;
        this.events.state({ is: "mismatch", theirs: message.protocol });
        this.socket?.close();
        return;
      }
      this.events.frame(message);
    } catch (error) {
      if (!(error instanceof FrameError)) throw error;
      this.events.damaged(error.message);
    }
  }

  private retry(): void {
    if (this.events.complete()) {
      this.events.state({ is: "done" });
      return;
    }
    const again_s = Math.min(10, 1 + this.attempts++);
    this.events.state({ is: "lost", again_s });
    setTimeout(() => this.open(), 1000 * again_s);
  }
}

/** Whether a server closed because it is through, not because it broke or goes away. */
export function isEnd({ wasClean, code }: { wasClean: boolean; code: number }): boolean {
  const kNormal = 1000;
  const kNoCode = 1005;
  return wasClean && (code === kNormal || code === kNoCode);
}

/** The socket beside this page; the token in its address goes along. */
export function socketUrl(page: Location): string {
  return `${page.protocol === "https:" ? "wss" : "ws"}://${page.host}/socket${page.search}`;
}
