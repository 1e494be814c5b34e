// One scene's viewer: controls, panes and loupe around a state.
const modes = [["flip", "Flip"], ["split", "Split"], ["side", "Side by side"], ["all", "All"]];

class Viewer {
  constructor(data, scene) {
    this.scene = scene;
    this.state = new ViewerState(data);
    this.pictures = new Pictures(data);
    this.loupe = new Loupe(this.state, this.pictures);
    this.stage = element("div", {class: "stage", tabindex: 0, role: "group", "aria-label": `Pictures of ${data.name}`});
    this.status = element("p", {class: "status", role: "status"});
    this.help = this.makeHelp();
    const notes = data.notes.map((note) => element("p", {class: "note"}, note));
    this.root = element("div", {class: "viewer", role: "group", "aria-label": `Viewer of ${data.name}`},
        this.makeControls(), this.help,
        element("div", {class: "viewer-body"}, element("div", {class: "viewer-main"}, this.stage, this.legend.root, this.status),
                this.loupe.root), ...notes);
    listenToKeys(this.root, this.state, () => this.toggleHelp());
    listenToPointer(this.stage, this.state);
    this.state.listen(() => this.draw());
    this.arrange();
    new ResizeObserver(() => this.draw()).observe(this.stage);
  }

  makeControls() {
    const {state} = this, {images} = state.data, reference = state.reference() >= 0;
    const layers = [["image", "Image"]];
    if (reference && images.length > 1) layers.push(["error", "Signed error"]);
    if (images.some((image) => image.maps.flip)) layers.push(["flip", "FLIP map"]);
    this.mode = choice("View", modes.slice(images.length > 1 ? 0 : 3), (mode) => state.set({mode}));
    this.layer = choice("Layer", layers, (layer) => state.set({layer}));
    this.menus = [imageMenu("A", state, "a"), imageMenu("B", state, "b")];
    this.exposure = exposureSlider(state);
    this.legend = layerLegend();
    this.link = linkView(this.scene, state, () => this.root);
    this.helpButton = button("?", "Keys", () => this.toggleHelp());
    this.helpButton.setAttribute("aria-expanded", "false");
    this.zoomText = element("output", {class: "zoom"});
    return element("div", {class: "controls"}, this.mode.root, ...(layers.length > 1 ? [this.layer.root] : []),
        element("span", {class: "menus"}, ...this.menus.map((menu) => menu.root)), this.exposure.root,
        element("span", {class: "zooms"}, button("−", "Zoom out", () => state.zoomAt(0.5)), this.zoomText,
                button("+", "Zoom in", () => state.zoomAt(2)),
                button("Reset", "All of the image, exposure 0", () => state.set({zoom: 1, stops: 0, divider: 0.5}))),
        this.helpButton, this.link);
  }

  makeHelp() {
    const list = element("dl", {class: "keys"});
    for (const [keys, meaning] of keyHelp) {
      const row = element("dt", {});
      for (const key of keys.split("  ")) row.append(element("kbd", {}, key), " ");
      list.append(row, element("dd", {}, meaning));
    }
    list.hidden = true;
    return list;
  }

  toggleHelp() {
    this.help.hidden = !this.help.hidden;
    this.helpButton.setAttribute("aria-expanded", String(!this.help.hidden));
  }

  // New panes when their number or images change.
  arrange() {
    const {state} = this, shown = state.shown();
    const groups = state.mode === "split" ? [shown] : shown.map((index) => [index]);
    const key = JSON.stringify([state.mode, groups]);
    if (key === this.arranged) return;
    this.arranged = key;
    this.panes = groups.map((indices) => {
      const names = indices.map((index) => state.data.images[index].title).join(" | ");
      const canvas = element("canvas", {role: "img", "aria-label": names, "data-image": indices[indices.length - 1]});
      canvas.style.aspectRatio = `${state.data.width} / ${state.data.height}`;
      const captions = indices.map((index) => element("span", {}, label(state.data.images[index]),
          element("small", {}, state.data.images[index].caption)));
      return {canvas, indices, root: element("figure", {class: "pane"}, canvas, element("figcaption", {}, ...captions))};
    });
    this.stage.replaceChildren(...this.panes.map((pane) => pane.root));
    this.stage.style.setProperty("--columns", this.panes.length > 4 ? 3 : this.panes.length);
    if (state.mode === "split") this.panes[0].root.append(this.makeDivider());
  }

  makeDivider() {
    const {state} = this;
    this.divider = element("div", {class: "divider", role: "slider", tabindex: 0, "aria-label": "Divider",
                                   "aria-valuemin": 0, "aria-valuemax": 100});
    this.divider.addEventListener("keydown", (event) => {
      const step = {ArrowLeft: -0.02, ArrowRight: 0.02}[event.key];
      if (!step || event.shiftKey) return;
      state.set({divider: state.divider + step});
      event.preventDefault();
      event.stopPropagation();
    });
    return this.divider;
  }

  draw() {
    this.arrange();
    if (this.frame) return;
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      this.drawNow();
    });
  }

  drawNow() {
    const {state} = this;
    for (const pane of this.panes) {
      pane.root.classList.toggle("chosen", state.mode === "all" && pane.indices[0] === state.b);
      drawPane(pane.canvas, state, this.pictures, pane.indices);
    }
    if (state.mode === "split") {
      this.divider.style.left = `${100 * state.divider}%`;
      this.divider.setAttribute("aria-valuenow", Math.round(100 * state.divider));
    }
    this.loupe.draw(state);
    this.mode.show(state.mode);
    this.layer.show(state.layer);
    this.menus[0].show(state.a);
    this.menus[1].show(state.b);
    this.exposure.show();
    this.legend.show(state);
    this.zoomText.textContent = `${Number(state.zoom.toPrecision(3))}×`;
    const titles = state.shown().map((index) => state.data.images[index].title).join(", ");
    const said = `${modes.find(([mode]) => mode === state.mode)[1]}: ${titles}`;
    if (this.status.textContent !== said) this.status.textContent = said;
  }

  // The view that a link names.
  open(fragment) {
    this.state.set(changesOf(fragment, this.state.data));
    showFragment(fragment);
  }

  showTile(index) {
    const {state} = this, tile = state.data.tiles[index];
    const reach = 3 * Math.max(tile.width / state.data.width, tile.height / state.data.height);
    state.set({zoom: Math.max(1, 1 / reach), tiles: true, b: tile.image ?? state.b, mode: state.data.images.length > 1 ? "side" : "flip"});
    state.set({x: tile.x + tile.width / 2, y: tile.y + tile.height / 2,
               cursor: [tile.x + (tile.width >> 1), tile.y + (tile.height >> 1)]});
    this.root.scrollIntoView({block: "start"});
    this.stage.focus({preventScroll: true});
  }
}

async function makeViewer(section) {
  const source = section.querySelector("script.viewer-data");
  const data = JSON.parse(source.textContent);
  for (const image of data.images) {
    image.rgb = await unpackedPixels(image.pixels);
    delete image.pixels;
    if (image.flip) image.flip = await unpackedFlip(image.flip);
  }
  const viewer = new Viewer(data, section.dataset.scene ?? section.id);
  source.after(viewer.root);
  section.classList.add("has-viewer");
  viewer.draw();
  return viewer;
}
