// The connection to the server: requests, and the WebSocket on which values, events and answers come.

import { Frame, decode } from "./frames";

export type Message = { type: string; [key: string]: any };

export interface Listener {
  greeted(hello: Message): void;
  said(message: Message): void;
  rows(frame: Frame): void;
  /// empty: the connection stands
  lost(reason: string): void;
  tokenAsked(): void;
}

/// What the server refuses, in its words.
export class Refusal extends Error {
  constructor(readonly code: string, message: string) { super(message); }
}

export class RequestError extends Error {
  /// @param errors all that is wrong, as the server tells it
  constructor(readonly status: number, message: string, readonly errors: any[] = []) { super(message); }
}

const kToken = "lockstep-token";  // of this tab only

/// The token that the address gives, taken off the address bar.
function takeToken(): string {
  const given = /^#token=(.+)$/.exec(location.hash);
  if (given) {
    sessionStorage.setItem(kToken, decodeURIComponent(given[1]));
    history.replaceState(null, "", location.pathname + location.search);
  }
  return sessionStorage.getItem(kToken) ?? "";
}

export class Link {
  hasMore = false;  // more than what may be looked at: writes, commands, the project's text
  private socket: WebSocket | null = null;
  private token = takeToken();
  private seq = 0;
  private frame = 0;  // the newest that has come
  private answered = 0;
  private answers = new Map<number, { done: (message: Message) => void; failed: (error: Error) => void }>();

  constructor(private readonly listener: Listener) {}

  connect(): void {
    const address = new URL("ws", document.baseURI);
    address.protocol = address.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(address, "lockstep.1");
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.frame = this.answered = 0;
      this.ask({ type: "hello", token: this.token }).then(
        (hello) => { this.listener.lost(""); this.listener.greeted(hello); },
        (error) => { if (error instanceof Refusal) this.listener.tokenAsked(); });
    };
    socket.onmessage = (event) => this.take(event.data);
    socket.onclose = () => this.closed();
    this.socket = socket;
  }

  setToken(token: string): void {
    this.token = token;
    sessionStorage.setItem(kToken, token);
    this.socket?.close();
  }

  /// Sends a message and waits for its answer.
  ask(message: Message): Promise<Message> {
    const seq = ++this.seq;
    return new Promise((done, failed) => {
      if (this.socket?.readyState !== WebSocket.OPEN) return failed(new Error("there is no connection"));
      this.answers.set(seq, { done, failed });
      this.socket.send(JSON.stringify({ ...message, seq }));
    });
  }

  /// What has come is drawn, so that more may come. Called with each picture.
  drawn(): void {
    if (this.frame === this.answered || this.socket?.readyState !== WebSocket.OPEN) return;
    this.answered = this.frame;
    this.socket.send(JSON.stringify({ type: "ack", frame: this.frame }));
  }

  /// An answer of HTTP; throws RequestError with the text of the server.
  get(path: string): Promise<Response> { return this.request(path, {}); }

  private async request(path: string, options: RequestInit): Promise<Response> {
    const headers: Record<string, string> = this.token ? { Authorization: "Bearer " + this.token } : {};
    if (typeof options.body === "string") headers["Content-Type"] = "application/json";
    const response = await fetch(path, { ...options, headers: { ...headers, ...(options.headers as Record<string, string>) } });
    if (response.ok) return response;
    const body = await response.json().catch(() => null);
    throw new RequestError(response.status, body?.error?.message ?? response.statusText, body?.errors ?? []);
  }

  /// What an older server does not have is not asked of it, and told as it would tell it.
  async optional(path: string): Promise<Response> {
    if (!this.hasMore) throw new RequestError(404, "this studio does not tell that");
    return this.get(path);
  }

  async json(path: string): Promise<any> { return (await this.get(path)).json(); }

  async post(path: string, body: unknown): Promise<any> {
    return (await this.request(path, { method: "POST", body: JSON.stringify(body) })).json();
  }

  /// A file as it is.
  async send(path: string, body: Blob, type: string): Promise<any> {
    return (await this.request(path, { method: "POST", body, headers: { "Content-Type": type } })).json();
  }

  /// A file as a whole, in place of the one with this ETag; "": of none.
  async put(path: string, text: string, etag: string): Promise<void> {
    await this.request(path, { method: "PUT", body: text, headers: etag ? { "If-Match": etag } : { "If-None-Match": "*" } });
  }

  async remove(path: string): Promise<void> { await this.request(path, { method: "DELETE" }); }

  /// Closes the connection, which opens another that says hello anew.
  again(): void { this.socket?.close(); }

  get isOpen(): boolean { return this.socket?.readyState === WebSocket.OPEN; }

  private take(data: string | ArrayBuffer): void {
    if (typeof data !== "string") {
      const frame = decode(data);
      this.frame = frame.number;
      return this.listener.rows(frame);
    }
    const message: Message = JSON.parse(data);
    const waiting = this.answers.get(message.seq);
    if (!waiting) return this.listener.said(message);
    this.answers.delete(message.seq);
    if (message.type === "error") waiting.failed(new Refusal(message.error.code, message.error.message));
    else waiting.done(message);
  }

  private closed(): void {
    for (const { failed } of this.answers.values()) failed(new Error("the connection has ended"));
    this.answers.clear();
    this.listener.lost("no connection; trying again");
    setTimeout(() => this.connect(), 1000);
  }
}
