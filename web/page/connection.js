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

export class Connection {
  /** `onAnswer`: gets what no request waits for; `onEnd`: is called once, when the server is gone. */
  constructor(onAnswer, onEnd) {
    this.waiting = new Map();
    this.lastNumber = 0;
    this.socket = new WebSocket(`ws://${location.host}${location.pathname}socket`);
    this.socket.binaryType = "arraybuffer";
    this.socket.onmessage = event => {
      const answer = readAnswer(event.data);
      const resolve = this.waiting.get(answer.number);
      this.waiting.delete(answer.number);
      if (resolve) resolve(answer);
      else onAnswer(answer);
    };
    this.socket.onclose = () => {
      for (const resolve of this.waiting.values()) resolve({kind: "error", message: "the server has ended"});
      this.waiting.clear();
      onEnd();
    };
  }

  get isOpen() {
    return this.socket.readyState === WebSocket.OPEN;
  }

  /** Sends a message and returns its number, which the answer has. */
  send(message) {
    const number = ++this.lastNumber;
    if (this.isOpen) this.socket.send(inToml({...message, number}));
    return number;
  }

  /** Sends a message; the promise has its answer, which may be of the kind "error". */
  request(message) {
    return new Promise(resolve => {
      if (!this.isOpen) return resolve({kind: "error", message: "the server has ended"});
      this.waiting.set(this.send(message), resolve);
    });
  }
}
