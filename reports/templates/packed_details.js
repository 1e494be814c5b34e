// Details of many measurements are deflated HTML, which is unpacked when they are opened.
for (const details of document.querySelectorAll("details.packed")) {
  details.addEventListener("toggle", async () => {
    const packed = details.querySelector("script.packed-cells");
    if (!details.open || !packed || typeof DecompressionStream === "undefined") return;
    packed.remove();
    details.querySelector(".cells").innerHTML = new TextDecoder().decode(await inflated(packed.textContent));
  });
}
