// The page works without any of this; each part is added to what is there.
const viewers = new Map();  // by the section's id, a promise of the viewer

function viewerOf(id) {
  const section = document.getElementById(id);
  if (!section?.querySelector("script.viewer-data") || typeof DecompressionStream === "undefined") return null;
  if (!viewers.has(id)) viewers.set(id, makeViewer(section));
  return viewers.get(id);
}

// Pixels are unpacked when their scene comes near.
const near = new IntersectionObserver((entries) => {
  for (const entry of entries) {
    if (!entry.isIntersecting) continue;
    near.unobserve(entry.target);
    viewerOf(entry.target.id);
  }
}, {rootMargin: "800px"});
for (const section of document.querySelectorAll("section.scene")) near.observe(section);

// A link to a view opens it, on loading and later.
async function openView() {
  const scene = sceneOfFragment(location.hash);
  if (scene === null) return;
  const fragment = location.hash, sections = [...document.querySelectorAll("section")];
  const section = sections.find((node) => (node.dataset.scene ?? node.id) === scene && node.querySelector("script.viewer-data"));
  const viewer = section && await viewerOf(section.id);
  if (!viewer) return;
  viewer.open(fragment);
  if (scrollBefore === null) viewer.root.scrollIntoView({block: "start"});
}
window.addEventListener("hashchange", () => {
  if (location.hash !== fragmentShown) openView();
});
openView();

for (const toggle of document.querySelectorAll("button.gallery-toggle")) {
  toggle.addEventListener("click", () => {
    const open = toggle.closest("section").classList.toggle("shows-gallery");
    toggle.setAttribute("aria-expanded", String(open));
  });
}

for (const link of document.querySelectorAll("a[data-tile]")) {
  link.addEventListener("click", async (event) => {
    const viewer = viewerOf(link.getAttribute("href").slice(1));
    if (!viewer) return;
    event.preventDefault();
    (await viewer).showTile(Number(link.dataset.tile));
  });
}
