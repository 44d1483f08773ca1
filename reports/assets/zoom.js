// A chart of a page as one to zoom into: drawn by uPlot, from the places in the page's own drawing.
"use strict";
(() => {
  const L = 52, R = 356, T = 10, B = 248;  // of the axes of every chart
  const all = (what, within = document) => [...within.querySelectorAll(what)];
  const UNITS = { "µs": 1e-6, ms: 1e-3, s: 1, min: 60 };

  // The library lies in a file of its own, or in this page.
  const library = () => globalThis.uPlot ? Promise.resolve() : new Promise((done, failed) => {
    const script = document.createElement("script"), here = document.getElementById("uplot");
    if (here) script.textContent = here.textContent;
    else { script.src = "uplot.js"; script.onload = done; script.onerror = failed; }
    document.head.append(script);
    if (here) done();
  });

  const axis = (svg, name, first, last) => {
    const [low, high, log] = svg.dataset[name].split(" ").map(Number);
    const value = (place) => {
      const found = low + (place - first) / (last - first) * (high - low);
      return log ? 10 ** found : found;
    };
    return { log: Boolean(log), value, ends: log ? [10 ** low, 10 ** high] : [low, high] };
  };

  // The points of a path as report pages write it: the first of a part, then steps from one to the next.
  const points = (path) => {
    const [x, y] = [[], []];
    path.getAttribute("d").split("M").slice(1).forEach((part) => {
      const steps = part.match(/-?(?:\d+\.?\d*|\.\d+)/g).map(Number), absolute = !part.includes("l");
      let [px, py] = [0, 0];
      if (x.length) { x.push(null); y.push(null); }
      for (let i = 0; i + 1 < steps.length; i += 2) {
        [px, py] = absolute || i === 0 ? [steps[i], steps[i + 1]] : [px + steps[i], py + steps[i + 1]];
        x.push(px); y.push(py);
      }
    });
    return [x, y];
  };
  const seconds = (said) => {
    const found = /^(\S+) (µs|ms|s|min)/.exec(said ?? "");
    return found ? Number(found[1]) * UNITS[found[2]] : null;
  };

  // What a curve shows: the numbers told of its points where there are any, else what its line says.
  const placed = (path, x, y) => {
    const [px, py] = points(path);
    return px.flatMap((place, i) => place === null ? [] : [[x.value(place), y.value(py[i])]]);
  };
  const told = (path, x, y) => {
    const tips = path.dataset.tip.split("|");
    return placed(path, x, y).map(([at, value], i) => {
      const [step, error, cost] = tips[i].split(";");
      return [(cost === undefined ? Number(step) : seconds(cost)) || at, Number(error) || value];
    });
  };
  const curve = (group, x, y) => {
    const known = all("[data-tip]", group), path = group.querySelector(".line") ?? group.querySelector(".dots");
    const found = known.length ? known.flatMap((one) => told(one, x, y)) : path ? placed(path, x, y) : [];
    return found.sort((a, b) => a[0] - b[0]);
  };

  const series = (svg, x, y) => {
    const found = all("g[class^=k], g[data-k]", svg).map((group) => {
      const look = getComputedStyle(group), line = group.querySelector(".line");
      const dash = line ? getComputedStyle(line).strokeDasharray.match(/[\d.]+/g) : null;
      const name = group.dataset.k ?? document.getElementById(group.classList[0])?.dataset.k;
      return {
        name, points: curve(group, x, y), paths: line ? undefined : () => null,
        stroke: look.getPropertyValue("--c").trim(), dash: dash?.map(Number), width: 1.5,
      };
    });
    const exact = svg.querySelector("path.exact");
    if (exact) found.unshift({ name: svg.dataset.grey, points: placed(exact, x, y), stroke: getComputedStyle(exact).stroke, width: 4 });
    return found.filter((one) => one.points.length);
  };

  const said = (value) => {
    if (value === null || value === undefined) return "–";
    const size = Math.abs(value), short = Number(value.toPrecision(3));
    return value === 0 || (size >= 1e-2 && size < 1e5) ? String(short) : short.toExponential().replace("e+", "e");
  };
  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

  // A logarithmic axis has ticks at decades; at 2 and 5 too where these are few, at some where many.
  const decades = (_, __, low, high) => {
    const first = Math.floor(Math.log10(low)), last = Math.ceil(Math.log10(high)), found = [];
    const stride = Math.ceil((last - first) / 10), steps = last - first > 3 ? [1] : [1, 2, 5];
    for (let n = first; n <= last; n += stride) steps.forEach((m) => found.push(Number(`${m}e${n}`)));
    return found.filter((tick) => tick >= low && tick <= high);
  };
  const line = () => ({ stroke: colour("--line"), width: 1 });
  const drawnAxis = (one, label, size) => ({
    label, size, stroke: colour("--ink"), grid: line(), ticks: line(), values: (_, ticks) => ticks.map((tick) => tick === null ? "" : said(tick)),
    ...(one.log ? { splits: decades } : {}),
  });
  // A part in which all values are the same gets some room about them.
  const about = (one, value) => one.log ? [value / 2, value * 2] : [value - (Math.abs(value) || 1), value + (Math.abs(value) || 1)];
  const scale = (one) => ({
    time: false, distr: one.log ? 3 : 1,
    range: (_, low, high) => low === null ? one.ends : low < high ? [low, high] : about(one, low),
  });

  function opened(title) {
    const box = document.body.appendChild(document.createElement("dialog"));
    box.className = "zoom";
    box.innerHTML = "<form method=dialog><b></b> <small>Drag over a part to see it larger, double-click for all; a click on a name hides its curve.</small> <button class=chip>close</button></form>";
    box.querySelector("b").textContent = title;
    box.addEventListener("close", () => box.remove());
    box.showModal();
    return box;
  }
  function zoom(svg, title) {
    const x = axis(svg, "x", L, R), y = axis(svg, "y", B, T);
    const across = svg.querySelector("svg > text.mid").textContent, up = svg.querySelector(".up").textContent;
    return plotted(title, [across, x], [up, y], series(svg, x, y));
  }
  function plotted(title, [across, x], [up, y], curves) {
    const box = opened(title);
    const value = (_, at) => said(at);
    const size = () => ({ width: box.clientWidth - 32, height: Math.round(0.62 * innerHeight) });
    const plot = new globalThis.uPlot({
      ...size(),
      scales: { x: scale(x), y: scale(y) },
      axes: [drawnAxis(x, across, 50), drawnAxis(y, up, 70)],
      cursor: { drag: { x: true, y: true, uni: 20 }, focus: { prox: 16 } },
      focus: { alpha: 0.2 },
      series: [{ label: across, value }, ...curves.map((one) => ({
        ...one, label: one.name, value, spanGaps: true, points: { show: one.points.length < 20 },
      }))],
    }, globalThis.uPlot.join(curves.map((one) => [0, 1].map((k) => one.points.map((point) => point[k])))), box);
    [["x", x], ["y", y]].forEach(([name, one]) => plot.setScale(name, { min: one.ends[0], max: one.ends[1] }));
    new ResizeObserver(() => box.open && plot.setSize(size())).observe(box);
    return plot;
  }

  // The errors of a quantity against the step, from the rows of the table of all settings.
  const look = (label) => {
    const symbol = all("symbol[data-k]").find((one) => one.dataset.k === label);
    if (!symbol) return {};
    const dash = getComputedStyle(symbol.querySelector(".line")).strokeDasharray.match(/[\d.]+/g);
    return { stroke: getComputedStyle(symbol).getPropertyValue("--c").trim(), dash: dash?.map(Number) };
  };
  function inTable(table, quantity) {
    const columns = all("thead th", table).map((head) => head.textContent.split(" ")[0]);
    const [kn, error] = [columns.indexOf("kn"), columns.indexOf("error")], found = new Map();
    let label = null;
    all("tbody tr", table).forEach((row) => {
      const head = row.querySelector("th");
      if (head) {
        const [of, what] = head.firstChild.textContent.split(" \u00b7 ");
        label = what === quantity || what?.startsWith(`${quantity} [`) ? of : null;
      } else if (label !== null) {
        const cells = all("td", row).map((cell) => cell.textContent), value = Number(cells[error]);
        const name = kn < 0 ? label : `${label}, kn ${cells[kn]} N/m`;
        if (!found.has(name)) found.set(name, { name, points: [], width: 1.5, ...look(label) });
        if (value > 0) cells[0].split(", ").map(Number).filter((dt) => dt > 0).forEach((dt) => found.get(name).points.push([dt, value]));
      }
    });
    const curves = [...found.values()].filter((one) => one.points.length);
    curves.forEach((one) => one.points.sort((a, b) => a[0] - b[0]));
    return curves;
  }
  const around = (values) => ({ log: true, ends: [Math.min(...values) / 1.2, Math.max(...values) * 1.2] });
  all("[data-draw]").forEach((place) => {
    const table = place.closest(".variant").querySelector("table.rungs"), symbol = place.textContent;
    const curves = table ? inTable(table, place.dataset.draw) : [];
    if (!curves.length) return;
    const button = Object.assign(document.createElement("button"), { type: "button", className: "chip", textContent: symbol });
    const [steps, errors] = [0, 1].map((k) => around(curves.flatMap((one) => one.points.map((point) => point[k]))));
    const title = `Error of ${symbol} against step`;
    button.setAttribute("aria-label", `draw: ${title}`);
    button.addEventListener("click", () => library().then(() => {
      place.plot = plotted(title, ["dt [s]", steps], [`error of ${symbol}`, errors], curves);
    }));
    place.replaceChildren(button);
    place.parentElement.querySelector("[data-drawn]").hidden = false;
  });

  all("figure").forEach((figure) => {
    const svg = figure.querySelector("svg.chart[data-x]"), head = figure.querySelector("h3");
    if (!svg || !head) return;
    const button = Object.assign(document.createElement("button"), { type: "button", className: "chip", textContent: "zoom" });
    const title = head.textContent;
    button.setAttribute("aria-label", `zoom into ${title}`);
    button.addEventListener("click", () => library().then(() => { figure.plot = zoom(svg, title); }));
    head.append(" ", button);
  });
})();
