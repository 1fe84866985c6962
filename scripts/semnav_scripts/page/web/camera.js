// Which part of the plan the canvas shows: from metres to pixels and back.

const LEAST_SCALE = 16; // pixels for a metre: a plan that is larger is not shown as a whole at first
const MARGIN = 16; // pixels around the plan

export class Camera {
  constructor() {
    this.bounds = [0, 0, 1, 1];
    this.size = [1, 1];
    this.centre = [0, 0];
    this.zoom = 1;
    this.scale = 1;
  }

  /** Show a plan of these bounds from now on; the whole of it, or as much as can be read. */
  show(bounds, whole = false) {
    this.bounds = bounds;
    this.zoom = whole ? 1 : Math.max(1, LEAST_SCALE / this.wholeScale);
  }

  get wholeScale() {
    const [west, south, east, north] = this.bounds;
    const [width, height] = this.size;
    return Math.min((width - 2 * MARGIN) / (east - west), (height - 2 * MARGIN) / (north - south));
  }

  /** Look at a place, without leaving the plan. */
  lookAt([x, y]) {
    this.scale = this.wholeScale * this.zoom;
    const [west, south, east, north] = this.bounds;
    this.centre = [within(x, west, east, this.size[0] / this.scale), within(y, south, north, this.size[1] / this.scale)];
  }

  /** Move the view so that a place that was at `from` comes to `to`. */
  drag([x1, y1], [x2, y2]) {
    this.centre = [this.centre[0] + x1 - x2, this.centre[1] + y1 - y2];
  }

  x(x) { return this.size[0] / 2 + (x - this.centre[0]) * this.scale; }
  y(y) { return this.size[1] / 2 - (y - this.centre[1]) * this.scale; }
  place(px, py) {
    return [this.centre[0] + (px - this.size[0] / 2) / this.scale, this.centre[1] - (py - this.size[1] / 2) / this.scale];
  }
}

/** The middle of a view of some length that shows a value and, where it can, nothing outside. */
function within(value, least, most, length) {
  if (length >= most - least) return (least + most) / 2;
  return Math.min(Math.max(value, least + length / 2), most - length / 2);
}
