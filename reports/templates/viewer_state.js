// State of a viewer: image, mode, exposure, layer and view. Changes go through `set`; dependents listen.
const largestZoom = 64;

class ViewerState {
  constructor(data) {
    this.data = data;
    this.listeners = [];
    this.mode = data.images.length > 2 ? "all" : data.images.length > 1 ? "side" : "flip";
    this.layer = "image";
    this.a = Math.max(0, data.images.findIndex((image) => image.isReference));
    this.b = data.images.findIndex((image, i) => i !== this.a);
    if (this.b < 0) this.b = this.a;
    this.showsA = false;  // in flip mode
    this.divider = 0.5;   // in split mode, of the width
    this.stops = 0;       // on top of the scene's exposure
    this.zoom = 1;        // 1 shows all of the image
    this.x = data.width / 2;  // the image's point in the middle of every pane
    this.y = data.height / 2;
    this.cursor = null;  // a pixel [x, y]
    this.tiles = data.tiles.length > 0;
  }

  listen(listener) { this.listeners.push(listener); }

  set(changes) {
    Object.assign(this, changes);
    this.zoom = Math.min(Math.max(this.zoom, 1), largestZoom);
    const half = 0.5 / this.zoom;  // panes hang over the image's edge by no more than at zoom 1
    this.x = Math.min(Math.max(this.x, half * this.data.width), (1 - half) * this.data.width);
    this.y = Math.min(Math.max(this.y, half * this.data.height), (1 - half) * this.data.height);
    this.stops = Math.min(Math.max(this.stops, -10), 10);
    this.divider = Math.min(Math.max(this.divider, 0), 1);
    for (const listener of this.listeners) listener(this);
  }

  // Zooms and leaves the image's point (x, y) where it is on the screen.
  zoomAt(factor, x = this.x, y = this.y) {
    const zoom = Math.min(Math.max(this.zoom * factor, 1), largestZoom);
    const kept = this.zoom / zoom;
    this.set({zoom, x: x + (this.x - x) * kept, y: y + (this.y - y) * kept});
  }

  moveCursor(dx, dy) {
    const step = this.data.reducedBy;
    const [x, y] = this.cursor ?? [Math.floor(this.x), Math.floor(this.y)];
    const clamped = (value, end) => Math.min(Math.max(value, 0), end - 1);
    const cursor = [clamped(x + step * dx, this.data.width), clamped(y + step * dy, this.data.height)];
    this.set({cursor});
  }

  // The images on show, first to last pane; in split mode both are in one pane.
  shown() {
    if (this.mode === "all") return this.data.images.map((image, i) => i);
    if (this.mode === "flip") return [this.showsA ? this.a : this.b];
    return [this.a, this.b];
  }

  reference() { return this.data.images.findIndex((image) => image.isReference); }
}
