// A viewer's view as a link: the address's fragment names scene, images, mode, layer, exposure, zoom, place and pixel,
// and opens that view. Values that are defaults are left out; values that make no sense are ignored.
const viewModes = ["flip", "split", "side", "all"], viewLayers = ["image", "error", "flip"];

function shortNumber(value) { return String(Number(value.toPrecision(6))); }

function fragmentOf(scene, state) {
  const {data} = state, view = new URLSearchParams({scene, mode: state.mode, layer: state.layer});
  view.set("a", data.images[state.a].title);
  view.set("b", data.images[state.b].title);
  if (state.mode === "flip" && state.showsA) view.set("shows", "a");
  if (state.mode === "split") view.set("divider", shortNumber(state.divider));
  if (state.stops !== 0) view.set("stops", shortNumber(state.stops));
  if (state.zoom > 1) view.set("zoom", shortNumber(state.zoom));
  if (state.zoom > 1) view.set("at", `${shortNumber(state.x)},${shortNumber(state.y)}`);
  if (state.cursor) view.set("pixel", state.cursor.join(","));
  return `#${view}`;
}

// The scene that a fragment names; null if it is no view.
function sceneOfFragment(fragment) { return new URLSearchParams(fragment.slice(1)).get("scene"); }

// The changes of state that a fragment asks for.
function changesOf(fragment, data) {
  const view = new URLSearchParams(fragment.slice(1)), changes = {showsA: view.get("shows") === "a", stops: 0, zoom: 1};
  const numbers = (key, count) => {
    const values = (view.get(key) ?? "").split(",").filter((text) => text.trim() !== "").map(Number);
    return values.length === count && values.every(Number.isFinite) ? values : null;
  };
  if (viewModes.includes(view.get("mode"))) changes.mode = view.get("mode");
  if (viewLayers.includes(view.get("layer"))) changes.layer = view.get("layer");
  for (const key of ["a", "b"]) {
    const index = data.images.findIndex((image) => image.title === view.get(key));
    if (index >= 0) changes[key] = index;
  }
  for (const key of ["divider", "stops", "zoom"]) {
    const value = numbers(key, 1);
    if (value) [changes[key]] = value;
  }
  const place = numbers("at", 2), pixel = numbers("pixel", 2);
  if (place) [changes.x, changes.y] = place;
  if (pixel) changes.cursor = pixel.map((value, i) => Math.min(Math.max(Math.floor(value), 0), [data.width, data.height][i] - 1));
  return changes;
}

// Some addresses, such as that of a frame's own text, can only have their fragment set.
let fragmentShown = null;  // the last one that the page itself set

function showFragment(fragment) {
  try {
    history.replaceState(history.state, "", fragment);
  } catch {
    location.hash = fragment;
  }
  fragmentShown = location.hash;
}

// Keeps the address at the view while somebody changes it, and gives the link to copy.
function linkView(scene, state, root) {
  const link = element("a", {class: "view-link", title: "This view: copy the link’s address"}, "Link");
  const update = () => { link.href = fragmentOf(scene, state); };
  let waiting = 0;
  state.listen(() => {
    update();
    clearTimeout(waiting);
    if (root()?.contains(document.activeElement)) waiting = setTimeout(() => showFragment(fragmentOf(scene, state)), 200);
  });
  update();
  return link;
}
