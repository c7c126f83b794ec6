// The explorer: which layer of which replication is on the maps, what is filtered and coloured, which elite is
// selected. The address says the last: #hbr/0/1234 is the hierarchy's digit 1234 of replication 0.
class Explorer {
  constructor(root, { replications, profile }) {
    Object.assign(this, { root, replications, profile, replication: 0, key: null, until: Infinity, bound: null,
                          wanted: "", goodness: "" });
    this.absent = element("p", { class: "absent", role: "status" });
    this.bar = element("div", { class: "explorer-bar" });
    this.legend = element("p", { class: "legend", "aria-label": "Colours" });
    this.maps = element("div", { class: "maps" });
    this.panel = new ElitePanel({
      go: (layer, row) => this.select(layer, row, true),
      file: (layer) => `out/${profile}/${layer.layer}/${replications[this.replication]}.h5`,
    });
    root.append(this.absent, this.bar, element("div", { class: "explorer-body" },
      element("div", { class: "where" }, this.legend, this.maps), this.panel.root, this.panel.more));
    // Some steps in the browser's history are told twice.
    for (const step of ["popstate", "hashchange"])
      addEventListener(step, () => { if (location.hash !== this.address) this.follow(); });
    const redraw = () => this.refresh();
    new MutationObserver(redraw).observe(document.documentElement, { attributeFilter: ["data-theme"] });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  }

  // Whether it is open: what is asked for last counts.
  async open(replication, group) {
    const asked = (this.asked = {});
    if (this.layers === undefined || replication !== this.replication) {
      const layers = await readExplorer(this.replications[replication]);
      if (asked !== this.asked) return false;
      const views = [["hbr", "flat"].filter((name) => layers.has(name)),
                     ...[...layers.keys()].filter((name) => name.startsWith("layer")).map((name) => [name])];
      Object.assign(this, { replication, layers, views, view: undefined });
    }
    const view = this.views.find((groups) => groups.includes(group)) ?? this.views[0];
    if (view !== this.view) this.show(view);
    return true;
  }

  // The maps and the controls of a view, one layer or both repertoires of digits.
  show(view) {
    this.view = view;
    this.axes = [0, 1];
    this.shown = view.map((group) => this.layers.get(group));
    this.quantities = this.shown[0].quantities.filter(({ key }) => this.shown.every((layer) => layer.quantity(key)));
    const known = (wanted) => this.quantities.find(({ key }) => key === wanted);
    this.key = (known(this.key) ?? known("class") ?? this.quantities[0]).key;
    this.maplets = this.shown.map((layer) => new EliteMap(layer, {
      hover: (place) => { for (const map of this.maplets) { map.cursor = place; map.draw(); } },
      choose: (row) => this.select(layer, row, true),
      step: (row) => this.select(layer, row, false),
    }));
    this.maps.replaceChildren(...this.maplets.map((map) => map.root));
    this.maps.classList.toggle("single", view.length === 1);
    this.filterBy = this.quantities.find(({ key }) => key === "error" || key === "fitness" || key === "uncertainty");
    const all = this.shown.flatMap((layer) => Array.from({ length: layer.size }, (_, row) => [layer, row]));
    const values = (key) => all.map(([layer, row]) => layer.quantity(key).of(row));
    const limited = this.filterBy && values(this.filterBy.key);
    this.limits = { born: Math.max(...values("birth")), value: limited && [Math.min(...limited), Math.max(...limited)] };
    Object.assign(this, { until: Infinity, bound: null, wanted: "", goodness: "" });
    this.fillBar();
    this.refresh();
  }

  fillBar() {
    const labelled = (words, control) => element("label", {}, words + " ", control);
    const select = (options, value, change) => {
      const control = element("select", {}, ...options.map(([key, text]) => element("option", { value: key }, text)));
      control.value = value;
      control.addEventListener("change", () => change(control.value));
      return control;
    };
    const slider = (low, high, step, words, change, at = high) => {
      const said = element("output");
      const control = element("input", { type: "range", min: String(low), max: String(high), step: String(step) });
      control.value = String(at);
      const tell = () => {
        said.textContent = words(Number(control.value));
        control.setAttribute("aria-valuetext", said.textContent);
      };
      control.addEventListener("input", () => { tell(); change(Number(control.value)); });
      tell();
      return [control, " ", said];
    };
    const views = element("div", { class: "filters", role: "group", "aria-label": "Layer" });
    for (const view of this.views) {
      const button = element("button", { type: "button", "aria-pressed": String(view === this.view) },
        view[0] === "hbr" ? "Digits" : this.layers.get(view[0]).title);
      button.addEventListener("click", () => { if (view !== this.view) { this.show(view); this.selectFirst(true); } });
      views.append(button);
    }
    const controls = [];
    if (this.replications.length > 1)
      controls.push(labelled("Replication", select(this.replications.map((_, k) => [String(k), String(k)]),
        String(this.replication), async (value) => {
          if (await this.open(Number(value), this.view[0])) this.selectFirst(true);
        })));
    const refreshing = (change) => (value) => { change(value); this.refresh(); };
    controls.push(labelled("Colour", select(this.quantities.map(({ key, name }) => [key, name]), this.key,
      refreshing((key) => { this.key = key; }))));
    const dimensions = this.shown[0].dimensions;
    if (dimensions > 2)
      for (const [k, words] of [[0, "Across"], [1, "Up"]])
        controls.push(labelled(words, select(this.shown[0].descriptor.names.map((name, d) => [String(d), name]),
          String(this.axes[k]), refreshing((d) => { this.axes[k] = Number(d); }))));
    if (this.quantities.some(({ key }) => key === "class"))
      controls.push(labelled("Class", select([["", "all"], ...[..."0123456789"].map((d) => [d, d])], "",
        refreshing((value) => { this.wanted = value; }))));
    if (this.shown.every((layer) => layer.of("good")))
      controls.push(labelled("Good", select([["", "all"], ["1", "good"], ["0", "not good"]], "",
        refreshing((value) => { this.goodness = value; }))));
    if (this.limits.value) {
      const [low, high] = this.limits.value, steps = 100, { name, larger } = this.filterBy, all = larger ? 0 : steps;
      const bound = (k) => low + ((high - low) * k) / steps;
      controls.push(labelled(`${name[0].toUpperCase()}${name.slice(1)} ${larger ? "from" : "up to"}`, element("span", {},
        ...slider(0, steps, 1, (k) => shortNumber(bound(k)),
          refreshing((k) => { this.bound = k === all ? null : bound(k); }), all))));
    }
    controls.push(labelled("Born until generation", element("span", {}, ...slider(1, this.limits.born, 1, shortNumber,
      refreshing((value) => { this.until = value; })))));
    const csv = element("button", { type: "button" }, "Selection as CSV");
    csv.addEventListener("click", () => this.save());
    this.bar.replaceChildren(views, element("div", { class: "controls" }, ...controls, csv));
  }

  passes(layer, row) {
    const value = this.bound === null ? 0 : layer.quantity(this.filterBy.key).of(row);
    return layer.generation(row) <= this.until
      && (this.bound === null || (this.filterBy.larger ? value >= this.bound : value <= this.bound))
      && (this.wanted === "" || layer.of("label").values[row] === Number(this.wanted))
      && (this.goodness === "" || layer.of("good").values[row] === Number(this.goodness));
  }
  visible(layer) { return Array.from({ length: layer.size }, (_, row) => row).filter((row) => this.passes(layer, row)); }

  refresh() {
    if (!this.shown) return;
    const scale = colouring(this.shown, this.key);
    this.legend.replaceChildren(element("b", {}, scale.name), ...legend(scale),
      ...(scale.meaning && scale.meaning !== scale.name ? [element("span", {}, "· " + scale.meaning)] : []));
    for (const map of this.maplets) map.show({ axes: this.axes, visible: this.visible(map.layer), scale });
    this.panel.player.draw();
  }

  // A click is a step in the browser's history, a key only moves the present one.
  select(layer, row, step) {
    const address = `#${layer.group}/${this.replication}/${layer.id[row]}`;
    if (location.hash !== address) history[step ? "pushState" : "replaceState"](null, "", address);
    this.address = address;
    this.absent.textContent = "";
    this.mark(layer, row);
  }
  mark(layer, row) {
    let twin = null;
    for (const map of this.maplets) {
      map.selected = map.layer === layer ? row : null;
      map.twin = null;
      if (map.layer !== layer && map.layer.draws && this.view.length === 2) {
        map.twin = map.nearest(...this.maplets.find((own) => own.layer === layer).place(row));
        if (map.twin !== null) twin = { layer: map.layer, row: map.twin };
      }
      map.draw();
    }
    this.panel.show(layer, row, twin);
    if (layer.group === "hbr")
      dispatchEvent(new CustomEvent("hbr-digit",
        { detail: { replication: this.replications[this.replication], id: layer.id[row] } }));
  }
  // The digit that the judge is surest of, or the fittest elite.
  selectFirst(step) {
    const [layer] = this.shown;
    const worth = layer.quantity("confidence")?.of ?? ((row) => layer.of("objective").values[row]);
    const good = (row) => layer.of("good")?.values[row] ?? 0;
    let best = 0;
    for (let row = 1; row < layer.size; ++row)
      if (good(row) > good(best) || (good(row) === good(best) && worth(row) > worth(best))) best = row;
    if (step) this.select(layer, best, true);
    else this.mark(layer, best);
  }

  // Goes where the address points; whether it points into the explorer. What is not there is told, beside the
  // first that is.
  async follow() {
    const address = (this.address = location.hash);
    this.absent.textContent = "";
    const [, group, replication, id] = address.match(/^#(\w+)\/(\d+)\/(\d+)$/) ?? [];
    if (!group) return false;
    const there = Number(replication) < this.replications.length;
    if (!(await this.open(there ? Number(replication) : 0, group))) return true;
    const layer = there ? this.layers.get(group) : undefined, row = layer?.rowOf.get(Number(id));
    if (row !== undefined) {
      this.mark(layer, row);
      return true;
    }
    this.selectFirst(false);
    this.absent.textContent = `${address} is not in this run’s explorer, which has the replications `
      + `${this.replications.map((_, k) => k).join(", ")} of ${[...this.layers.keys()].join(", ")}: another elite is shown.`;
    return true;
  }

  save() {
    const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
    const named = (name, unit) => quoted(unit ? `${name} [${unit}]` : name);
    const [first] = this.shown, judged = Boolean(first.of("good"));
    const names = first.descriptor.names.map((name, d) => named(name, first.descriptor.units[d]));
    const lines = [["layer", "replication", "id", "parent", ...names,
                    ...this.quantities.map(({ name, unit }) => named(name, unit)), ...(judged ? ["good"] : [])].join(",")];
    for (const layer of this.shown)
      for (const row of this.visible(layer))
        lines.push([layer.layer, this.replication, layer.id[row], layer.parent[row],
                    ...names.map((_, d) => layer.place(row, d)),
                    ...this.quantities.map(({ key }) => layer.quantity(key).of(row)),
                    ...(judged ? [layer.of("good").values[row]] : [])].join(","));
    const link = element("a", { download: `${this.view.join("_")}_${this.replications[this.replication]}.csv` });
    link.href = URL.createObjectURL(new Blob([lines.join("\n") + "\n"], { type: "text/csv" }));
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }
}

(async () => {
  const root = document.getElementById("explorer-app");
  if (!root || !window.DecompressionStream) return;
  const { words } = await unpack("explorer");
  const explorer = new Explorer(root, words);
  const asked = await explorer.follow();
  if (!asked && (await explorer.open(0, "hbr"))) explorer.selectFirst(false);
  document.getElementById("explorer-needs").remove();
  root.hidden = false;
  if (asked) document.getElementById("explorer").scrollIntoView();
})();
