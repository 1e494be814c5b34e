// The loupe: the pixels around one, enlarged, and every image's values there.
const loupeRadius = 4, loupeCell = 12;

function valueText(value) {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "NaN" : value > 0 ? "∞" : "−∞";
  const size = Math.abs(value);
  const text = size === 0 ? "0" : size < 0.001 || size >= 1e4 ? value.toExponential(2) : value.toPrecision(3);
  return text.replace("-", "−");
}

function percentText(fraction) {
  if (!Number.isFinite(fraction)) return valueText(fraction);
  const percent = 100 * fraction;
  return (percent < 0 ? "−" : "+") + Math.abs(percent).toFixed(Math.abs(percent) < 10 ? 2 : 1) + " %";
}

function drawLoupe(canvas, state, pictures, index, column, row) {
  const side = (2 * loupeRadius + 1) * loupeCell;
  [canvas.width, canvas.height] = [side, side];
  const context = canvas.getContext("2d");
  context.imageSmoothingEnabled = false;
  const picture = pictures.of(index, state.layer === "error" ? "error" : "image", state.stops) ??
      pictures.of(index, "image", 0);
  context.drawImage(picture, (loupeRadius - column) * loupeCell, (loupeRadius - row) * loupeCell,
                    picture.width * loupeCell, picture.height * loupeCell);
  outline(context, loupeRadius * loupeCell, loupeRadius * loupeCell, loupeCell, loupeCell, []);
}

class Loupe {
  constructor(state, pictures) {
    this.pictures = pictures;
    this.where = element("p", {class: "where"}, "Point at a pixel, or press Shift and an arrow key.");
    this.views = element("div", {class: "loupe-views"});
    this.body = element("tbody", {});
    this.error = state.reference() >= 0;
    this.flip = state.data.images.some((image) => image.flip);
    const head = ["", "R", "G", "B", ...(this.error ? ["error"] : []), ...(this.flip ? ["FLIP"] : [])];
    this.table = element("table", {class: "loupe-values"},
        element("thead", {}, element("tr", {}, ...head.map((text) => element("th", {scope: "col"}, text)))), this.body);
    this.root = element("div", {class: "loupe", role: "group", "aria-label": "Pixel values"}, this.where, this.views,
        this.table);
    this.table.hidden = true;
  }

  draw(state) {
    if (!state.cursor) return;
    const {data} = state, step = data.reducedBy;
    const [column, row] = state.cursor.map((c) => Math.floor(c / step));
    this.where.textContent = `Pixel ${state.cursor[0]}, ${state.cursor[1]}` + (step > 1 ? `, mean of ${step} × ${step}` : "");
    const pair = [...new Set([state.a, state.b])];
    this.views.replaceChildren(...pair.map((index) => {
      const canvas = element("canvas", {role: "img", "aria-label": `${data.images[index].title}, enlarged`});
      drawLoupe(canvas, state, this.pictures, index, column, row);
      return element("figure", {}, canvas, element("figcaption", {}, label(data.images[index])));
    }));
    const i = row * this.pictures.width + column;
    this.body.replaceChildren(...data.images.map((image) => this.row(state, image, i)));
    this.table.hidden = false;
  }

  row(state, image, i) {
    const cells = [...image.rgb.subarray(3 * i, 3 * i + 3)].map((value) => element("td", {}, valueText(value)));
    if (this.error) {
      const reference = state.data.images[state.reference()];
      cells.push(element("td", {}, image === reference ? "" : percentText(signedError(image.rgb, reference.rgb, i))));
    }
    if (this.flip) cells.push(element("td", {}, image.flip ? image.flip[i].toFixed(2) : ""));
    return element("tr", {}, element("th", {scope: "row"}, label(image)), ...cells);
  }
}
