// Draws the newest view: the next one is asked for when a frame has arrived, and in full quality when nothing moves.
import {bitmapOf} from "./pictures.js";

const restMs = 150;
const largestSide = 4096;

export class SceneView {
  /** `onShown`: gets each frame that is shown; `onFailed`: each error of a frame or of a look. */
  constructor(canvas, connection, orbit, {onShown, onFailed, onLook}) {
    Object.assign(this, {canvas, connection, orbit, onShown, onFailed, onLook});
    this.context = canvas.getContext("bitmaprenderer", {alpha: false});
    this.look = null;
    this.lookWaits = false;
    this.viewWaits = false;
    this.previewNumber = 0;  // of the preview that is asked for; 0: none is
    this.fullNumber = 0;     // of the picture in full quality that is asked for
    this.lookNumber = 0;
    this.shownNumber = 0;
    this.lastChange = 0;
    this.restTimer = 0;
  }

  /** Of the picture, in pixels of the screen. */
  get size() {
    const box = this.canvas.parentElement.getBoundingClientRect();
    const scale = Math.min(devicePixelRatio, largestSide / Math.max(box.width, box.height, 1));
    return [box.width, box.height].map(side => Math.max(1, Math.round(side * scale)));
  }

  message(kind, more = {}) {
    return {kind, size: this.size, ...more, camera: this.orbit.camera()};
  }

  /** Nothing is asked for yet; the look goes out before the next view. */
  begin(look) {
    this.look = look;
    this.lookWaits = true;
    this.previewNumber = this.fullNumber = 0;
  }

  viewChanged() {
    this.viewWaits = true;
    if (this.canvas.dataset.rests !== "no") this.canvas.dataset.rests = "no";
    this.lastChange = performance.now();
    this.ask();
  }

  lookChanged(look) {
    this.look = look;
    this.lookWaits = true;
    this.viewChanged();
  }

  ask() {
    if (this.previewNumber || !this.viewWaits || !this.connection.isOpen) return;
    this.viewWaits = false;
    clearTimeout(this.restTimer);
    this.fullNumber = 0;
    if (this.lookWaits) {
      this.lookWaits = false;
      this.lookNumber = this.connection.send({kind: "look", ...this.look});
    }
    this.previewNumber = this.connection.send(this.message("draw"));
  }

  askForFull() {
    clearTimeout(this.restTimer);
    this.restTimer = setTimeout(() => {
      if (!this.previewNumber) this.fullNumber = this.connection.send(this.message("draw", {full: true}));
    }, Math.max(0, restMs - (performance.now() - this.lastChange)));
  }

  /** Takes an answer; returns whether it was for this. */
  take(answer) {
    if (answer.kind === "look" && answer.number === this.lookNumber) this.onLook(answer.sheet);
    else if (answer.kind === "frame") this.show(answer);
    else if (answer.kind === "error" && [this.previewNumber, this.fullNumber, this.lookNumber].includes(answer.number)) {
      this.onFailed(answer);
      if (answer.number === this.previewNumber) this.previewArrived(false);
    } else return false;
    return true;
  }

  previewArrived(isGood) {
    this.previewNumber = 0;
    if (this.viewWaits) this.ask();
    else if (isGood) this.askForFull();
    else this.canvas.dataset.rests = "yes";
  }

  async show(frame) {
    const isNewest = frame.number === this.previewNumber || frame.number === this.fullNumber;
    if (frame.number === this.previewNumber) this.previewArrived(true);
    if (!isNewest) return;
    const bitmap = await bitmapOf(frame);
    if (frame.number < this.shownNumber) return bitmap.close();  // a newer one was quicker
    this.shownNumber = frame.number;
    if (this.canvas.width !== frame.width || this.canvas.height !== frame.height) {
      this.canvas.width = frame.width;
      this.canvas.height = frame.height;
    }
    this.context.transferFromImageBitmap(bitmap);
    if (frame.full && !this.viewWaits && !this.previewNumber) this.canvas.dataset.rests = "yes";
    this.onShown(frame);
  }
}
