// Drawing: a picture per image and layer, kept until exposure changes, and panes that show a part of it.
class Pictures {
  constructor(data) {
    this.data = data;
    this.width = Math.ceil(data.width / data.reducedBy);
    this.height = Math.ceil(data.height / data.reducedBy);
    this.kept = new Map();
  }

  // A canvas or a picture of the page, or null when the layer has nothing for this image.
  of(index, layer, stops) {
    const key = `${index} ${layer} ${stops}`;
    if (this.kept.size > 64) this.kept.clear();
    if (!this.kept.has(key)) this.kept.set(key, this.made(index, layer, stops));
    return this.kept.get(key);
  }

  made(index, layer, stops) {
    const image = this.data.images[index];
    if (layer === "flip") return document.getElementById(image.maps.flip ?? "");
    const reference = this.data.images.find((other) => other.isReference);
    if (layer === "error" && (!reference || image === reference)) return null;
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [this.width, this.height];
    canvas.getContext("2d").putImageData(
        layer === "error" ? errorImage(image.rgb, reference.rgb, this.width, this.height, stops)
                          : displayedImage(image.rgb, this.width, this.height, this.data.exposure + stops), 0, 0);
    return canvas;
  }
}

// Where an image's points are in a pane of this size, in CSS pixels.
function placement(state, width, height) {
  const scale = state.zoom * Math.min(width / state.data.width, height / state.data.height);
  return {
    scale,
    left: width / 2 - scale * state.x,
    top: height / 2 - scale * state.y,
  };
}

function drawPicture(context, state, pictures, index, place) {
  const picture = pictures.of(index, state.layer, state.stops) ?? pictures.of(index, "image", 0);
  context.imageSmoothingEnabled = false;
  const factor = place.scale * state.data.reducedBy;
  const fills = picture instanceof HTMLImageElement;  // it may have been reduced by another factor
  context.drawImage(picture, place.left, place.top, fills ? place.scale * state.data.width : factor * picture.width,
                    fills ? place.scale * state.data.height : factor * picture.height);
}

function outline(context, x, y, width, height, dash) {
  for (const [style, line] of [["#000", 3], ["#fff", 1.25]]) {
    context.strokeStyle = style;
    context.lineWidth = line;
    context.setLineDash(line < 2 ? dash : []);
    context.strokeRect(x, y, width, height);
  }
}

function drawMarks(context, state, index, place) {
  const box = (x, y, width, height, dash) => outline(
      context, place.left + place.scale * x, place.top + place.scale * y, place.scale * width, place.scale * height, dash);
  if (state.tiles) {
    for (const tile of state.data.tiles) {
      if (tile.image === index || state.data.images[index].isReference) box(tile.x, tile.y, tile.width, tile.height, [5, 3]);
    }
  }
  const step = state.data.reducedBy;
  if (state.cursor) box(...state.cursor.map((c) => step * Math.floor(c / step)), step, step, []);
}

function drawPane(canvas, state, pictures, indices) {
  const width = canvas.clientWidth, height = canvas.clientHeight, density = window.devicePixelRatio || 1;
  if (width === 0 || height === 0) return;
  canvas.width = Math.round(width * density);
  canvas.height = Math.round(height * density);
  const context = canvas.getContext("2d");
  context.scale(density, density);
  const place = placement(state, width, height);
  drawPicture(context, state, pictures, indices[0], place);
  if (indices.length > 1) {
    const at = state.divider * width;
    context.save();
    context.beginPath();
    context.rect(at, 0, width - at, height);
    context.clip();
    context.clearRect(at, 0, width - at, height);
    drawPicture(context, state, pictures, indices[1], place);
    context.restore();
  }
  drawMarks(context, state, indices[indices.length - 1], place);
}
