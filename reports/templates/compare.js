// Submission and reference over each other, with an edge between them that can be moved, and marks that can be hidden.
function toggle(text, pressed, act) {
  const button = element("button", {type: "button", "aria-pressed": String(pressed)}, text);
  button.addEventListener("click", () => {
    const now = button.getAttribute("aria-pressed") !== "true";
    button.setAttribute("aria-pressed", String(now));
    act(now);
  });
  return button;
}

function makeCompare(figures) {
  const submitted = figures.querySelector(".submitted img"), reference = figures.querySelector(".reference img");
  if (!submitted || !reference || figures.querySelector(".compare-tools")) return;
  const range = element("input", {type: "range", min: "0", max: "100", step: "1", value: "50"});
  const label = element("label", {}, "Edge", range);
  const move = (percent) => {
    range.value = String(percent);
    figures.style.setProperty("--split", `${range.value}%`);
  };
  range.addEventListener("input", () => move(range.value));
  const swap = element("button", {type: "button"}, "Swap");
  swap.addEventListener("click", () => move(Number(range.value) < 50 ? 100 : 0));
  label.hidden = swap.hidden = true;
  const slider = toggle("One over the other", false, (on) => {
    figures.classList.toggle("over", on);
    label.hidden = swap.hidden = !on;
    move(50);
  });
  const tools = element("div", {class: "compare-tools"}, slider, swap, label);
  if (figures.querySelector(".mark")) slider.after(toggle("Marks", true, (on) => figures.classList.toggle("no-marks", !on)));
  figures.prepend(tools);
  const frame = figures.querySelector(".reference .frame");
  const drag = (event) => {
    if (!figures.classList.contains("over") || (event.type === "pointermove" && event.buttons === 0)) return;
    const box = frame.getBoundingClientRect();
    move(Math.round(100 * (event.clientX - box.left) / box.width));
    event.preventDefault();
  };
  frame.addEventListener("pointerdown", drag);
  frame.addEventListener("pointermove", drag);
}
for (const figures of document.querySelectorAll(".compare")) makeCompare(figures);
