// A page that follows a run is loaded again every few seconds and stays where its reader is.
const liveSeconds = Number(document.body.dataset.live ?? 0), scrollKey = `photonproof scroll ${location.pathname}`;

function keptScroll() {
  try {
    const kept = sessionStorage.getItem(scrollKey);
    sessionStorage.removeItem(scrollKey);
    return kept === null ? null : Number(kept);
  } catch {
    return null;  // no storage here: the browser's own memory of the place must do
  }
}

function loadAgain() {
  if (document.visibilityState !== "visible") {
    document.addEventListener("visibilitychange", loadAgain, {once: true});
    return;
  }
  try {
    sessionStorage.setItem(scrollKey, window.scrollY);
  } catch { /* as above */ }
  location.reload();
}

const scrollBefore = keptScroll();
if (scrollBefore !== null) window.scrollTo({top: scrollBefore, behavior: "instant"});
if (liveSeconds > 0) setTimeout(loadAgain, 1000 * liveSeconds);
