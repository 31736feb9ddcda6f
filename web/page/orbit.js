// The camera: it goes around a target, with an axis that stays upright.

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const scaled = (a, k) => a.map(x => x * k);
const sum = (...vectors) => [0, 1, 2].map(i => vectors.reduce((total, v) => total + v[i], 0));
const difference = (a, b) => a.map((x, i) => x - b[i]);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = a => Math.hypot(...a);
const normalized = a => scaled(a, 1 / (length(a) || 1));
const steepest = 89.9 * Math.PI / 180;
/** The least distance of the eye from the target, as a part of the size of the scene and of its place. */
const nearest = 1e-5;
/** As many digits as a picture needs: short in addresses and command lines. */
const digits = 8;
const rounded = x => Number(x.toPrecision(digits));

export class Orbit {
  /** Turns around a place of a scene of such a size, with an axis that stays upright. */
  constructor(axis, sceneSize) {
    this.target = [0, 0, 0];
    this.up = normalized(axis);
    this.sceneSize = sceneSize;
    this.yaw = 0;
    this.pitch = 0;
    this.distance = 1;
    this.fov = 35;
    this.isOrthographic = false;
    this.taken = null;  // the view as it was given, as long as nothing moves
  }

  /** The directions at which yaw is 0 and a quarter turn, across the axis. */
  get across() {
    const front = Math.abs(this.up[2]) > 0.9 ? [0, -1, 0] : [0, 0, 1];
    const ahead = normalized(difference(front, scaled(this.up, dot(front, this.up))));
    return [ahead, cross(this.up, ahead)];
  }

  /** From the target to the eye; right; up in the picture. */
  get axes() {
    const [ahead, side] = this.across;
    const level = Math.cos(this.pitch);
    const back = sum(scaled(ahead, level * Math.cos(this.yaw)), scaled(side, level * Math.sin(this.yaw)),
                     scaled(this.up, Math.sin(this.pitch)));
    const right = normalized(cross(this.up, back));
    return {back, right, above: cross(back, right)};
  }

  /** Height of what is seen at the target, in world units. */
  get seenHeight() {
    return 2 * this.distance * Math.tan(this.fov * Math.PI / 360);
  }

  /** Takes a view as the server sends it. If its camera is rolled, that is seen until something moves. */
  take({eye, target, up, fov, height}) {
    this.fov = fov;
    this.isOrthographic = height !== null && height !== undefined;
    this.target = [...target];
    const back = difference(eye, target);
    this.distance = length(back) || 1;
    const [ahead, side] = this.across;
    const direction = normalized(back);
    this.pitch = Math.max(-steepest, Math.min(steepest, Math.asin(Math.max(-1, Math.min(1, dot(direction, this.up))))));
    this.yaw = Math.atan2(dot(direction, side), dot(direction, ahead));
    if (this.isOrthographic) this.distance = height / (2 * Math.tan(this.fov * Math.PI / 360));
    this.taken = {eye: eye.map(rounded), target: target.map(rounded), up: up.map(rounded)};
    if (this.isOrthographic) this.taken.height = rounded(height);
    else this.taken.fov = rounded(fov);
  }

  toggleProjection() {
    this.isOrthographic = !this.isOrthographic;
    this.taken = null;
  }

  /** The view as a message has it. `isUpright`: without the roll of a view that was taken. */
  camera(isUpright = false) {
    if (this.taken && !isUpright) return this.taken;
    const {back} = this.axes;
    const camera = {
      eye: sum(this.target, scaled(back, this.distance)).map(rounded),
      target: this.target.map(rounded),
      up: this.up.map(rounded),
    };
    if (this.isOrthographic) camera.height = rounded(this.seenHeight);
    else camera.fov = rounded(this.fov);
    return camera;
  }

  turn(right, up) {
    this.taken = null;
    this.yaw -= right;
    this.pitch = Math.max(-steepest, Math.min(steepest, this.pitch + up));
  }

  look(yaw, pitch) {
    this.taken = null;
    this.yaw = yaw;
    this.pitch = Math.max(-steepest, Math.min(steepest, pitch));
  }

  /** Moves what is seen by a part of the picture's height. */
  pan(right, down) {
    this.taken = null;
    const {right: x, above: y} = this.axes;
    this.target = sum(this.target, scaled(x, -right * this.seenHeight), scaled(y, down * this.seenHeight));
  }

  /** Comes nearer (factor < 1) to a place, in parts of the picture's height from its middle. */
  zoom(factor, right = 0, down = 0) {
    this.taken = null;
    const before = this.seenHeight;
    const least = nearest * (this.sceneSize + length(this.target)) || Number.MIN_VALUE;
    this.distance = Math.max(Math.min(least, this.distance), Math.min(1e12, this.distance * factor));
    const change = before - this.seenHeight;
    const {right: x, above: y} = this.axes;
    this.target = sum(this.target, scaled(x, right * change), scaled(y, -down * change));
  }
}
