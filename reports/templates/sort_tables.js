// Tables whose columns sort. A row that remarks on the one above stays with it; numbers sort by their data-sort.
function rowGroups(body) {
  const groups = [];
  for (const row of body.rows) {
    if (row.classList.contains("remark") && groups.length > 0) groups[groups.length - 1].push(row);
    else groups.push([row]);
  }
  return groups;
}

function sortKey(row, column) {
  const cell = row.cells[column];
  if (!cell) return null;
  const number = cell.dataset.sort ?? "";
  if (number !== "") return Number(number);
  const text = cell.textContent.trim();
  return text === "–" || text === "" ? null : text;
}

// Undefined ones last, either way round.
function compareKeys(a, b, direction) {
  if (a === null || b === null) return (a === null) - (b === null);
  if (typeof a === "number" && typeof b === "number") return direction * (a - b);
  return direction * String(a).localeCompare(String(b), "en", {numeric: true});
}

function sortBy(table, header, column) {
  const direction = header.getAttribute("aria-sort") === "ascending" ? -1 : 1;
  for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
  header.setAttribute("aria-sort", direction > 0 ? "ascending" : "descending");
  const body = table.tBodies[0];
  const groups = rowGroups(body).map((rows) => ({rows, key: sortKey(rows[0], column)}));
  groups.sort((a, b) => compareKeys(a.key, b.key, direction));
  table.classList.add("sorted");
  body.append(...groups.flatMap((group) => group.rows));
}

function makeSortable(table) {
  [...table.tHead.rows[0].cells].forEach((header, column) => {
    if (header.textContent.trim() === "") return;
    const control = element("button", {type: "button", class: "sort"}, ...header.childNodes);
    control.addEventListener("click", () => sortBy(table, header, column));
    header.replaceChildren(control);
  });
}
for (const table of document.querySelectorAll("table.sortable")) makeSortable(table);
