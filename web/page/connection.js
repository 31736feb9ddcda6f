// The WebSocket to the server: messages go out as TOML, answers come as JSON, or as JSON in front of bytes.

function valueInToml(value) {
  if (typeof value === "string") {
    return JSON.stringify(value.toWellFormed ? value.toWellFormed() : value).replaceAll("\u007f", "\\u007f");
  }
  if (Array.isArray(value)) return "[" + value.map(valueInToml).join(", ") + "]";
  // A whole number of so many digits would be none that TOML has.
  return Number.isInteger(value) && !Number.isSafeInteger(value) ? value.toExponential() : String(value);
}

/** A message as TOML; its tables come last. */
function inToml(message) {
  const isTable = value => typeof value === "object" && !Array.isArray(value);
  const rows = table => Object.entries(table).filter(([, value]) => !isTable(value))
    .map(([key, value]) => JSON.stringify(key) + " = " + valueInToml(value) + "\n").join("");
  return rows(message) + Object.entries(message).filter(([, value]) => isTable(value))
    .map(([name, table]) => `[${name}]\n${rows(table)}`).join("");
}

/** Takes an answer apart: what it says, and its bytes, if it has any. */
function readAnswer(data) {
  if (typeof data === "string") return JSON.parse(data);
  const length = new DataView(data).getUint32(0, true);
  const answer = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
  answer.bytes = new Uint8Array(data, 4 + length);
  return answer;
}

/** Of a message, in bytes; the server closes the connection where one is longer. */
const longestMessage = 64 * 1024;
const shortestPauseMs = 100, longestPauseMs = 4000;

/** A connection that is opened again, for as long as the page is there. */
export class Connection {
  /**
   * `onAnswer`: gets what no request waits for. `onState`: gets "open", or why it is not: "dropped" (it is opened
   * again), "full" (the server shows as many pages as it can), "other" (what answers is another server), or "gone"
   * (nothing answers).
   */
  constructor(onAnswer, onState) {
    Object.assign(this, {onAnswer, onState});
    this.waiting = new Map();
    this.lastNumber = 0;
    this.pauseMs = shortestPauseMs;
    this.open();
  }

  open() {
    let wasOpen = false;
    this.socket = new WebSocket(`ws://${location.host}${location.pathname}socket`);
    this.socket.binaryType = "arraybuffer";
    this.socket.onopen = () => {
      wasOpen = true;
      this.onState("open");
    };
    this.socket.onmessage = event => this.take(readAnswer(event.data));
    this.socket.onclose = () => this.closed(wasOpen);
  }

  take(answer) {
    const resolve = this.waiting.get(answer.number);
    this.waiting.delete(answer.number);
    if (resolve) return resolve(answer);
    // What is drawn stands for a server that is well; a greeting comes of one that closes each connection, too.
    if (answer.kind === "frame") this.pauseMs = shortestPauseMs;
    this.onAnswer(answer);
  }

  async closed(wasOpen) {
    for (const resolve of this.waiting.values()) resolve({kind: "error", message: "burin view does not answer"});
    this.waiting.clear();
    const answers = await this.whoAnswers();
    this.onState(answers !== "server" ? answers : wasOpen ? "dropped" : "full");
    setTimeout(() => this.open(), this.pauseMs);
    this.pauseMs = Math.min(longestPauseMs, 2 * this.pauseMs);
  }

  /** "server": the one of this page; "other"; "gone": none. */
  async whoAnswers() {
    try {
      return (await fetch(location.pathname, {cache: "no-store"})).ok ? "server" : "other";
    } catch {
      return "gone";
    }
  }

  get isOpen() {
    return this.socket.readyState === WebSocket.OPEN;
  }

  /** Sends a message and returns its number, which the answer has. */
  send(message) {
    const number = ++this.lastNumber;
    if (!this.isOpen) return number;
    const text = inToml({...message, number});
    if (new Blob([text]).size <= longestMessage) this.socket.send(text);
    else setTimeout(() => this.take({kind: "error", number, message: "this look is too long; name the file of its sheet by --style"}));
    return number;
  }

  /** Sends a message; the promise has its answer, which may be of the kind "error". */
  request(message) {
    return new Promise(resolve => {
      if (!this.isOpen) return resolve({kind: "error", message: "burin view does not answer"});
      this.waiting.set(this.send(message), resolve);
    });
  }
}
