// What a reader does with a page, done by a script: the value is { wrong: what went wrong, told: what was there to see }.
(() => {
  const wrong = [];
  const told = { plots: 0, tables: 0, numeric: 0, verdicts: 0 };
  const all = (selector, within = document) => [...within.querySelectorAll(selector)];
  const check = (holds, words) => { if (!holds) wrong.push(words); };

  // Colours as bytes, whatever notation they come in.
  const paper = Object.assign(document.createElement("canvas"), { width: 1, height: 1 });
  const brush = paper.getContext("2d", { willReadFrequently: true });
  const known = new Map();
  const bytes = (color) => {
    if (!known.has(color)) {
      brush.fillStyle = color;
      brush.fillRect(0, 0, 1, 1);
      known.set(color, [...brush.getImageData(0, 0, 1, 1).data].slice(0, 3));
    }
    return known.get(color);
  };
  const light = (color) => {
    const [r, g, b] = color.map((c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const contrast = (a, b) => {
    const [dark, bright] = [light(a), light(b)].sort((x, y) => x - y);
    return (bright + 0.05) / (dark + 0.05);
  };
  const ground = (element) => {
    for (let up = element; up; up = up.parentElement) {
      const color = getComputedStyle(up).backgroundColor;
      if (color !== "rgba(0, 0, 0, 0)") return bytes(color);
    }
    return [255, 255, 255];
  };
  const seen = new Set();
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const element = node.parentElement;
    const style = getComputedStyle(element);
    if (!node.data.trim() || element.closest("script, style") || !element.getClientRects().length) continue;
    const drawn = element instanceof SVGElement;
    const [ink, below] = [bytes(drawn ? style.fill : style.color), ground(element)];
    const kind = `${element.tagName} ${ink} on ${below}`;
    if (seen.has(kind)) continue;
    seen.add(kind);
    const least = parseFloat(style.fontSize) >= 24 ? 3 : 4.5;
    const reached = contrast(ink, below);
    check(reached >= least, `contrast ${reached.toFixed(2)} of '${node.data.trim().slice(0, 40)}' (${kind})`);
  }

  // Every plot can be seen, with all its curves.
  for (const plot of all(".plot")) {
    const name = plot.querySelector("figcaption").textContent;
    const drawing = plot.querySelector(":scope > svg");
    if (!drawing) {
      check(plot.querySelector(".none"), `plot '${name}' is empty and does not say so`);
      continue;
    }
    told.plots += 1;
    const size = drawing.getBoundingClientRect();
    check(size.width > 200 && size.height > 120, `plot '${name}' is ${size.width} × ${size.height}`);
    check(all(".grid text", drawing).length >= 4, `plot '${name}' has no ticks`);
    check(drawing.getAttribute("role") === "img" && drawing.getAttribute("aria-label"), `plot '${name}' has no name`);
    for (const series of all(".series", drawing)) {
      const marks = all(".mark", series);
      const parts = [...marks, ...all(".trace", series)];
      const extent = series.getBBox();
      check(parts.length > 0 && extent.width + extent.height > 0, `series '${series.dataset.name}' of '${name}' is empty`);
      for (const mark of marks) {
        const at = mark.getBoundingClientRect();
        const inside = at.left >= size.left - 1 && at.right <= size.right + 1 && at.top >= size.top - 1 && at.bottom <= size.bottom + 1;
        check(inside && at.width > 1, `a mark of '${series.dataset.name}' in '${name}' is not within its plot`);
      }
      if (parts.length) {
        const reached = contrast(bytes(getComputedStyle(parts[0]).stroke), ground(plot));
        check(reached >= 3, `contrast ${reached.toFixed(2)} of series '${series.dataset.name}' of '${name}'`);
      }
    }
    // The legend switches and lights up.
    const series = all(".series", drawing);
    const entries = all(".legend li", plot);
    check(entries.length === series.length, `plot '${name}' has ${entries.length} entries for ${series.length} series`);
    const opacity = (one) => { one.style.transition = "none"; return Number(getComputedStyle(one).opacity); };
    entries.forEach((entry, index) => {
      const button = entry.querySelector("button");
      if (!button) return check(false, `entry ${index} of '${name}' is no button`);
      button.dispatchEvent(new PointerEvent("pointerenter"));
      check(opacity(series[index]) === 1, `entry ${index} of '${name}' does not light its series`);
      check(series.every((one, other) => other === index || opacity(one) < 0.5), `entry ${index} of '${name}' dims no other series`);
      button.dispatchEvent(new PointerEvent("pointerleave"));
      check(series.every((one) => opacity(one) === 1), `series of '${name}' stay dim`);
      button.click();
      check(getComputedStyle(series[index]).display === "none" && button.ariaPressed === "false", `entry ${index} of '${name}' does not hide its series`);
      button.click();
      check(getComputedStyle(series[index]).display !== "none" && button.ariaPressed === "true", `entry ${index} of '${name}' does not show its series again`);
    });
    // A point says its values, and lights up its entry of the legend.
    const tip = document.getElementById("tip");
    const mark = drawing.querySelector(".mark");
    if (mark) {
      plot.scrollIntoView();
      const at = mark.getBoundingClientRect();
      const where = { clientX: at.left + at.width / 2, clientY: at.top + at.height / 2, pointerType: "mouse", bubbles: true };
      drawing.dispatchEvent(new PointerEvent("pointermove", where));
      const box = tip.getBoundingClientRect();
      check(!tip.hidden && box.width > 20 && box.left >= 0 && box.right <= innerWidth, `a point of '${name}' has no tip within the window`);
      const [first, ...rest] = tip.textContent.split("\n");
      check(series.some((one) => one.dataset.name === first) && rest.join("").length > 3, `the tip of '${name}' says '${tip.textContent}'`);
      check(all(".legend li.lit", plot).length === 1, `a point of '${name}' lights no entry`);
      drawing.dispatchEvent(new PointerEvent("pointerleave", { pointerType: "mouse" }));
      check(tip.hidden, `the tip of '${name}' stays`);
      drawing.focus();
      const key = (name) => drawing.dispatchEvent(new KeyboardEvent("keydown", { key: name, bubbles: true, cancelable: true }));
      key("ArrowRight");
      const before = tip.textContent;
      const few = all(".mark", mark.parentElement).length;
      key("ArrowRight");
      check(!tip.hidden && (tip.textContent !== before || few === 1), `keys do not walk along '${name}'`);
      drawing.blur();
    }
  }

  // Tables sort both ways and back, numbers as numbers.
  const number = (text) => (/^[~+−-]?\d+(\.\d+)?(e-?\d+)?( ± .*)?$/.test(text) ? parseFloat(text.replace(/^[~+]/, "").replace("−", "-")) : NaN);
  for (const table of all(".scroll table")) {
    const rows = () => [...table.tBodies[0].rows];
    const heads = all("thead th", table);
    if (rows().length < 2) continue;
    told.tables += 1;
    const original = rows();
    heads.forEach((head, index) => {
      const title = `column '${head.textContent}' of '${table.caption.textContent}'`;
      const button = head.querySelector("button");
      if (!button) return check(false, `${title} is no button`);
      const texts = () => rows().map((row) => row.cells[index].textContent.trim());
      const values = (list) => list.map(number).filter((value) => !Number.isNaN(value));
      const sorted = (list, sign) => list.every((value, at) => at === 0 || sign * (value - list[at - 1]) >= 0);
      const ranks = () => rows().map((row) => row.cells[index].querySelector(".badge"))
        .map((badge) => (badge ? ["bad", "open", "good"].findIndex((tone) => badge.classList.contains(tone)) : 9));
      const ways = { ascending: 1, descending: -1 };
      const seen = texts();
      for (const way of Object.keys(ways)) {
        button.click();
        check(head.getAttribute("aria-sort") === way, `${title} is ${head.getAttribute("aria-sort")}, not ${way}`);
        const found = values(texts());
        if (head.dataset.kind === "number" && found.length === rows().length && seen.every((text) => !text.includes("\n"))) {
          check(sorted(found, ways[way]), `${title} is not ${way}: ${texts()}`);
          const words = [...found].map(String).sort();
          if (way === "ascending" && !sorted(words.map(Number), 1)) told.numeric += 1;
        }
        if (head.dataset.kind === "verdict") {
          check(sorted(ranks().filter((rank) => rank !== 9), ways[way]), `${title} is not ${way}: ${texts()}`);
          if (way === "ascending" && new Set(ranks()).size > 1) told.verdicts += 1;
        }
        check(rows().length === original.length, `${title} loses rows`);
      }
      button.click();
      check(head.getAttribute("aria-sort") === "none" && rows().every((row, at) => row === original[at]), `${title} does not return`);
    });
  }

  // The theme changes, and comes back.
  const theme = document.getElementById("theme");
  const grounds = ["light", "dark", "system"].map((name) => {
    theme.click();
    check(theme.textContent.includes(name), `the theme is '${theme.textContent}', not ${name}`);
    return light(ground(document.body));
  });
  check(grounds[0] > 0.8 && grounds[1] < 0.1, `themes have grounds of ${grounds}`);

  const wide = document.documentElement.scrollWidth;
  check(wide <= document.documentElement.clientWidth, `the page is ${wide} wide in a window of ${document.documentElement.clientWidth}`);
  scrollTo(0, 0);
  return { wrong, told };
})()
