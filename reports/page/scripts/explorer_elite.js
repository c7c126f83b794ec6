// What the explorer tells of the selected elite.

const withUnit = (value, unit) => shortNumber(value) + (unit ? " " + unit : "");

class ElitePanel {
  // `go` is told of a layer and a row to be selected next; `file` says where a layer's artifact is.
  constructor({ go, file }) {
    Object.assign(this, { go, file });
    this.player = new ArmPlayer();
    this.heading = element("h3", { id: "explorer-elite" });
    this.facts = element("dl", { class: "facts" });
    this.pictures = element("div", { class: "pictures" });
    this.family = element("div", { class: "family" });
    this.genes = element("tbody");
    this.code = element("code", { class: "python" });
    this.copy = element("button", { type: "button" }, "Copy");
    this.copy.addEventListener("click", () => this.copyCode());
    this.said = element("p", { class: "said", "aria-live": "polite" });
    const head = ["Gene", "Value", "Unit"].map((word) => element("th", { scope: "col" }, word));
    this.root = element("section", { class: "elite", "aria-labelledby": "explorer-elite" },
      this.heading, this.said, this.pictures, this.player.root, this.facts);
    this.more = element("section", { class: "elite more", "aria-label": "More of the elite" },
      element("div", {}, this.family, element("p", { class: "load" }, "In Python, with h5py:"), this.code, this.copy),
      element("div", { class: "scroll", role: "region", tabindex: 0, "aria-label": "Genome" }, element("table", { class: "genome" }, element("caption", {}, "Genome"),
        element("thead", {}, element("tr", {}, ...head)), this.genes)));
  }

  show(layer, row, twin) {
    const id = layer.id[row];
    this.heading.textContent = `${layer.title} · ${id}`;
    this.player.root.hidden = !layer.robot.links;
    if (layer.robot.links) this.player.show(layer.way(row), layer.robot.halfSide);
    this.showPictures(layer, row, twin);
    this.showFacts(layer, row);
    this.showFamily(layer, row);
    this.genes.replaceChildren(...layer.genome(row).map((value, g) => element("tr", {},
      element("th", { scope: "row" }, layer.genes.names[g]), element("td", {}, shortNumber(value)),
      element("td", {}, layer.genes.units[g]))));
    const what = layer.draws ? `layer["image"][${row}]` : `layer["measures"][${row}]`;
    this.code.textContent = `import h5py; layer = h5py.File("${this.file(layer)}"); layer["solution"][${row}], ${what}`;
    this.copy.textContent = "Copy";
    this.said.textContent = this.sentence(layer, row);
  }

  sentence(layer, row) {
    const parts = layer.quantities.filter(({ key }) => key !== "birth")
      .map(({ key, name, unit, of }) => `${name} ${key === "class" ? of(row) : withUnit(of(row), unit)}`);
    if (layer.of("good")) parts.splice(1, 0, layer.of("good").values[row] ? "good" : "not good");
    return `${layer.title}, ${layer.id[row]}: ${parts.join(", ")}.`;
  }

  showPictures(layer, row, twin) {
    const picture = (values, at, words) => element("figure", {},
      pixels(values, at, words), element("figcaption", {}, words));
    const all = layer.draws ? [picture(layer.of("image").values, row, "drawn")] : [];
    if (layer.of("decoded")) all.push(picture(layer.of("decoded").values, row, "decoded"));
    if (twin) {
      const other = picture(twin.layer.of("image").values, twin.row, "");
      const button = element("button", { type: "button" }, twin.layer.group === "flat" ? "nearest flat" : "nearest of hierarchy");
      button.addEventListener("click", () => this.go(twin.layer, twin.row));
      other.lastChild.replaceWith(element("figcaption", {}, button));
      all.push(other);
    }
    this.pictures.replaceChildren(...all);
  }

  showFacts(layer, row) {
    const facts = layer.quantities.map(({ key, name, unit, of }) =>
      [name, key === "class" ? String(of(row)) : key === "birth" ? `generation ${shortNumber(of(row))}` : withUnit(of(row), unit)]);
    if (layer.of("good")) facts.push(["good", layer.of("good").values[row] ? "yes" : "no"]);
    for (let d = 0; d < layer.dimensions; ++d)
      if (!layer.quantity("measure" + d))
        facts.push([layer.descriptor.names[d], withUnit(layer.place(row, d), layer.descriptor.units[d])]);
    this.facts.replaceChildren(...facts.map(([name, value]) =>
      element("div", {}, element("dt", {}, name), element("dd", {}, value))));
  }

  showFamily(layer, row) {
    const link = (other) => {
      const button = element("button", { type: "button" }, String(layer.id[other]));
      button.addEventListener("click", () => this.go(layer, other));
      return button;
    };
    const parent = layer.parent[row], children = layer.children(row);
    const ancestry = parent < 0 ? ["drawn at random"] : layer.rowOf.has(parent) ? [link(layer.rowOf.get(parent))]
      : [`${parent}, which did not survive`];
    const kin = children.slice(0, 8).map(link);
    if (children.length > 8) kin.push(` and ${children.length - 8} more`);
    this.family.replaceChildren(element("p", {}, "Parent: ", ...ancestry),
      element("p", {}, "Surviving children: ", ...(kin.length ? kin : ["none"])));
  }

  async copyCode() {
    try {
      await navigator.clipboard.writeText(this.code.textContent);
      this.copy.textContent = "Copied";
    } catch {
      getSelection().selectAllChildren(this.code);
      this.copy.textContent = "Selected: press Ctrl+C";
    }
  }
}

// A 28 x 28 image, ink on paper, in its own pixels.
function pixels(values, at, words) {
  const ink = tinted(values, at, "#ffffff");
  const canvas = element("canvas", { width: "28", height: "28", role: "img", "aria-label": words || "the nearest digit" });
  const paper = canvas.getContext("2d");
  paper.fillRect(0, 0, 28, 28);
  paper.drawImage(ink, 0, 0);
  return canvas;
}
