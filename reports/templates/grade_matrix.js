// A cell of the matrix opens its scene in a dialog; without the script its link leads there. Arrow keys go on from there.
function openTarget() {
  const id = decodeURIComponent(location.hash.slice(1)), target = id && document.getElementById(id);
  const folded = target && target.closest("details.submission");
  if (!folded || folded.open) return;
  folded.open = true;
  target.scrollIntoView();
}
window.addEventListener("hashchange", openTarget);
openTarget();

function makeMatrix(table) {
  const rows = [...table.tBodies[0].rows].map((row) => [...row.cells].slice(1).map((cell) => cell.querySelector("a.cell")));
  const names = [...table.tBodies[0].rows].map((row) => row.cells[0].textContent);
  const dialog = element("dialog", {"aria-label": "Scene of a submission"});
  let at = null;
  const show = (row, column) => {
    const link = rows[row]?.[column];
    if (!link) return;
    at = [row, column];
    const scene = document.getElementById(link.getAttribute("href").slice(1)).cloneNode(true);
    scene.removeAttribute("id");
    for (const tools of scene.querySelectorAll(".compare-tools")) tools.remove();
    for (const figures of scene.querySelectorAll(".compare")) {
      figures.className = "compare";
      makeCompare(figures);
    }
    dialog.replaceChildren(buttons(names[row]), scene);
    if (!dialog.open) dialog.showModal();
  };
  // The next cell that way which holds a scene.
  const go = (down, across) => {
    let [row, column] = at;
    do [row, column] = [row + down, column + across]; while (rows[row] && column >= 0 && column < rows[row].length && !rows[row][column]);
    show(row, column);
  };
  const buttons = (name) => {
    const bar = element("div", {class: "bar-of-buttons"}, element("b", {}, name));
    const add = (text, says, act) => {
      const button = element("button", {type: "button", "aria-label": says, title: says}, text);
      button.addEventListener("click", act);
      bar.append(button);
    };
    add("←", "previous scene", () => go(0, -1));
    add("→", "next scene", () => go(0, 1));
    add("↑", "submission above", () => go(-1, 0));
    add("↓", "submission below", () => go(1, 0));
    add("Close", "close", () => dialog.close());
    return bar;
  };
  const ways = {ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0]};
  dialog.addEventListener("keydown", (event) => {
    if (!ways[event.key] || event.target.matches("input, pre")) return;
    event.preventDefault();
    go(...ways[event.key]);
  });
  dialog.addEventListener("close", () => at && rows[at[0]][at[1]].focus());
  rows.forEach((links, row) => links.forEach((link, column) => link?.addEventListener("click", (event) => {
    event.preventDefault();
    show(row, column);
  })));
  document.body.append(dialog);
}
for (const table of document.querySelectorAll("table.matrix")) makeMatrix(table);
