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
/** A server that says nothing for so long is asked whether it is there; it has answerMs for that, and to connect. */
const quietMs = 2500, answerMs = 3000;
/** What takes longer than this is worth a word. */
const longWorkMs = 4000;

/** A connection that is opened again, for as long as the page is there. */
export class Connection {
  /**
   * `onAnswer`: gets what no request waits for. `onState`: gets "open", or why it is not: "dropped" (it is opened
   * again), "full" (the server shows as many pages as it can), "other" (what answers is another server), "gone"
   * (nothing is there), or "silent" (something is, and does not answer). "busy": it is open, and an answer is long due.
   */
  constructor(onAnswer, onState) {
    Object.assign(this, {onAnswer, onState});
    this.waiting = new Map();
    this.lastNumber = 0;
    this.pauseMs = shortestPauseMs;
    this.heardAt = 0;       // when there was a sign of the server last
    this.waitsSince = null;  // when what is not answered yet was sent
    this.isAsking = false;
    this.open();
    setInterval(() => this.watch(), 500);
  }

  open() {
    let wasOpen = false;
    this.socket = new WebSocket(`ws://${location.host}${location.pathname}socket`);
    this.socket.binaryType = "arraybuffer";
    const {socket} = this;
    const timer = setTimeout(() => socket.close(), answerMs);
    socket.onopen = () => {
      wasOpen = true;
      clearTimeout(timer);
      this.heard();
    };
    socket.onmessage = event => {
      this.heard();
      this.take(readAnswer(event.data));
    };
    socket.onclose = () => {
      clearTimeout(timer);
      this.closed(wasOpen);
    };
  }

  heard() {
    this.heardAt = performance.now();
    this.waitsSince = null;
    this.onState("open");
  }

  /** A server that hangs keeps its connections: it is asked now and then, while someone looks at the page. */
  async watch() {
    const {socket, heardAt} = this;
    const isThere = () => [WebSocket.OPEN, WebSocket.CLOSING].includes(socket.readyState);
    if (document.hidden || this.isAsking || !isThere() || performance.now() - heardAt < quietMs) return;
    this.isAsking = true;
    const answers = await this.whoAnswers();
    this.isAsking = false;
    if (this.socket !== socket || !isThere() || this.heardAt !== heardAt) return;
    if (answers !== "server") {
      if (answers !== "silent") socket.close();
      return this.onState(answers);
    }
    this.heardAt = performance.now();
    const isLate = this.waitsSince !== null && this.heardAt - this.waitsSince > longWorkMs;
    this.onState(isLate ? "busy" : "open");
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
    this.waitsSince = null;
    const answers = await this.whoAnswers();
    this.onState(answers !== "server" ? answers : wasOpen ? "dropped" : "full");
    setTimeout(() => this.open(), this.pauseMs);
    this.pauseMs = Math.min(longestPauseMs, 2 * this.pauseMs);
  }

  /** "server": the one of this page; "other"; "gone": none; "silent": none in answerMs. */
  async whoAnswers() {
    try {
      const answer = await fetch(location.pathname, {cache: "no-store", signal: AbortSignal.timeout(answerMs)});
      return answer.ok ? "server" : "other";
    } catch (error) {
      return error.name === "TimeoutError" ? "silent" : "gone";
    }
  }

  get isOpen() {
    return this.socket.readyState === WebSocket.OPEN;
  }

  /** Sends a message and returns its number, which the answer has. */
  send(message) {
    const number = ++this.lastNumber;
    if (!this.isOpen) return number;
    this.waitsSince ??= performance.now();
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
