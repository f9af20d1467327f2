// Without this the page is whole but for the slider and the zoom.
for (const scene of document.querySelectorAll(".scene")) {
  const panes = scene.querySelector(".panes");
  const range = (text, name, min, max, value, moved) => {
    const label = document.createElement("label");
    const input = Object.assign(document.createElement("input"), { type: "range", name, min, max, value, step: "any" });
    input.addEventListener("input", () => moved(Number(input.value)));
    label.append(text, input);
    moved(value);
    return label;
  };

  // Fixed point left of the line, float64 right of it.
  const stage = Object.assign(document.createElement("div"), { className: "stage" });
  const layers = Object.assign(document.createElement("div"), { className: "layers" });
  const edge = Object.assign(document.createElement("div"), { className: "edge" });
  layers.append(...["core", "reference"].map((kind) => panes.querySelector(`.${kind} img`).cloneNode()), edge);
  stage.append(layers);

  const views = [...panes.querySelectorAll(".view"), stage];
  const width = Number(panes.dataset.width);
  const controls = Object.assign(document.createElement("div"), { className: "controls" });
  controls.append(
    range("fixed point | float64", "cut", 0, 100, 50, (cut) => layers.style.setProperty("--cut", `${cut}%`)),
    range("zoom", "zoom", 0, 5, 0, (zoom) => {
      panes.classList.toggle("zoomed", zoom > 0);
      for (const image of panes.querySelectorAll("img")) image.style.width = zoom > 0 ? `${width * 2 ** zoom}px` : "";
      layers.style.width = zoom > 0 ? `${width * 2 ** zoom}px` : "";
      layers.style.maxWidth = zoom > 0 ? "none" : `${Math.max(width, 320)}px`;
    }),
  );
  panes.after(controls, stage);

  // All views look at the same place.
  for (const view of views) {
    view.addEventListener("scroll", () => {
      for (const other of views) {
        if (other.scrollLeft !== view.scrollLeft) other.scrollLeft = view.scrollLeft;
        if (other.scrollTop !== view.scrollTop) other.scrollTop = view.scrollTop;
      }
    });
  }
}
