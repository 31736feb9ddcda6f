// The panel: what lines there are, and how they look.
import {SheetEditor} from "./sheet_editor.js";

/** Of characters, each of which may take several bytes of a message. */
const longestSheet = 20000;

const $ = selector => document.querySelector(selector);

function element(name, properties = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

/** Where a slider stands for a number: where a range is wide, small numbers have more room. */
function scaleOf({value, min, max}) {
  const power = value - min < 0.2 * (max - min) ? 3 : 1;
  return {
    toNumber: t => min + (max - min) * t ** power,
    toPlace: x => Math.max(0, Math.min(1, (x - min) / (max - min || 1))) ** (1 / power),
  };
}

const shown = x => String(Number(Number(x).toPrecision(3)));

export class Panel {
  /** `onLook`: gets the look when it has changed; `say`: shows a text for a while. */
  constructor(hello, onLook, say) {
    this.hello = hello;
    this.onLook = onLook;
    this.say = say;
    this.edited = {};    // by style: the text that was made of it
    this.accepted = {};  // parameters that the sheet has taken
    this.look = structuredClone(hello.look);
    this.sheet = hello.sheet;
    this.editor = new SheetEditor($("#editor"), text => this.change({sheet: text === this.textOfStyle() ? "" : text}));
    this.makeClasses();
    this.makeStyles();
    this.listen();
    this.update();
  }

  textOfStyle() {
    return this.hello.styles.find(style => style.name === this.look.style)?.text ?? "";
  }

  hasSheet() {
    return this.look.style !== "" || this.look.sheet !== "";
  }

  change(part) {
    if (part.sheet?.length > longestSheet)
      return this.editor.showFault({line: 0, message: "the sheet is too long to be edited here; name its file by --style"});
    Object.assign(this.look, part);
    this.update();
    this.onLook(this.look);
  }

  restore(part) {
    this.editor.drop();
    this.look = {...structuredClone(this.hello.look), ...part};
    this.update();
  }

  makeClasses() {
    const ordinary = ["silhouette", "crease", "border", "intersection", "object", "material", "mark", "polygon"];
    const names = [...ordinary.filter(name => this.hello.classes.includes(name)),
                   ...this.hello.classes.filter(name => !ordinary.includes(name))];
    for (const name of names) {
      const chip = element("button", {type: "button", className: "chip", textContent: name});
      chip.dataset.lines = name;
      chip.onclick = () => {
        const lines = new Set(this.look.lines);
        if (!lines.delete(name)) lines.add(name);
        this.change({lines: this.hello.classes.filter(c => lines.has(c))});
      };
      $("#classes").append(chip);
    }
  }

  makeStyles() {
    $("#style").append(element("option", {value: "", textContent: "plain lines"}));
    for (const {name} of this.hello.styles) {
      const label = name.includes("/") ? name.slice(name.lastIndexOf("/") + 1) : name;
      $("#style").append(element("option", {value: name, textContent: label}));
    }
  }

  listen() {
    $("#style").onchange = event => this.chooseStyle(event.target.value);
    $("#width").oninput = event => this.change({width: Number((0.25 * 64 ** event.target.value).toPrecision(3))});
    $("#crease").oninput = event => this.change({crease_angle: Number(event.target.value)});
    for (const button of document.querySelectorAll("#hidden button"))
      button.onclick = () => this.change({hidden: button.value});
    $("#shading").onchange = event => this.change({shading: event.target.value});
    $("#edit").onclick = () => this.toggleEditor();
    $("#reset").onclick = () => this.reset();
  }

  /** What was typed into the sheet before comes back when its style is chosen again. */
  chooseStyle(style) {
    this.keepEdited();
    this.change({style, sheet: this.edited[style] ?? "", parameters: {}});
  }

  keepEdited() {
    this.editor.flush();
    if (this.look.sheet) this.edited[this.look.style] = this.look.sheet;
    else delete this.edited[this.look.style];
  }

  reset() {
    this.keepEdited();
    if (Object.keys(this.edited).length > 0 && !confirm("What you changed in style sheets will be lost.")) return;
    this.edited = {};
    this.change(structuredClone(this.hello.look));
  }

  toggleEditor(isShown = $("#editor").hidden) {
    $("#editor").hidden = !isShown;
    $("#edit").setAttribute("aria-expanded", isShown);
    document.body.classList.toggle("editing", isShown);
    this.editor.follow();
  }

  /** Has all controls say what the look is. */
  update() {
    const {look} = this, hasSheet = this.hasSheet();
    $("#style").value = look.style;
    for (const chip of $("#classes").children) {
      chip.setAttribute("aria-pressed", look.lines.includes(chip.dataset.lines));
      chip.disabled = hasSheet;
    }
    document.body.classList.toggle("has-sheet", hasSheet);
    $("#width").disabled = hasSheet;
    $("#width").value = Math.log(look.width / 0.25) / Math.log(64);
    $("#width-value").textContent = shown(look.width) + " px";
    const saysCrease = hasSheet && this.sheet?.says_crease;
    const crease = saysCrease ? this.sheet.crease_angle : look.crease_angle;
    $("#crease").disabled = Boolean(saysCrease);
    $("#crease").value = crease;
    $("#crease-value").textContent = shown(crease) + "°";
    for (const button of document.querySelectorAll("#hidden button")) {
      button.setAttribute("aria-pressed", button.value === look.hidden);
      button.disabled = hasSheet;
    }
    $("#shading").value = look.shading;
    $("#edit").disabled = !hasSheet;
    if (!hasSheet && !$("#editor").hidden) this.toggleEditor(false);
    if (document.activeElement !== this.editor.area && !this.editor.waits) this.editor.text = look.sheet || this.textOfStyle();
    this.updateSheet(hasSheet ? this.sheet : null);
  }

  /** Takes what the server says of the sheet in use; null: none is. */
  takeSheet(sheet) {
    this.sheet = sheet;
    this.accepted = {...this.look.parameters};
    this.editor.showFault(null);
    this.update();
  }

  /** Shows what is wrong with the look. Returns whether there was a place for it. */
  showFault(fault) {
    const unknown = fault.message.match(/no parameter '([^']+)'/);
    if (unknown && unknown[1] in this.look.parameters) {
      const parameters = {...this.look.parameters};
      delete parameters[unknown[1]];
      this.change({parameters});
      return true;
    }
    const refused = fault.message.match(/^--set style\.([^=]+)=(.*?): (?:.*value: )?(.*)$/);
    if (refused && refused[1] in this.look.parameters) {
      this.takeBack(refused[1]);
      this.say(`${refused[1].replaceAll("_", " ")}: ${refused[3]}`, true);
      return true;
    }
    if (!this.hasSheet() || (!fault.line && !this.look.sheet)) return false;
    if ($("#editor").hidden) this.toggleEditor(true);
    this.editor.showFault(fault);
    return true;
  }

  /** Gives a parameter the value again that it had before it was refused. */
  takeBack(name) {
    const parameters = {...this.look.parameters};
    delete parameters[name];
    if (name in this.accepted) parameters[name] = this.accepted[name];
    const row = [...$("#parameters").children].find(r => r.dataset.name === name);
    const had = this.sheet?.parameters?.find(p => p.name === name);
    if (row && had) row.show(had);
    this.change({parameters});
  }

  updateSheet(sheet) {
    $("#summary").textContent = sheet?.summary ?? "";
    const parameters = sheet?.parameters ?? [];
    const kinds = JSON.stringify(parameters.map(p => [p.name, p.unit, p.min, p.max]));
    if (kinds !== this.kinds) {
      this.kinds = kinds;
      $("#parameters").replaceChildren(...parameters.map(p => this.makeParameter(p)));
    }
    for (const row of $("#parameters").children) {
      const p = parameters.find(parameter => parameter.name === row.dataset.name);
      if (!p || row.contains(document.activeElement)) continue;
      row.show(p);
    }
  }

  makeParameter(p) {
    const set = text => this.change({parameters: {...this.look.parameters, [p.name]: text}});
    const row = element("label", {className: "row"}, element("span", {textContent: p.name.replaceAll("_", " ")}));
    row.dataset.name = p.name;
    if (p.value === undefined) {
      const color = element("input", {type: "color", value: p.text});
      color.oninput = () => set(color.value);
      row.append(color);
      row.show = now => { color.value = now.text; };
      return row;
    }
    const number = element("input", {type: "number", step: "any", className: "number"});
    number.setAttribute("aria-label", p.name);
    const unit = element("span", {className: "unit", textContent: p.unit});
    // Where a range is wide, the slider has its ordinary part; the field beside it takes all of it.
    const min = p.min ?? 0, most = p.value > min ? min + 8 * (p.value - min) : Infinity;
    const has = {value: p.value, min, max: Math.min(p.max ?? Math.max(1, 4 * p.value), most)};
    const scale = scaleOf(has);
    const slider = element("input", {type: "range", min: 0, max: 1, step: "any"});
    slider.oninput = () => {
      number.value = shown(scale.toNumber(Number(slider.value)));
      set(number.value + p.unit);
    };
    number.onchange = () => {
      if (number.value === "") return;
      slider.value = scale.toPlace(Number(number.value));
      set(number.value + p.unit);
    };
    row.append(slider, element("span", {className: "value"}, number, unit));
    row.show = now => {
      number.value = shown(now.value);
      slider.value = scale.toPlace(now.value);
    };
    return row;
  }
}
