// Building the viewer's controls from native ones, so that they work by keyboard and are told to screen readers.

// An engine's marker and name.
function label(image) {
  const node = element("span", {class: "image-label"});
  if (image.shape) {
    node.innerHTML = `<svg class="swatch" viewBox="0 0 12 12" aria-hidden="true">${image.shape}</svg> `;  // all ours
    node.firstChild.style.color = image.color;
  }
  node.append(image.title);
  return node;
}

let groups = 0;

// Radio buttons that look like one divided button. `choices` are [value, text].
function choice(legend, choices, chosen) {
  const name = `viewer-choice-${++groups}`, inputs = new Map();
  const root = element("fieldset", {class: "choice"}, element("legend", {}, legend));
  for (const [value, text] of choices) {
    const input = element("input", {type: "radio", name, value});
    input.addEventListener("change", () => chosen(value));
    inputs.set(value, input);
    root.append(element("label", {}, input, element("span", {}, text)));
  }
  return {root, show: (value) => { if (inputs.has(value)) inputs.get(value).checked = true; }};
}

function imageMenu(text, state, key) {
  const select = element("select", {});
  state.data.images.forEach((image, i) => select.append(element("option", {value: i}, image.title)));
  select.addEventListener("change", () => state.set({[key]: Number(select.value)}));
  return {root: element("label", {class: "menu"}, `${text} `, select), show: (index) => { select.value = index; }};
}

function button(text, name, pressed) {
  const node = element("button", {type: "button", "aria-label": name, title: name}, text);
  node.addEventListener("click", pressed);
  return node;
}

function exposureSlider(state) {
  const input = element("input", {type: "range", min: -10, max: 10, step: 0.25, "aria-label": "Exposure in stops"});
  const output = element("output", {});
  input.addEventListener("input", () => state.set({stops: Number(input.value)}));
  const show = () => {
    input.value = state.stops;
    const total = state.layer === "error" ? state.stops : state.data.exposure + state.stops;
    output.textContent = `${total < 0 ? "−" : total > 0 ? "+" : ""}${Math.abs(total)} EV`;
    input.setAttribute("aria-valuetext", output.textContent);
  };
  return {root: element("label", {class: "exposure"}, "Exposure ", input, " ", output), show};
}

// Meaning of the layer's colours; empty for images.
function layerLegend() {
  const root = element("p", {class: "layer-legend"});
  const show = (state) => {
    root.hidden = state.layer === "image";
    const percent = Number((100 / 2 ** state.stops).toPrecision(3));
    root.replaceChildren(...(state.layer === "error"
        ? [`−${percent} % too dark `, element("span", {class: "error-ramp"}), ` +${percent} % too bright, of √(r² + 0.01)`]
        : ["FLIP 0 ", element("span", {class: "magma"}), " 1"]));
  };
  return {root, show};
}
