// What a script adds to a page that is complete without: the theme, which claims and which robot are shown, and
// motion. Choices outlive a reload where the browser keeps them.
const root = document.documentElement;
const kept = {
  get: (key) => { try { return localStorage.getItem(key); } catch { return null; } },
  set: (key, value) => { try { localStorage.setItem(key, value); } catch { /* nothing keeps it */ } },
};

const dark = () => root.dataset.theme ? root.dataset.theme === "dark"
                                      : matchMedia("(prefers-color-scheme: dark)").matches;
document.getElementById("theme").addEventListener("click", () => {
  root.dataset.theme = dark() ? "light" : "dark";
  kept.set("hbr-theme", root.dataset.theme);
});

// Buttons of which one is pressed; `choose` shows what it stands for.
function choice(buttons, key, choose) {
  const press = (button) => {
    for (const other of buttons) other.setAttribute("aria-pressed", String(other === button));
    choose(button.value);
  };
  for (const button of buttons)
    button.addEventListener("click", () => { press(button); kept.set(key, button.value); });
  return (value) => press(buttons.find((button) => button.value === value) ?? buttons[0]);
}

// The element that the address names, or null: "#50%" names nothing.
function addressed() {
  try {
    return document.getElementById(decodeURIComponent(location.hash.slice(1)));
  } catch {
    return null;
  }
}

const claims = [...document.querySelectorAll(".claims tbody")], verdicts = [...document.querySelectorAll(".filters button")];
const showClaims = choice(verdicts, "hbr-claims", (verdict) => {
  for (const claim of claims) claim.hidden = Boolean(verdict) && claim.dataset.verdict !== verdict;
});
if (verdicts.length) showClaims(kept.get("hbr-claims"));

const robots = [...document.querySelectorAll(".robot")];
if (robots.length > 1) {
  const bar = document.createElement("div");
  bar.className = "filters no-print";
  bar.setAttribute("role", "group");
  bar.setAttribute("aria-label", "Show one robot");
  for (const robot of robots) {
    const button = document.createElement("button");
    button.type = "button";
    button.value = robot.id;
    button.textContent = robot.querySelector("h3").textContent;
    bar.append(button);
  }
  robots[0].before(bar);
  const show = choice([...bar.children], "hbr-robot", (id) => {
    for (const robot of robots) robot.classList.toggle("unseen", robot.id !== id);
  });
  // An address within a robot shows that one.
  const follow = () => {
    const target = addressed(), robot = target?.closest(".robot");
    if (robot) { show(robot.id); target.scrollIntoView(); }
    return Boolean(robot);
  };
  addEventListener("hashchange", follow);
  if (!follow()) show(kept.get("hbr-robot"));
}

// A folded figure opens for its address, and a claim that the filter hides comes back.
const unfold = () => {
  const target = addressed(), fold = target?.closest("details");
  if (fold) fold.open = true;
  if (target?.closest("tbody[hidden]")) { showClaims(""); target.scrollIntoView(); }
};
addEventListener("hashchange", unfold);
unfold();

// Strokes move until they are paused, and not at all for who asked for no motion; on paper they are finished.
for (const svg of document.querySelectorAll("svg")) {
  const animations = [...svg.querySelectorAll("animate")];
  if (!animations.length) continue;
  const button = document.createElement("button");
  let moving = false;
  const move = (on) => {
    moving = on;
    for (const animation of animations) on ? animation.beginElement() : animation.endElement();
    button.textContent = on ? "Pause" : "Play";
  };
  button.type = "button";
  button.className = "no-print";
  button.addEventListener("click", () => move(!moving));
  svg.parentElement.before(button);
  move(!matchMedia("(prefers-reduced-motion: reduce)").matches);
  let before = moving;
  addEventListener("beforeprint", () => { before = moving; move(false); });
  addEventListener("afterprint", () => move(before));
}

// Paper shows what is folded.
const opened = [];
addEventListener("beforeprint", () => {
  for (const fold of document.querySelectorAll("details:not([open])")) { fold.open = true; opened.push(fold); }
});
addEventListener("afterprint", () => { for (const fold of opened.splice(0)) fold.open = false; });

// What scrolls within its box can be reached by the keyboard.
const reach = () => {
  for (const box of document.querySelectorAll(".scroll:not([role])"))
    if (box.scrollWidth > box.clientWidth) box.tabIndex = 0; else box.removeAttribute("tabindex");
};
addEventListener("resize", reach);
document.addEventListener("toggle", reach, true);
reach();
