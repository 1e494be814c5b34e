// Keys, heard only while the focus is inside the viewer.
const keyHelp = [
  ["F  S  D  A", "flip, split, side by side, all"],
  ["Space", "flip between A and B"],
  ["1 … 9", "take that image as B (Shift: as A)"],
  ["I  X  M", "layer: image, signed error, FLIP map"],
  ["E  Shift E", "exposure up, down by half a stop"],
  ["+  −", "zoom (or the wheel, once the picture has the focus)"],
  ["Arrows", "move the view (or drag)"],
  ["Shift Arrows", "move the loupe's pixel"],
  ["[  ]", "move the divider"],
  ["T", "failing tiles"],
  ["R", "all of the image, exposure 0"],
  ["?", "these keys"],
];

const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};

function chooseByDigit(state, event) {
  const digit = /^(?:Digit|Numpad)([1-9])$/.exec(event.code ?? "")?.[1] ?? (/^[1-9]$/.test(event.key) ? event.key : null);
  if (digit === null || digit > state.data.images.length) return false;
  state.set(event.shiftKey ? {a: digit - 1} : {b: digit - 1, showsA: false});
  return true;
}

function pressArrow(state, event) {
  const [dx, dy] = arrows[event.key];
  if (event.shiftKey) {
    state.moveCursor(dx, dy);
  } else {
    const step = 0.125 / state.zoom;
    state.set({x: state.x + dx * step * state.data.width, y: state.y + dy * step * state.data.height});
  }
}

// Whether the key meant something.
function pressKey(state, event, toggleHelp) {
  const actions = {
    f: () => state.set({mode: "flip"}),
    s: () => state.set({mode: "split"}),
    d: () => state.set({mode: "side"}),
    a: () => state.set({mode: "all"}),
    " ": () => state.set({mode: "flip", showsA: state.mode === "flip" ? !state.showsA : true}),
    i: () => state.set({layer: "image"}),
    x: () => state.set({layer: "error"}),
    m: () => state.set({layer: "flip"}),
    e: () => state.set({stops: state.stops + (event.shiftKey ? -0.5 : 0.5)}),
    "+": () => state.zoomAt(Math.SQRT2),
    "=": () => state.zoomAt(Math.SQRT2),
    "-": () => state.zoomAt(Math.SQRT1_2),
    "[": () => state.set({divider: state.divider - 0.05}),
    "]": () => state.set({divider: state.divider + 0.05}),
    t: () => state.set({tiles: !state.tiles}),
    r: () => state.set({zoom: 1, stops: 0, divider: 0.5}),
    "?": toggleHelp,
  };
  if (event.key in arrows) pressArrow(state, event);
  else if (event.key.toLowerCase() in actions) actions[event.key.toLowerCase()]();
  else return chooseByDigit(state, event);
  return true;
}

function listenToKeys(root, state, toggleHelp) {
  root.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const tag = event.target.tagName, own = event.key in arrows || event.key === " " || event.key === "Enter";
    if (tag === "SELECT" || (own && (tag === "INPUT" || tag === "BUTTON"))) return;  // the control's own key
    if (pressKey(state, event, toggleHelp)) event.preventDefault();
  });
}
