// What a page does where scripts run: tables sort, plots answer to pointers and keys, the theme changes. The page
// is complete without.
"use strict";
(() => {
  const all = (selector, within = document) => [...within.querySelectorAll(selector)];
  const make = (tag, properties) => Object.assign(document.createElement(tag), properties);

  // Tables: a heading sorts up, then down, then as it was.
  const words = new Intl.Collator("en", { numeric: true, sensitivity: "base" });
  const compare = (a, b, index) => {
    const [first, second] = [a.cells[index], b.cells[index]];
    const [x, y] = [first?.dataset.sort, second?.dataset.sort];
    if (x !== undefined && y !== undefined && Number(x) !== Number(y)) return Number(x) - Number(y);
    return words.compare(first?.textContent ?? "", second?.textContent ?? "");
  };
  // Numbers that are missing come last, whichever way the others go.
  const lacks = (row, index, kind) => kind !== "text" && row.cells[index]?.dataset.sort === undefined;
  for (const table of all(".scroll table")) {
    const body = table.tBodies[0];
    const rows = [...body.rows];
    const heads = all("thead th", table);
    if (rows.length < 2) continue;
    heads.forEach((head, index) => {
      const button = make("button", { type: "button", textContent: head.textContent });
      head.replaceChildren(button);
      head.setAttribute("aria-sort", "none");
      button.addEventListener("click", () => {
        const next = { none: "ascending", ascending: "descending", descending: "none" }[head.getAttribute("aria-sort")];
        heads.forEach((other) => other.setAttribute("aria-sort", "none"));
        head.setAttribute("aria-sort", next);
        const kind = head.dataset.kind;
        const sign = next === "descending" ? -1 : 1;
        const sorted = [...rows];
        if (next !== "none") {
          sorted.sort((a, b) => lacks(a, index, kind) - lacks(b, index, kind) || sign * compare(a, b, index));
        }
        body.append(...sorted);
      });
    });
  }

  // Plots: one tip for all of them, which is also read out.
  const tip = make("div", { id: "tip", hidden: true });
  const said = make("div", { id: "said" });
  said.setAttribute("aria-live", "polite");
  document.body.append(tip, said);

  for (const plot of all(".plot")) {
    const drawing = plot.querySelector(":scope > svg");
    if (!drawing) continue;
    const series = all(".series", drawing);
    const entries = all(".legend li", plot);
    let here = null; // The mark that is pointed at.
    let pinned = null; // The series that stays lit.

    const light = (index) => {
      const lit = index ?? pinned;
      plot.classList.toggle("lighting", lit !== null);
      for (const one of [...series, ...entries]) one.classList.toggle("lit", lit !== null && one.dataset.series === lit);
    };
    const leave = () => {
      here?.classList.remove("here");
      here = null;
      tip.hidden = true;
      light(null);
    };
    const show = (mark, aloud) => {
      if (mark === here) return;
      leave();
      here = mark;
      mark.classList.add("here");
      const name = mark.parentElement.dataset.name;
      const text = `${name}\n${mark.dataset.label}`;
      tip.textContent = text;
      tip.hidden = false;
      const at = mark.getBoundingClientRect();
      const size = tip.getBoundingClientRect();
      const left = Math.min(Math.max(4, at.left + at.width / 2 - size.width / 2), innerWidth - size.width - 4);
      const above = at.top - size.height - 8;
      tip.style.transform = `translate(${left}px, ${above > 4 ? above : at.bottom + 8}px)`;
      light(mark.parentElement.dataset.series);
      if (aloud) said.textContent = text;
    };
    const visible = () => series.filter((one) => !one.hasAttribute("hidden") && one.querySelector(".mark"));
    const nearest = (event) => {
      const box = drawing.getBoundingClientRect();
      const scale = drawing.viewBox.baseVal.width / box.width;
      const [x, y] = [(event.clientX - box.left) * scale, (event.clientY - box.top) * scale];
      let found = null;
      let least = event.pointerType === "touch" ? 34 : 22;
      for (const mark of visible().flatMap((one) => all(".mark", one))) {
        const distance = Math.hypot(mark.dataset.x - x, mark.dataset.y - y);
        if (distance < least) [found, least] = [mark, distance];
      }
      return found;
    };
    const point = (event) => {
      const mark = nearest(event);
      if (mark) show(mark, false);
      else leave();
    };
    drawing.addEventListener("pointermove", point);
    drawing.addEventListener("pointerdown", (event) => {
      const index = nearest(event)?.parentElement.dataset.series ?? null;
      pinned = index === pinned ? null : index;
      point(event);
    });
    drawing.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && leave());

    // Keys: along a series, and from one to the next.
    drawing.setAttribute("tabindex", "0");
    drawing.setAttribute("aria-description", "arrow keys go from point to point");
    drawing.addEventListener("blur", leave);
    drawing.addEventListener("keydown", (event) => {
      const steps = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] };
      if (event.key === "Escape") return leave();
      const curves = visible();
      if (!(event.key in steps) || curves.length === 0) return;
      event.preventDefault();
      const [across, along] = here ? steps[event.key] : [0, 0];
      const from = Math.max(0, curves.indexOf(here?.parentElement));
      const curve = curves[(from + across + curves.length) % curves.length];
      const before = here ? all(".mark", here.parentElement).indexOf(here) : 0;
      const marks = all(".mark", curve);
      show(marks[Math.min(Math.max(before + along, 0), marks.length - 1)], true);
    });

    entries.forEach((entry) => {
      const button = make("button", { type: "button" });
      button.append(...entry.childNodes);
      entry.append(button);
      button.setAttribute("aria-pressed", "true");
      button.addEventListener("click", () => {
        const shown = series[entry.dataset.series].toggleAttribute("hidden");
        button.setAttribute("aria-pressed", String(!shown));
        if (pinned === entry.dataset.series) pinned = null;
        leave();
      });
      for (const kind of ["pointerenter", "focus"]) button.addEventListener(kind, () => light(entry.dataset.series));
      for (const kind of ["pointerleave", "blur"]) button.addEventListener(kind, () => light(null));
    });
  }
  addEventListener("scroll", () => { tip.hidden = true; }, { passive: true });

  // The theme: the system's, or the reader's choice, which is kept where that is allowed.
  const root = document.documentElement;
  const button = document.getElementById("theme");
  const themes = ["system", "light", "dark"];
  const kept = () => {
    try { return localStorage.getItem("volver-theme"); } catch { return null; }
  };
  const choose = (theme) => {
    if (theme === "system") delete root.dataset.theme;
    else root.dataset.theme = theme;
    button.textContent = `Theme: ${theme}`;
    try { localStorage.setItem("volver-theme", theme); } catch { /* Pages of a file system may keep nothing. */ }
  };
  button.hidden = false;
  choose(themes.find((theme) => theme === kept()) ?? "system");
  button.addEventListener("click", () => {
    choose(themes[(themes.indexOf(root.dataset.theme ?? "system") + 1) % themes.length]);
  });
})();
