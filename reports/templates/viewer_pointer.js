// Mouse, pen and finger on the panes. Dragging moves the image, or near it the divider of split mode. The wheel zooms when
// the stage has the focus, so a page that is scrolled past does not change. Pointing moves the loupe.
const dividerReach = 14;  // CSS pixels

function listenToPointer(stage, state) {
  const at = (canvas, event) => {
    const box = canvas.getBoundingClientRect(), place = placement(state, box.width, box.height);
    const [px, py] = [event.clientX - box.left, event.clientY - box.top];
    return {px, place, width: box.width, x: (px - place.left) / place.scale, y: (py - place.top) / place.scale};
  };
  let drag = null;
  stage.addEventListener("pointerdown", (event) => {
    if (event.target.tagName !== "CANVAS" || event.button !== 0) return;
    const {px, place, width} = at(event.target, event);
    const divides = state.mode === "split" && Math.abs(px - state.divider * width) < dividerReach;
    drag = {canvas: event.target, divides, scale: place.scale, x: state.x, y: state.y, from: event, moved: false};
    if (event.isTrusted) stage.setPointerCapture(event.pointerId);
    stage.focus({preventScroll: true});
  });
  stage.addEventListener("pointermove", (event) => {
    if (drag?.divides) {
      state.set({divider: at(drag.canvas, event).px / drag.canvas.clientWidth});
    } else if (drag) {
      const dx = event.clientX - drag.from.clientX, dy = event.clientY - drag.from.clientY;
      drag.moved = drag.moved || Math.hypot(dx, dy) > 4;
      state.set({x: drag.x - dx / drag.scale, y: drag.y - dy / drag.scale});
    } else if (event.target.tagName === "CANVAS") {
      const {x, y} = at(event.target, event), inside = x >= 0 && y >= 0 && x < state.data.width && y < state.data.height;
      if (inside) state.set({cursor: [Math.floor(x), Math.floor(y)]});
    }
  });
  stage.addEventListener("pointerup", () => {
    if (drag && !drag.moved && state.mode === "all") state.set({b: Number(drag.canvas.dataset.image)});
    drag = null;
  });
  stage.addEventListener("pointercancel", () => { drag = null; });
  stage.addEventListener("wheel", (event) => {
    if (event.target.tagName !== "CANVAS" || (document.activeElement !== stage && !event.ctrlKey)) return;
    event.preventDefault();
    const {x, y} = at(event.target, event);
    state.zoomAt(2 ** (-event.deltaY / 240), x, y);
  }, {passive: false});
}
