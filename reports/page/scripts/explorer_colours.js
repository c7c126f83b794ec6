// Colours that people with any colour vision tell apart, on light and on dark paper.
const kClassColours = {
  light: ["#332288", "#0e7fb5", "#117733", "#44aa99", "#8a8a22", "#c99a17", "#cc6677", "#882255", "#aa4499", "#6b6b6b"],
  dark: ["#9d8ff2", "#88ccee", "#4fc27f", "#5fd3c0", "#c9c95a", "#f0cf6a", "#f08f9f", "#d76aa0", "#dd8fd2", "#bdbdbd"],
};
// Viridis at even steps, without the end that its paper would swallow.
const kViridis = ["#440154", "#482878", "#3e4989", "#31688e", "#26828e", "#1f9e89", "#35b779", "#6ece58", "#b5de2b", "#fde725"];
const kShown = { light: [0, 0.82], dark: [0.28, 1] };

const rgb = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
const themeName = () => (dark() ? "dark" : "light");
const themeColour = (name) => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();

function scaleColour(share, [from, to] = kShown[themeName()]) {
  const at = (from + (to - from) * Math.min(1, Math.max(0, share))) * (kViridis.length - 1);
  const low = rgb(kViridis[Math.floor(at)]), high = rgb(kViridis[Math.ceil(at)]), part = at - Math.floor(at);
  return `rgb(${low.map((value, c) => Math.round(value + (high[c] - value) * part)).join(" ")})`;
}

// How a quantity of some layers is coloured: the middle 96 % of its values spread over the scale.
function colouring(layers, key) {
  const of = layers.map((layer) => layer.quantity(key));
  if (key === "class") return { ...of[0], colour: (value) => kClassColours[themeName()][value] };
  const values = layers.flatMap((layer, l) => Array.from({ length: layer.size }, (_, row) => of[l].of(row)));
  values.sort((a, b) => a - b);
  const at = (share) => values[Math.round(share * (values.length - 1))] ?? 0;
  const [low, high] = [at(0.02), at(0.98)], shown = kShown[themeName()];
  return { ...of[0], low, high, least: values[0], most: values.at(-1),
           colour: (value) => scaleColour(high > low ? (value - low) / (high - low) : 0.5, shown) };
}

// The key to the colours as elements.
function legend(scale) {
  if (scale.key === "class")
    return [..."0123456789"].map((digit) => {
      const swatch = element("span", { class: "swatch" }, digit);
      swatch.style.setProperty("--swatch", scale.colour(Number(digit)));
      return swatch;
    });
  const bar = element("span", { class: "scale" });
  const stops = Array.from({ length: 9 }, (_, k) => scaleColour(k / 8));
  bar.style.background = `linear-gradient(to right, ${stops.join(", ")})`;
  const ends = (value, beyond, sign) => (beyond ? sign : "") + shortNumber(value);
  return [element("span", {}, ends(scale.low, scale.least < scale.low, "≤ ")), bar,
          element("span", {}, ends(scale.high, scale.most > scale.high, "≥ ") + (scale.unit ? " " + scale.unit : ""))];
}

function shortNumber(value) {
  const text = Number.isInteger(value) ? value.toLocaleString("en").replaceAll(",", "\u202f") : value.toPrecision(3);
  return text.replace("-", "\u2212");
}
