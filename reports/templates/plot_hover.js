// Numbers of the plot's point that is nearest to the pointer, or that the arrow keys have reached.
function makeHover(figure) {
  const svg = figure.querySelector("svg"), points = [...svg.querySelectorAll(".point")];
  const tip = element("p", {class: "tip", role: "status"});
  tip.hidden = true;
  figure.append(tip);
  svg.setAttribute("tabindex", "0");
  const texts = points.map((point) => {
    const title = point.querySelector("title");
    title.remove();  // the browser's own tooltip would lie on ours
    return title.textContent;
  });
  let at = -1;
  const show = (index) => {
    points[at]?.classList.remove("near");
    at = index;
    tip.hidden = at < 0;
    if (at < 0) return;
    points[at].classList.add("near");
    tip.textContent = texts[at];
    const box = figure.getBoundingClientRect(), marker = points[at].getBoundingClientRect();
    const half = tip.offsetWidth / 2, middle = (marker.left + marker.right) / 2 - box.left;
    tip.style.left = `${Math.max(0, Math.min(middle - half, box.width - 2 * half))}px`;
    tip.style.top = `${marker.top - box.top - tip.offsetHeight - 6}px`;
  };
  svg.addEventListener("pointermove", (event) => {
    let best = -1, least = 28;
    points.forEach((point, i) => {
      const box = point.getBoundingClientRect();
      const distance = Math.hypot(event.clientX - (box.left + box.right) / 2, event.clientY - (box.top + box.bottom) / 2);
      if (distance < least) [best, least] = [i, distance];
    });
    show(best);
  });
  svg.addEventListener("pointerleave", () => show(-1));
  svg.addEventListener("blur", () => show(-1));
  svg.addEventListener("keydown", (event) => {
    const step = {ArrowLeft: -1, ArrowRight: 1}[event.key];
    if (!step) return;
    event.preventDefault();
    show((Math.max(at, step > 0 ? -1 : 0) + step + points.length) % points.length);
  });
}
for (const figure of document.querySelectorAll("figure.plot")) makeHover(figure);
