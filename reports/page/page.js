// Light or dark by hand, and the claims of one verdict alone. The page is complete without either.
const root = document.documentElement;
const dark = () => root.dataset.theme ? root.dataset.theme === "dark"
                                      : matchMedia("(prefers-color-scheme: dark)").matches;
document.getElementById("theme").addEventListener("click", () => { root.dataset.theme = dark() ? "light" : "dark"; });
const filters = document.querySelectorAll(".filters button");
for (const button of filters) button.addEventListener("click", () => {
  const verdict = button.dataset.verdict;
  for (const other of filters) other.setAttribute("aria-pressed", String(other === button));
  for (const row of document.querySelectorAll(".claims tbody"))
    row.hidden = Boolean(verdict) && row.dataset.verdict !== verdict;
});
addEventListener("beforeprint", () => { for (const d of document.querySelectorAll("details")) d.open = true; });
// Who asked for no motion sees what the animations end in.
if (matchMedia("(prefers-reduced-motion: reduce)").matches)
  for (const svg of document.querySelectorAll("svg:has(.moving)")) { svg.pauseAnimations(); svg.setCurrentTime(4.9); }
