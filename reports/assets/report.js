// What the pages do beyond their text: theme, search, filters, sorting, hover, playback.
"use strict";
(() => {
  const all = (what, within = document) => [...within.querySelectorAll(what)];
  const one = (id) => document.getElementById(id);
  const root = document.documentElement;
  root.classList.add("js");

  // The choices of a reader live in the address, so that a view can be sent to others.
  const state = new URLSearchParams(location.hash.includes("=") ? location.hash.slice(1) : "");
  const keep = (name, value) => {
    if (value) state.set(name, value); else state.delete(name);
    history.replaceState(null, "", state.size ? `#${state}` : location.pathname + location.search);
  };

  const theme = one("theme");
  const dark = () => root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  try { root.dataset.theme = localStorage.getItem("vv-theme") || ""; } catch { /* no storage */ }
  if (!root.dataset.theme) delete root.dataset.theme;
  theme.hidden = false;
  theme.addEventListener("click", () => {
    root.dataset.theme = dark() ? "light" : "dark";
    try { localStorage.setItem("vv-theme", root.dataset.theme); } catch { /* no storage */ }
  });

  all(".cmd").forEach((code) => {
    code.title = "click to copy";
    code.addEventListener("click", () => navigator.clipboard?.writeText(code.textContent).then(
      () => { code.title = "copied"; }, () => getSelection().selectAllChildren(code)));
  });

  // The input of a code: what all its inputs begin with lies in a file of its own, or in this page.
  const heads = () => globalThis.vvInputs ? Promise.resolve(globalThis.vvInputs) : new Promise((done) => {
    const script = document.createElement("script");
    script.src = "inputs.js";
    script.onload = script.onerror = () => done(globalThis.vvInputs ?? {});
    document.head.append(script);
  });
  const patched = (base, diff) => {
    const old = base.split("\n"), made = [];
    const hunks = diff.split(/^@@ -(\d+)(?:,(\d+))? .*@@\n/m);
    let at = 0;
    for (let i = 1; i < hunks.length; i += 3) {
      const count = Number(hunks[i + 1] ?? 1), first = Number(hunks[i]) - (count ? 1 : 0);
      made.push(...old.slice(at, first), ...hunks[i + 2].split("\n").filter((line) => line[0] === "+").map((line) => line.slice(1)));
      at = first + count;
    }
    return [...made, ...old.slice(at)].join("\n");
  };
  const own = (pre) => pre.dataset.base ? patched(one(pre.dataset.base).querySelector("pre").textContent, pre.textContent) : pre.textContent;
  const input = async (box) => {
    const pre = box.querySelector("pre"), code = pre.dataset.head;
    const here = code && document.getElementById(`head-${code}`)?.textContent;
    return `${code ? here ?? (await heads())[code] ?? "" : ""}${own(pre)}`;
  };
  all(".input").forEach((box) => {
    all("button", box).forEach((button) => { button.hidden = false; });
    box.querySelector("[data-whole]")?.addEventListener("click", (event) => {
      const pre = box.querySelector("pre");
      pre.textContent = own(pre);
      delete pre.dataset.base;
      event.target.remove();
    });
    box.querySelector("[data-copy]").addEventListener("click", async (event) => {
      const said = event.target;
      try { await navigator.clipboard.writeText(await input(box)); said.textContent = "copied"; } catch { getSelection().selectAllChildren(box.querySelector("pre")); }
    });
    box.querySelector("[data-save]").addEventListener("click", async (event) => {
      const link = document.createElement("a");
      link.href = URL.createObjectURL(new Blob([await input(box)], { type: "text/plain" }));
      link.download = event.target.dataset.save;
      link.click();
      URL.revokeObjectURL(link.href);
    });
  });

  // Tables sort by a click on a heading; by data-s where a cell has it. A number may have a unit
  // of time, "of 12" or its spread behind it.
  const units = { "µs": 1e-6, ms: 1e-3, s: 1, min: 60 };
  const key = (cell) => {
    const text = cell.dataset.s ?? cell.textContent.trim();
    if (text === "" || text === "–") return null;
    const found = /^(-?[\d.]+(?:e[-+]?\d+)?)(?: (µs|ms|s|min|of \d+|± [\d.]+))?(?: [○◻])*$/.exec(text);
    return found ? Number(found[1]) * (units[found[2]] ?? 1) : text;
  };
  const sort = (table, column, up) => {
    const body = table.tBodies[0];
    const rows = [...body.rows].map((row) => [key(row.cells[column]), row]);
    rows.sort(([a], [b]) => a === null ? (b === null ? 0 : 1) : b === null ? -1
      : (up ? 1 : -1) * (typeof a === "number" && typeof b === "number" ? a - b : String(a).localeCompare(String(b))));
    body.append(...rows.map(([, row]) => row));
    [...table.tHead.rows[0].cells].forEach((head, i) => {
      if (i === column) head.setAttribute("aria-sort", up ? "ascending" : "descending"); else head.removeAttribute("aria-sort");
    });
  };
  all("table.sortable").forEach((table) => [...table.tHead.rows[0].cells].forEach((head, i) => {
    head.tabIndex = 0;
    const go = () => {
      const up = head.getAttribute("aria-sort") !== "ascending";
      sort(table, i, up);
      if (table.id) keep("sort", `${i}${up ? "" : "-"}`);
    };
    head.addEventListener("click", go);
    head.addEventListener("keydown", (event) => { if (event.key === "Enter") go(); });
  }));

  // Pointing at a curve tells the nearest of its points and fades the others.
  const tip = document.body.appendChild(document.createElement("div"));
  tip.id = "tip"; tip.hidden = true;
  const named = (group) => group.dataset.k ?? one(group.classList[0])?.dataset.k;
  const worded = (tip) => {
    const [step, error, cost] = tip.split(";");
    if (error === undefined) return tip;
    return `${step ? `dt ${step} s: ` : ""}error ${error}${cost ? `, ${cost.replace("○", "(indicative)").replace("◻", "(whole process)")}` : ""}`;
  };
  const nearest = (svg, event) => {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    let best = null, least = 14;
    all("[data-tip]", svg).forEach((path) => {
      const spots = path.getAttribute("d").slice(1).split(" ").map(parseFloat), tips = path.dataset.tip.split("|");
      for (let i = 0; i < tips.length; i++) {
        const far = Math.hypot(spots[2 * i] - at.x, spots[2 * i + 1] - at.y);
        if (far < least) { least = far; best = `${named(path.parentNode)}: ${worded(tips[i])}`; }
      }
    });
    return best;
  };
  document.addEventListener("pointermove", (event) => {
    const svg = event.target.closest?.("svg.chart");
    const group = event.target.closest?.("svg.chart [data-k], svg.chart [class^=k]");
    const said = svg && (nearest(svg, event) || (group && named(group)));
    tip.hidden = !said;
    if (said) {
      tip.textContent = said;
      tip.style.left = `${Math.min(event.clientX + 12, innerWidth - tip.offsetWidth - 8)}px`;
      tip.style.top = `${event.clientY + 14}px`;
    }
    const name = said ? said.split(":")[0] : null;
    if (svg) all("[data-k], [class^=k]", svg).forEach((g) => g.classList.toggle("faint", Boolean(name) && named(g) !== name));
  });
  document.addEventListener("pointerout", (event) => {
    const svg = event.target.closest?.("svg.chart");
    if (svg && !svg.contains(event.relatedTarget)) { all(".faint", svg).forEach((g) => g.classList.remove("faint")); tip.hidden = true; }
  });

  // The front page.
  const source = one("data");
  if (source) front(JSON.parse(source.textContent));

  function front(data) {
    const labels = Object.keys(data.looks);
    const chips = all("#chips .chip"), targets = all("#targets .chip");
    const codes = chips.map((chip) => chip.dataset.code);
    const hidden = new Set((state.get("hide") || "").split(",").filter(Boolean));
    let target = Math.max(0, data.targets.indexOf(Number(state.get("error") || 1e-3)));
    const shown = () => labels.filter((label) => !hidden.has(label) && !hidden.has(label.split("/")[0]));
    ["tools", "targets", "show"].forEach((id) => { if (one(id)) one(id).hidden = false; });

    const median = (values) => {
      const sorted = [...values].sort((a, b) => a - b), n = sorted.length;
      return n ? (n % 2 ? sorted[(n - 1) / 2] : (sorted[n / 2 - 1] + sorted[n / 2]) / 2) : null;
    };
    const sci = (x) => x === null ? "–" : x === 0 ? "0" : x.toExponential(1).replace("e+", "e");
    const ratio = (x) => x === null ? "–" : x < 10 ? String(Number(x.toPrecision(2))) : x < 1e4 ? x.toFixed(0) : x.toExponential(0).replace("e+", "e");

    function medians() {
      const here = shown(), who = new Set(here.map((label) => label.split("/")[0]));
      const count = labels.length ? data.errors[labels[0]].length : 0, common = [];
      for (let i = 0; i < count; i++) {
        const able = new Set(here.filter((label) => data.errors[label][i] !== null).map((label) => label.split("/")[0]));
        if (able.size && able.size === who.size) common.push(i);
      }
      if (one("common")) one("common").textContent = common.length;
      const ratios = Object.fromEntries(here.map((label) => [label, []]));
      const at = data.targets.indexOf(1e-3);
      Object.values(data.costs).forEach((row) => {
        const known = here.filter((label) => row[label] && row[label][at] !== null);
        const best = Math.min(...known.map((label) => row[label][at]));
        known.forEach((label) => ratios[label].push(Math.log(row[label][at] / best)));
      });
      const timed = Object.keys(data.costs).length;
      all("#which tbody tr").forEach((row) => {
        const label = row.dataset.k;
        if (!here.includes(label)) return;
        const errors = common.map((i) => data.errors[label][i]).filter((e) => e !== null);
        fill(row.querySelector(".median"), median(errors), sci, errors.length === common.length ? "" : `${errors.length} of ${common.length}`);
        const middle = median(ratios[label]);
        fill(row.querySelector(".dear"), middle === null ? null : Math.exp(middle), data.guessed ? (r) => (r === null ? "–" : `~${ratio(r)}`) : ratio, ratios[label].length ? `${ratios[label].length} of ${timed}` : "");
      });
    }
    function fill(cell, value, write, more) {
      cell.dataset.s = value ?? "";
      cell.textContent = write(value);
      if (more && value !== null) cell.append(" ", Object.assign(document.createElement("small"), { textContent: more }));
    }

    function profiles() {
      const here = shown(), rows = Object.fromEntries(here.map((label) => [label, []]));
      let solved = 0;
      Object.entries(data.costs).forEach(([place, row]) => {
        const known = here.filter((label) => row[label] && row[label][target] !== null);
        if (!known.length) return;
        solved += 1;
        const best = Math.min(...known.map((label) => row[label][target]));
        known.forEach((label) => rows[label].push([row[label][target] / best, place, row[label][target]]));
      });
      return [rows, solved];
    }
    function draw() {
      const box = one("profile");
      if (!box) return;
      one("target-said").textContent = targets[target].textContent;
      const [rows, solved] = profiles(), names = Object.keys(rows).filter((label) => rows[label].length);
      const worst = Math.max(10, ...names.map((label) => Math.max(...rows[label].map(([r]) => r)))) * 1.6;
      const W = 470, H = 290, L = 52, R = 356, T = 10, B = 248;
      const x = (r) => L + Math.log10(r) / Math.log10(worst) * (R - L), y = (s) => B - s * (B - T);
      const make = (name, attributes, text) => {
        const made = document.createElementNS("http://www.w3.org/2000/svg", name);
        Object.entries(attributes).forEach(([k, v]) => made.setAttribute(k, v));
        if (text !== undefined) made.textContent = text;
        return made;
      };
      const svg = make("svg", { class: "chart", viewBox: `0 0 ${W} ${H}`, "aria-hidden": "true" });
      const put = (...parts) => { const made = make(...parts); svg.append(made); return made; };
      for (let s = 0; s <= 1.001; s += 0.2) {
        put("path", { class: "grid", d: `M${L} ${y(s)}H${R}` });
        put("text", { class: "end", x: L - 5, y: y(s) + 3 }, `${Math.round(100 * s)} %`);
      }
      const most = Math.ceil(Math.log10(worst)), stride = Math.max(1, Math.ceil(most / 6));
      for (let n = 0; n <= Math.log10(worst); n += stride) {
        put("path", { class: "grid", d: `M${x(10 ** n)} ${T}V${B}` });
        put("text", { class: "mid", x: x(10 ** n), y: B + 13 }, n ? `10${[...String(n)].map((d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d]).join("")}` : "1");
      }
      put("text", { class: "mid", x: (L + R) / 2, y: H - 10 }, "CPU time over that of the cheapest scheme");
      const ends = names.map((label) => {
        const row = rows[label].sort((a, b) => a[0] - b[0]), look = data.looks[label];
        const g = put("g", { class: `c${look[0]}`, "data-k": label });
        let d = "", before = 0;
        row.forEach(([r], i) => { d += `${d ? "L" : "M"}${x(r)} ${y(before)}L${x(r)} ${y((i + 1) / solved)}`; before = (i + 1) / solved; });
        g.append(make("path", { class: "line", d: `${d}L${R} ${y(before)}`, "stroke-dasharray": look[1] || "none" }));
        const dots = row.map(([r], i) => `M${x(r) - 2.4} ${y((i + 1) / solved)}a2.4 2.4 0 1 0 4.8 0a2.4 2.4 0 1 0-4.8 0`).join("");
        g.append(make("path", { class: "full", d: dots }));
        g.append(make("path", {
          class: "holes", d: `M${row.map(([r], i) => `${x(r)} ${y((i + 1) / solved)}`).join(" ")}h0`,
          "data-tip": row.map(([r, place, cpu]) => `${place}, ${cpu.toPrecision(3)} s, ${ratio(r)} times the cheapest`).join("|"),
        }));
        return [y(before), label];
      }).sort((a, b) => a[0] - b[0]);
      let floor = -9;
      const placed = ends.map(([at, label]) => { floor = Math.max(at, floor + 10.5); return [floor, at, label]; });
      const over = Math.max(0, floor - (B + 30));
      placed.forEach(([place, at, label]) => {
        const g = put("g", { class: `c${data.looks[label][0]}`, "data-k": label });
        g.append(make("path", { class: "lead", d: `M${R} ${at}L${R + 5} ${place - over}` }));
        const fitted = label.length > 19 ? { textLength: 104, lengthAdjust: "spacingAndGlyphs" } : {};
        g.append(make("text", { class: "named", x: R + 8, y: place - over + 3, ...fitted }, label));
      });
      all("[data-k]", svg).forEach((g) => {
        g.style.cursor = "pointer";
        g.addEventListener("click", () => { hidden.add(g.dataset.k); apply(); });
      });
      box.replaceChildren(svg);
      if (!names.length) box.textContent = "Nobody shown reaches this error on a timed variant.";
    }

    function columns() {
      const here = new Set(shown());
      all("tr[data-k]").forEach((row) => row.classList.toggle("off", !here.has(row.dataset.k)));
      const map = one("map");
      if (!map) return;
      labels.forEach((label, i) => {
        const off = !here.has(label);
        if (map.tHead.rows[0].cells[i + 1].classList.contains("off") === off) return;
        all("tr", map).forEach((row) => row.cells[i + 1]?.classList.toggle("off", off));
      });
    }
    function apply() {
      chips.forEach((chip) => {
        const code = chip.dataset.code, own = labels.filter((label) => label.split("/")[0] === code);
        if (own.length && own.every((label) => hidden.has(label))) { own.forEach((label) => hidden.delete(label)); hidden.add(code); }
        chip.setAttribute("aria-pressed", String(!hidden.has(code)));
      });
      targets.forEach((chip, i) => chip.setAttribute("aria-pressed", String(i === target)));
      keep("hide", [...hidden].join(","));
      keep("error", data.targets[target] === 1e-3 ? "" : String(data.targets[target]));
      columns(); medians(); draw();
    }
    chips.forEach((chip) => chip.addEventListener("click", () => {
      const code = chip.dataset.code;
      if (hidden.has(code)) hidden.delete(code); else hidden.add(code);
      [...hidden].filter((name) => name.startsWith(`${code}/`)).forEach((name) => hidden.delete(name));
      apply();
    }));
    targets.forEach((chip, i) => chip.addEventListener("click", () => { target = i; apply(); }));
    void codes;

    const search = one("search"), bodies = all("#map tbody");
    const find = () => {
      const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
      bodies.forEach((body) => {
        const text = `${body.dataset.q} ${all("th", body).map((th) => th.textContent.toLowerCase()).join(" ")}`;
        body.classList.toggle("off", !words.every((word) => text.includes(word)));
      });
      keep("find", search.value);
    };
    search.addEventListener("input", find);
    search.addEventListener("keydown", (event) => {
      const first = bodies.find((body) => !body.classList.contains("off"));
      if (event.key === "Enter" && first) location.href = first.querySelector("a").href;
    });
    document.addEventListener("keydown", (event) => {
      if (event.key === "/" && !/INPUT|TEXTAREA/.test(document.activeElement.tagName)) { event.preventDefault(); search.focus(); }
    });
    bodies.forEach((body) => body.querySelector(".fold")?.addEventListener("click", (event) => {
      event.target.setAttribute("aria-expanded", String(body.classList.toggle("open")));
    }));

    const shows = all("#show .chip");
    const write = (what) => {
      shows.forEach((chip) => chip.setAttribute("aria-pressed", String(chip.dataset.show === what)));
      all("#map td[data-v]").forEach((cell) => {
        const link = cell.firstElementChild;
        link.dataset.e ??= link.textContent;
        link.textContent = what === "cost" ? cell.dataset.c : what === "verdict" ? cell.dataset.v : link.dataset.e;
      });
      keep("show", what === "error" ? "" : what);
    };
    shows.forEach((chip) => chip.addEventListener("click", () => write(chip.dataset.show)));

    if (state.get("find")) { search.value = state.get("find"); find(); }
    if (state.get("show")) write(state.get("show"));
    if (state.get("sort") && one("which")) sort(one("which"), parseInt(state.get("sort"), 10), !state.get("sort").endsWith("-"));
    if (hidden.size || state.get("error")) apply(); else draw();
  }

  // The motion of each scheme beside the exact one: marks on a line each, and the bodies drawn.
  if (all(".playback").length) all("svg.scene use").forEach((use) => {  // each moves for itself
    const copy = one(use.getAttribute("href").slice(1)).cloneNode(true);
    copy.removeAttribute("id");
    use.replaceWith(copy);
  });
  all(".playback").forEach((box) => {
    const data = JSON.parse(box.firstElementChild.textContent), names = Object.keys(data.codes);
    const [name, size, first] = data.exact[0], last = first.length - 1;
    const places = (code, k) => data.codes[code][1][k] || data.exact[k][2];  // 0: never a pixel off
    const H = 22 + 13 * names.length;
    const time = (i) => Number((data.ends[0] + i / last * (data.ends[1] - data.ends[0])).toPrecision(3));
    const span = [...first, ...names.flatMap((code) => places(code, 0))].filter((v) => v !== null);
    const low = Math.min(...span), high = Math.max(...span), wide = high - low || 1;
    const x = (v) => 20 + 300 * (v - low) / wide;
    const dots = names.map((code, i) => `<g class="c${Number(data.codes[code][0])}"><path class="lead" d="M20 ${25 + 13 * i}H320"/><circle class="full" r="4" cy="${25 + 13 * i}"/><text class="named" x="330" y="${28 + 13 * i}"></text></g>`).join("");
    box.insertAdjacentHTML("beforeend", `<p class="small"><button type="button" class="chip">play</button> <input type="range" min="0" max="${last}" value="0" aria-label="time"> <label>bodies move as in <select></select></label><br><output></output></p><svg class="chart" viewBox="0 0 470 ${H}" aria-hidden="true"><path class="exact"/>${dots}</svg>`);
    const [bar, said, button, chosen] = ["input", "output", "button", "select"].map((what) => box.querySelector(what));
    all(".named", box).forEach((text, i) => { text.textContent = names[i]; });
    names.forEach((code) => chosen.append(new Option(code)));
    const scene = data.moves.length ? acting(box.closest(".variant").querySelector("svg.scene"), data, places) : null;
    if (!scene) chosen.parentNode.remove();
    const value = (part) => part === null ? "none" : (part / 1000 * size).toPrecision(3);
    const step = () => {
      const i = Number(bar.value), code = chosen.value;
      box.querySelector(".exact").setAttribute("d", `M${x(first[i])} 16V${H - 2}`);
      all("circle", box).forEach((dot, k) => {
        const place = places(names[k], 0)[i];
        dot.setAttribute("visibility", place === null ? "hidden" : "visible");
        if (place !== null) dot.setAttribute("cx", x(place));
      });
      scene?.(code, i);
      said.textContent = `t = ${time(i)} s, exact ${name}: ${value(first[i])}${scene ? `, ${code}: ${value(places(code, 0)[i])}. Dashed outline: exact; ${data.drawn}.` : ""}`;
    };
    let timer = null;
    button.addEventListener("click", () => {
      if (timer) { clearInterval(timer); timer = null; button.textContent = "play"; return; }
      button.textContent = "stop";
      timer = setInterval(() => { bar.value = (Number(bar.value) + 1) % first.length; step(); }, 60);
    });
    bar.addEventListener("input", step);
    chosen.addEventListener("change", step);
    box.hidden = false;
    step();
  });

  // The bodies of a drawing, each with an outline where the exact answer has it: a function that
  // puts them where a scheme has them in a frame.
  function acting(svg, data, places) {
    if (!svg) return null;
    const circles = all("circle.body", svg), faces = all("path.body", svg), bodies = new Map();
    data.moves.forEach(([k, c, cs, f, fs, dx, dy, turn]) => {
      const key = `${c} ${cs} ${f} ${fs}`;
      const shapes = [...circles.slice(c, c + cs), ...faces.slice(f, f + fs)];
      if (!bodies.has(key)) bodies.set(key, { shapes, ghosts: shapes.map((shape) => shape.cloneNode()), moves: [] });
      bodies.get(key).moves.push({ k, dx, dy, turn });
    });
    const start = (place) => place.find((v) => v !== null) ?? 0;
    bodies.forEach((body) => {
      body.ghosts.forEach((ghost) => { ghost.setAttribute("class", "ghost"); svg.append(ghost); });
      const spots = body.shapes.flatMap((shape) => shape.cx ? [[shape.cx.baseVal.value, shape.cy.baseVal.value]]
        : shape.getAttribute("d").slice(1).replace("z", "").split("L").map((spot) => spot.split(" ").map(Number)));
      body.middle = [0, 1].map((axis) => spots.reduce((sum, spot) => sum + spot[axis], 0) / spots.length);
    });
    const gone = (body, of, i) => body.moves.reduce(([x, y, a, there], { k, dx, dy, turn }) => {
      const place = of(k)[i], turned = place === null ? 0 : place - start(of(k));
      return [x + dx * (place ?? 0), y + dy * (place ?? 0), a + turn * turned, there && place !== null];
    }, [0, 0, 0, true]);
    const put = (shapes, [x, y, angle, there], [mx, my]) => shapes.forEach((shape) => {
      shape.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)})${angle ? ` rotate(${angle.toFixed(3)} ${mx.toFixed(1)} ${my.toFixed(1)})` : ""}`);
      shape.setAttribute("visibility", there ? "visible" : "hidden");
    });
    const tied = bonds(svg, circles);
    return (code, i) => {
      const shifts = new Map();
      bodies.forEach((body) => {
        const here = gone(body, (k) => places(code, k), i);
        put(body.shapes, here, body.middle);
        put(body.ghosts, gone(body, (k) => data.exact[k][2], i), body.middle);
        body.shapes.forEach((shape) => shifts.set(shape, here));
      });
      tied(shifts);
    };
  }
  // The bonds of a drawing follow the circles that they join: a function of how far these went.
  function bonds(svg, circles) {
    const path = svg.querySelector("path.bond");
    if (!path) return () => {};
    const at = new Map(circles.map((c) => [`${c.getAttribute("cx")} ${c.getAttribute("cy")}`, c]));
    const ends = path.getAttribute("d").slice(1).split("M").map((bond) => bond.split("L"));
    return (shifts) => path.setAttribute("d", ends.map((bond) => `M${bond.map((spot) => {
      const [x, y] = spot.split(" ").map(Number), [dx, dy] = shifts.get(at.get(spot)) ?? [0, 0];
      return `${Number((x + dx).toFixed(1))} ${Number((y + dy).toFixed(1))}`;
    }).join("L")}`).join(""));
  }
})();
