// The text of a style sheet, with numbers of lines, and what is wrong shown at its line.

const waitMs = 250;

export class SheetEditor {
  /** `onText`: gets the text, a moment after it was typed. */
  constructor(root, onText) {
    this.area = root.querySelector("textarea");
    this.numbers = root.querySelector(".numbers");
    this.fault = root.querySelector(".fault");
    this.faultText = root.querySelector(".fault-text");
    this.line = 0;
    this.onText = onText;
    this.timer = 0;
    this.area.addEventListener("input", () => {
      this.count();
      this.showFault(null);
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.flush(), waitMs);
    });
    this.area.addEventListener("scroll", () => this.follow());
    this.area.addEventListener("keydown", event => {
      event.stopPropagation();
      if (event.key === "Escape") this.area.blur();
    });
  }

  /** Whether a text was typed that was not handed out yet. */
  get waits() {
    return this.timer !== 0;
  }

  /** Hands it out. */
  flush() {
    if (!this.waits) return;
    this.drop();
    this.onText(this.area.value);
  }

  /** Hands it out no more. */
  drop() {
    clearTimeout(this.timer);
    this.timer = 0;
  }

  set text(text) {
    if (this.area.value !== text) this.area.value = text;
    this.count();
    this.showFault(null);
  }

  count() {
    const lines = this.area.value.split("\n").length;
    if (lines === this.lines) return;
    this.lines = lines;
    this.numbers.textContent = Array.from({length: lines}, (_, i) => i + 1).join("\n");
  }

  get lineHeight() {
    return parseFloat(getComputedStyle(this.area).lineHeight);
  }

  /** `fault`: {line, column, message}; null takes it away. */
  showFault(fault) {
    this.line = fault?.line ?? 0;
    this.fault.hidden = this.faultText.hidden = !fault;
    this.faultText.textContent = fault ? (fault.line ? `line ${fault.line}: ` : "") + fault.message : "";
    if (this.line) {
      const top = (this.line - 1) * this.lineHeight;
      const isSeen = top >= this.area.scrollTop && top < this.area.scrollTop + this.area.clientHeight - 2 * this.lineHeight;
      if (!isSeen) this.area.scrollTop = top - this.area.clientHeight / 3;
    }
    this.follow();
  }

  follow() {
    const padding = parseFloat(getComputedStyle(this.area).paddingTop);
    const top = Math.max(0, this.line - 1) * this.lineHeight + padding - this.area.scrollTop;
    this.numbers.style.transform = `translateY(${-this.area.scrollTop}px)`;
    this.fault.style.transform = `translateY(${top}px)`;
    const place = this.line ? top + this.lineHeight : padding;
    const most = this.area.clientHeight - this.faultText.offsetHeight;
    this.faultText.style.transform = `translateY(${Math.max(0, Math.min(place, most))}px)`;
  }
}
